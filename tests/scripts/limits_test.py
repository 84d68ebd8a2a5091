#!/usr/bin/python3
"""What would take too much is refused with one line before memory is taken, or made smaller and said.

Argument: the program.
"""
import pathlib
import resource
import subprocess
import sys
import tempfile
import unittest

PROGRAM = sys.argv.pop(1)
BUDGET = 1 << 30  # bytes of address space of each run
SMALL = 100 << 20  # resident: a refusal comes before a tenth of it is taken
REFUSED, NO_ROOM = 2, 3

PLY = """ply
format {form} 1.0
element vertex {vertices}
property double x
property double y
property double z
element face {faces}
property list uchar int vertex_indices
end_header
0 0 0
1 0 0
0 1 0
3 0 1 2
"""
QUERY = ("query", "--mesh", "icosphere:4", "--trajectory", "slide", "--steps", "10", "--detector")


def run(*arguments):
    def limit():
        resource.setrlimit(resource.RLIMIT_AS, (BUDGET, BUDGET))
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=60, check=False,
                          preexec_fn=limit)


def spent():
    """Processor seconds of all runs so far, and the most that one of them held in memory, in bytes."""
    usage = resource.getrusage(resource.RUSAGE_CHILDREN)
    return usage.ru_utime + usage.ru_stime, usage.ru_maxrss * 1024


class Limits(unittest.TestCase):
    def refused(self, status, line, *arguments):
        before, _ = spent()
        ended = run(*arguments)
        after, most = spent()
        self.assertEqual((ended.returncode, ended.stdout), (status, ""), ended.stderr)
        self.assertEqual(ended.stderr.count("\n"), 1, ended.stderr)
        self.assertIn(line, ended.stderr)
        self.assertLess(after - before, 1)
        self.assertLess(most, SMALL)

    def test_scenes(self):
        self.refused(REFUSED, "is not a whole number from 0 to 11", "mesh", "info", "icosphere:12")
        self.refused(REFUSED, "from 6 to 200000000", "mesh", "info", "noisy-sphere:9999999999")
        self.refused(REFUSED, "20000000000 triangles, more than 200000000", "mesh", "info", "torus:100000x100000")
        self.refused(REFUSED, "from 1 to 200000000", "mesh", "info", "soup:3000000000")

    def test_scenes_that_the_memory_does_not_hold(self):
        for scene in ("soup:30000000", "noisy-sphere:60000000", "icosphere:11", "torus:10000x5000"):
            self.refused(NO_ROOM, "MB of memory, and", "mesh", "info", scene)

    def test_what_is_to_be_found_out_about_a_scene(self):
        ended = run("mesh", "info", "noisy-sphere:4000000")
        self.assertEqual((ended.returncode, ended.stdout), (NO_ROOM, ""), ended.stderr)
        self.assertRegex(ended.stderr, r"^touchmark: edges and sides of 4000000 triangles need about 1526 MB of memory, "
                         r"and [0-9]+ MB are available\n$")

    def test_steps(self):
        query = ("query", "--mesh", "cube", "--detector", "brute-force", "--trajectory", "hover", "--steps")
        self.refused(REFUSED, "not a whole number from 1 to 100000000", *query, "1000000000000")
        self.refused(NO_ROOM, "trajectory hover: 100000000 steps need about", *query, "100000000")
        for command in ("verify", "bench"):
            self.refused(NO_ROOM, "trajectory hover: 100000000 steps need about", command, *query[1:], "100000000")
        self.refused(NO_ROOM, "trajectory hover, slide: 16000000 steps need about", "plan", "--mesh", "cube",
                     "--trajectory", "hover", "--trajectory", "slide", "--steps", "8000000")

    def test_counts_in_headers(self):
        with tempfile.TemporaryDirectory() as folder:
            def file(name, text):
                path = pathlib.Path(folder) / name
                path.write_bytes(text)
                return str(path)
            for form in ("ascii", "binary_little_endian", "binary_big_endian"):
                for vertices, faces in ((2**31, 1), (3, 2**31), (3, 2**40)):
                    text = PLY.format(form=form, vertices=vertices, faces=faces).encode()
                    self.refused(REFUSED, f"the header declares {max(vertices, faces)}", "mesh", "info", file("a.ply", text))
            self.refused(REFUSED, "2147483648 in a file of", "mesh", "info", file("a.off", b"OFF\n2147483648 1 0\n0 0 0\n"))
            stl = b"\0" * 80 + (2**31).to_bytes(4, "little") + b"\0" * 50
            self.refused(REFUSED, "2147483648 facets need", "mesh", "info", file("a.stl", stl))

    def test_files_that_the_memory_does_not_hold(self):
        with tempfile.TemporaryDirectory() as folder:
            def sparse(name, begin):
                path = pathlib.Path(folder) / name
                with open(path, "wb") as file:
                    file.write(begin)
                    file.truncate(1 << 33)
                return str(path)
            for name in ("a.ply", "a.obj", "a.off", "a.stl", "a.3ds"):
                self.refused(NO_ROOM, f"{name}: 8589934592 bytes need about 16384 MB", "mesh", "info", sparse(name, b""))
            path = sparse("way.csv", b"x,y,z\n0,0,0\n")
            self.refused(NO_ROOM, "way.csv: 8589934592 bytes need about", "query", "--mesh", "cube", "--detector",
                         "brute-force", "--trajectory", path)

    def test_a_motion_of_more_steps_than_the_memory_holds(self):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "way.csv"
            path.write_text("time_s,x,y,z\n0,0,0,0\n90000,1,0,0\n", encoding="utf-8")
            query = ("query", "--mesh", "cube", "--detector", "brute-force", "--trajectory", str(path), "--rate")
            self.refused(NO_ROOM, "way.csv: 90000001 steps need about", *query, "1000")
            self.refused(REFUSED, "90000 s at --rate 2000 are 180000001 steps", *query, "2000")

    def test_levels_of_subdivision(self):
        with tempfile.TemporaryDirectory() as folder:
            def subdivide(levels):
                return ("mesh", "subdivide", "--mesh", "cube", "--method", "loop", "--levels", levels, "--output",
                        f"{folder}/fine.ply")
            for levels in ("12", "40", "1000000"):
                self.refused(REFUSED, "level 11 of loop would have 50331648 triangles, more than 50000000",
                             *subdivide(levels))
            self.refused(NO_ROOM, "12582912 triangles after level 10 need about 1032 MB", *subdivide("10"))
            self.assertEqual(list(pathlib.Path(folder).iterdir()), [])

    def test_a_budget_that_the_memory_does_not_hold(self):
        self.refused(NO_ROOM, "no memory: 5120 triangles at 1000000000 bytes each need about", *QUERY,
                     "grid-group:cell=1e-9,bytes_per_triangle=1e9")
        self.refused(NO_ROOM, "no memory: 5120 triangles at inf bytes each need about inf MB", *QUERY,
                     "grid-group:bytes_per_triangle=inf")

    def test_cells_that_are_too_many_are_made_larger_and_said(self):
        for lookup in ("direct", "scan"):
            for side in ("", ",side=on"):
                ended = run(*QUERY, f"grid-group:lookup={lookup},cell=1e-9{side}")
                self.assertEqual(ended.returncode, 0, ended.stderr)
                self.assertEqual(ended.stdout.count("\n"), 11)
                self.assertRegex(ended.stderr, r"^touchmark: grid-group:[^ ]*: cells of 1e-09 would take more memory "
                                 r"than they may; the smallest is [0-9.e-]+\n$")

    def test_groups_that_are_left_out_are_said(self):
        ended = run(*QUERY, "grid-group:bytes_per_triangle=210")
        self.assertEqual(ended.returncode, 0, ended.stderr)
        self.assertRegex(ended.stderr, r"within 210 bytes a triangle [0-9]+ of 5120 have a group")

    def test_what_fits_is_built_without_a_word(self):
        for detector in ("grid-group", "grid-group:cell=2%", "grid-group:lookup=scan,cell=2%", "sphere-cluster"):
            ended = run(*QUERY, detector)
            self.assertEqual((ended.returncode, ended.stderr), (0, ""))


if __name__ == "__main__":
    unittest.main()
