#!/usr/bin/python3
"""scripts/plot-papers on what the program (the argument) leaves of tiny experiments, and its rasteriser."""
import pathlib
import shutil
import struct
import subprocess
import sys
import tempfile
import unittest

import numpy

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
PROGRAM = sys.argv.pop(1) if len(sys.argv) > 1 and not sys.argv[1].startswith("-") else None
sys.dont_write_bytecode = True
sys.path.insert(0, str(SCRIPTS))

from drawing import raster  # noqa: E402


def plot(directory):
    return subprocess.run([SCRIPTS / "plot-papers", directory, "--pixels", "40"], capture_output=True, text=True, check=False)


class Figures(unittest.TestCase):
    def draw(self, paper, mesh):
        if PROGRAM is None:
            self.skipTest("no program was named")
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        subprocess.run([PROGRAM, "paper", paper, "--quick", "--steps", "5", "--mesh", mesh, "--out", temporary.name],
                       capture_output=True, check=True)
        done = plot(temporary.name)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        figures = sorted((pathlib.Path(temporary.name) / "figures").iterdir())
        for path in figures:
            header = path.read_bytes()[:24]
            self.assertTrue(header.startswith(b"\x89PNG"), path)
            self.assertGreater(min(struct.unpack(">II", header[16:24])), 300, path)
        return [path.stem for path in figures]

    def test_of_choi_and_sung_are_all_drawn(self):
        names = self.draw("choi-sung-2017", "icosphere:1")
        self.assertEqual(sorted({name.split("_")[0] for name in names if name.startswith("fig")}),
                         [f"fig{n:02}" for n in range(1, 12)])
        self.assertIn("fig02_closeup", names)
        self.assertIn("fig04_fig05", names)
        self.assertIn("frontier", names)
        self.assertIn("levels", names)
        self.assertIn("fast_forms", names)

    def test_of_park_and_jang_are_all_drawn(self):
        self.assertEqual(self.draw("park-jang-2018", "icosphere:2"),
                         ["fig01_03_grouping", "fig04_model", "fig05_cube_groups", "fig06_sphere_groups",
                          "fig07_operations", "fig07_time"])

    def test_of_a_recording_are_drawn_where_the_recording_has_what_they_need(self):
        for paper, charts, rendered in (("choi-sung-2017", "fig03_volume", "fig02_surfaces"),
                                        ("park-jang-2018", "fig07_time", "fig05_cube_groups")):
            with tempfile.TemporaryDirectory() as folder:
                for table in (SCRIPTS.parent / "results" / "papers" / paper).glob("*.csv"):
                    shutil.copy(table, folder)
                done = plot(folder)
                self.assertEqual((done.returncode, done.stderr), (0, ""))
                self.assertIn(f"{rendered}: left out: no {folder}/pictures", done.stdout)
                figures = [path.name for path in (pathlib.Path(folder) / "figures").iterdir()]
                self.assertIn(f"{charts}.png", figures)
                self.assertNotIn(f"{rendered}.png", figures)

    def test_names_a_file_that_is_missing(self):
        with tempfile.TemporaryDirectory() as folder:
            recorded = SCRIPTS.parent / "results" / "papers" / "park-jang-2018" / "times.csv"
            shutil.copy(recorded, folder)
            (pathlib.Path(folder) / "pictures").mkdir()
            done = plot(folder)
            self.assertEqual((done.returncode, done.stderr),
                             (2, f"plot-papers: {folder}/pictures/original-mesh.csv: cannot be read\n"))

    def test_refuses_a_folder_without_results(self):
        with tempfile.TemporaryDirectory() as empty:
            done = plot(empty)
            self.assertEqual(done.returncode, 2)
            self.assertEqual(done.stderr, f"plot-papers: {empty}: neither table1.csv nor times.csv is there\n")

    def test_says_what_is_not_as_the_program_writes_it(self):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "table1.csv").write_text("method,level\nls3,1\n", encoding="utf-8")
            done = plot(folder)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertIn("clustering", done.stderr)


class Raster(unittest.TestCase):
    BOX = numpy.array([[-1.0, -1, -1], [1, 1, 1]])

    def picture(self):
        return raster.Picture(self.BOX, 100, numpy.eye(3), margin=0)

    def test_fills_a_triangle_by_its_area(self):
        picture = self.picture()
        picture.triangles(numpy.array([[[-1.0, -1, 0], [1, -1, 0], [-1, 1, 0]]]), lines=False)
        self.assertAlmostEqual((picture.image() < 1).mean(), 0.5, delta=0.02)

    def test_leaves_out_a_triangle_seen_from_behind(self):
        picture = self.picture()
        picture.triangles(numpy.array([[[-1.0, -1, 0], [-1, 1, 0], [1, -1, 0]]]), lines=False)
        self.assertTrue((picture.image() == 1).all())

    def test_draws_a_sphere_round(self):
        picture = self.picture()
        picture.spheres(numpy.zeros((1, 3)), numpy.array([0.5]))
        self.assertAlmostEqual((picture.image() < 1).mean(), numpy.pi / 16, delta=0.01)

    def test_shows_the_nearer_of_two_whichever_comes_first(self):
        pictures = []
        for order in ([0, 1], [1, 0]):
            picture = self.picture()
            for k in order:
                picture.spheres(numpy.array([[0, 0, 0.4 * k]]), numpy.array([0.5]), brightness=[0.9, 0.4][k])
            pictures.append(picture.image())
        self.assertTrue((pictures[0] == pictures[1]).all())
        self.assertLess(pictures[0][50, 50], 0.45)

    def test_turns_the_front_of_a_box_to_the_viewer(self):
        picture = self.picture()
        picture.boxes(numpy.array([[-0.5, -0.5, -0.5]]), numpy.array([[0.5, 0.5, 0.5]]))
        self.assertAlmostEqual((picture.image() < 1).mean(), 0.25, delta=0.02)


if __name__ == "__main__":
    unittest.main()
