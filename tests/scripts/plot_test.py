#!/usr/bin/python3
"""scripts/plot on small made-up results, good and bad."""
import csv
import filecmp
import pathlib
import subprocess
import tempfile
import unittest

PLOT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "plot"
COLUMNS = (
    "schema,run_id,detector,options,mesh,triangles,trajectory,query,steps,radius,reach,guarantee,missed,"
    "false_contacts,wrong_triangle,max_distance_error,max_distance_error_ulp,max_normal_angle_deg,unresolved,status,"
    "ns_per_query,ns_p50,ns_p90,ns_p99,ns_p999,ns_max,update_rate_hz,deadline_misses_1khz,longest_miss_run_1khz,"
    "build_ms,first_answer_ms,bytes,heap_bytes,work_mean,work_max,repetitions,beyond_bound,wrong_point,wrong_normal,malformed"
).split(",")
GOOD = {
    "schema": 1, "detector": "grid-group", "mesh": "bunny", "triangles": 69666, "trajectory": "slide",
    "query": "nearest", "steps": 1000, "radius": 0.005, "guarantee": "exact", "missed": 0, "false_contacts": 0, "wrong_triangle": 0,
    "unresolved": 0, "status": "ok", "ns_p50": 100, "ns_p90": 130, "ns_p99": 200, "ns_p999": 400, "ns_max": 2e6,
    "update_rate_hz": 1e7,
}
CRASHED = {
    "schema": 1, "detector": "libccd+aabb", "options": "solver=mpr", "mesh": "bunny", "triangles": 69666,
    "trajectory": "slide", "query": "nearest", "steps": 1000, "radius": 0.005, "status": "crashed",
}


class Plot(unittest.TestCase):
    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.directory = pathlib.Path(self.temporary.name)

    def write(self, *rows):
        with open(self.directory / "results.csv", "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, COLUMNS)
            writer.writeheader()
            writer.writerows(rows)

    def plot(self, *arguments):
        return subprocess.run([PLOT, *(arguments or [self.directory])], capture_output=True, text=True, check=False)

    def pictures(self):
        return sorted(path.name for path in (self.directory / "plots").iterdir())

    def assert_refused(self, message):
        done = self.plot()
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stderr, f"plot: {self.directory}/results.csv: {message}\n")
        self.assertFalse((self.directory / "plots").exists())

    def test_draws_three_pictures_twice(self):
        self.write(GOOD, {**GOOD, "detector": "fcl", "options": "bv=kios", "missed": 3}, CRASHED)
        done = self.plot()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(self.pictures(), [f"{name}.{kind}" for name in ("errors", "latency", "update_rate")
                                           for kind in ("png", "svg")])
        for path in (self.directory / "plots").glob("*.png"):
            self.assertTrue(path.read_bytes().startswith(b"\x89PNG"))

    def test_says_in_the_picture_who_is_who_and_what_went_wrong(self):
        self.write(GOOD, {**GOOD, "trajectory": "jump"}, {**GOOD, "detector": "fcl", "missed": 3}, CRASHED)
        self.plot()
        # matplotlib writes a comment with the text above each run of glyphs
        latency = (self.directory / "plots" / "latency.svg").read_text(encoding="utf-8")
        for text in ("grid-group", "libccd+aabb:solver=mpr", "slide", "jump", "crashed", "1 ms: a 1 kHz tick is over",
                     "bunny (69,666 triangles)"):
            self.assertIn(text, latency)
        errors = (self.directory / "plots" / "errors.svg").read_text(encoding="utf-8")
        for text in ("missed contacts", "3 (0.3 %)", "crashed in slide", "no error"):
            self.assertIn(text, errors)

    def test_gives_the_same_bytes_for_the_same_numbers(self):
        self.write(GOOD, CRASHED)
        self.plot()
        first = self.directory / "first"
        (self.directory / "plots").rename(first)
        self.plot()
        names = [path.name for path in first.iterdir()]
        self.assertEqual(filecmp.cmpfiles(first, self.directory / "plots", names, shallow=False), (names, [], []))

    def test_draws_a_picture_for_each_mesh_and_query(self):
        self.write(GOOD, {**GOOD, "mesh": "a/b.stl"}, {**GOOD, "query": "touches"})
        self.assertEqual(self.plot().returncode, 0)
        self.assertIn("latency-a_b.stl-nearest.png", self.pictures())
        self.assertEqual(len(self.pictures()), 18)

    def test_draws_when_nobody_answered(self):
        self.write(CRASHED, {**CRASHED, "detector": "other", "status": "unsupported"})
        done = self.plot()
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_ignores_columns_it_does_not_know(self):
        COLUMNS.append("joules")
        self.addCleanup(COLUMNS.pop)
        self.write({**GOOD, "joules": "1"})
        self.assertEqual(self.plot().returncode, 0)

    def test_names_what_is_wrong_with_a_file(self):
        results = self.directory / "results.csv"
        self.assert_refused("No such file or directory")
        results.write_text("")
        done = self.plot()
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1))
        results.write_text("detector,options\nfcl,\n")
        done = self.plot()
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1))
        self.assertIn("the header has no column mesh, trajectory", done.stderr)
        self.write()
        self.assert_refused("no row follows the header")
        self.write({**GOOD, "ns_p99": "fast"})
        self.assert_refused("line 2: column ns_p99: 'fast' is not a number")
        self.write(GOOD)
        with open(results, "a", encoding="utf-8") as file:
            file.write("1,2,3\n")
        self.assert_refused("line 3: not as many fields as the header")
        results.write_bytes(b"\x89PNG\xff\xfe\x00\n")
        done = self.plot()
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1))

    def test_shows_an_example_on_request(self):
        done = self.plot("--help")
        self.assertEqual(done.returncode, 0)
        self.assertIn("example: scripts/plot out", done.stdout)

    def test_refuses_a_missing_argument(self):
        done = subprocess.run([PLOT], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 2)


if __name__ == "__main__":
    unittest.main()
