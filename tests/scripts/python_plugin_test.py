#!/usr/bin/python3
"""Contestants in Python, as a user runs them: the example of docs/plugins.md, and scripts that misbehave.

Argument: the program.
"""
import csv
import os
import pathlib
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = sys.argv.pop(1)
EXAMPLE = ROOT / "docs" / "examples" / "plugin" / "mine.py"
# The Python of this test comes first where the program looks for one.
ENVIRONMENT = {**os.environ, "PATH": f"/usr/bin:{os.environ['PATH']}"}
SCENE = ("--mesh", "cube", "--trajectory", "slide", "--steps", "40", "--query", "nearest", "--reach", "inf")
FAR = "(center + [0, 0, 1], [0, 0, -1], 1, 0)"
SCRIPT = """
import os, time
class Detector:
    def __init__(self, vertices, faces):
        {build}
    def nearest(self, center, reach):
        {nearest}
"""


def run(*arguments, env=None):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120, check=False, env=env or ENVIRONMENT)


class PythonPlugin(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def script(self, text="", build="pass", nearest=f"return {FAR}"):
        path = self.folder / "mine.py"
        path.write_text(text or SCRIPT.format(build=build, nearest=nearest), encoding="utf-8")
        return path

    def rows(self):
        with open(self.folder / "results.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def verified(self, plugin, *more):
        done = run("verify", *SCENE, "--plugin", plugin, "--out", self.folder, *more)
        return done, self.rows()

    def test_the_example_is_verified_by_each_query_that_it_has(self):
        done = run("verify", "--mesh", "icosphere:1", "--trajectory", "slide", "--trajectory", "jump", "--steps", "100",
                   "--plugin", EXAMPLE)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("400 answers judged exactly", done.stdout)
        self.assertRegex(done.stdout, r"mine-py +approximate +400 +0 +0 .* as claimed")

    def test_what_is_wrong_is_counted(self):
        done, (row,) = self.verified(self.script())
        self.assertEqual(row["wrong_point"], "40")
        self.assertGreater(float(row["max_distance_error"]), 0.5)
        self.assertEqual(row["status"], "ok")
        self.assertEqual(done.returncode, 0)  # it claims nothing
        _, (row,) = self.verified(self.script(nearest="return (center, [float('nan')] * 3, float('nan'), None)"))
        self.assertEqual(row["malformed"], "40")

    def test_its_times_hold_what_python_takes_and_the_way_there_is_told(self):
        plugin = self.script(nearest=f"time.sleep(0.002); return {FAR}")
        done = run("bench", *SCENE, "--plugin", plugin, "--quick", "--no-cold", "--benchmark_repetitions=1",
                   "--benchmark_min_time=0.001", "--out", self.folder)
        (row,) = self.rows()
        self.assertGreater(float(row["ns_per_query"]), 2e6)
        self.assertGreater(float(row["ns_p50"]), 2e6)
        self.assertRegex(done.stderr, r"touchmark: mine: of each of its times [0-9.]+ us are the way to Python and back")

    def test_what_is_no_contestant_is_refused_in_one_line(self):
        for text, why in (("class Detector:\n    x = (\n", "SyntaxError: "), ("import no_such_module_here\n", "No module named"),
                          ("", "class Detector"), ("Detector = 7\n", "class Detector"), ("raise SystemExit(3)\n", "SystemExit: 3"),
                          ("1 / 0\n", "ZeroDivisionError: division by zero (mine.py, line 1)"),
                          ("class Detector:\n    pass\n", "it answers nothing"),
                          ("name = 'a:b'\n" + SCRIPT.format(build="pass", nearest="pass"), '"a:b"'),
                          ("name = 7\n" + SCRIPT.format(build="pass", nearest="pass"), "name is a int"),
                          ("guarantee = 'perfect'\n" + SCRIPT.format(build="pass", nearest="pass"), "perfect"),
                          ("import os\nos.abort()\n", "Python was ended by SIGABRT"),
                          ("import os\nos._exit(5)\n", "Python has ended with status 5")):
            with self.subTest(why):
                path = self.script(text or "\n")
                done = run("verify", *SCENE, "--plugin", path)
                self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
                self.assertIn(f"--plugin {path}: ", done.stderr)
                self.assertIn(why, done.stderr)

    def test_without_python_or_numpy_one_line_says_so(self):
        nowhere = {**ENVIRONMENT, "PATH": str(self.folder)}
        done = run("list", "--plugin", EXAMPLE, env=nowhere)
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr, f"touchmark: --plugin {EXAMPLE}: there is no python3 in PATH, which runs a plug-in in Python\n")
        (self.folder / "numpy.py").write_text("raise ImportError('broken')\n", encoding="utf-8")
        done = run("list", "--plugin", EXAMPLE, env={**ENVIRONMENT, "PYTHONPATH": str(self.folder)})
        self.assertEqual(done.returncode, 2)
        self.assertIn("broken: a plug-in in Python needs numpy\n", done.stderr)

    def test_what_fails_later_has_a_status_and_ends_nothing(self):
        for build, nearest, status in (
                ("raise MemoryError('too many')", "pass", "refused: MemoryError: too many (mine.py, line 5)"),
                ("os._exit(9)", "pass", "refused: Python has ended with status 9"),
                ("while True: pass", "pass", "timeout"),
                ("pass", "return center[7]", "crashed:IndexError: index 7 is out of bounds"),
                ("pass", "os.abort()", "crashed:Python was ended by SIGABRT"),
                ("pass", "exit(4)", "crashed:SystemExit: 4 (mine.py, line 7)"),
                ("pass", "while True: pass", "timeout"),
                ("pass", "return 7", "crashed:ValueError: nearest returned 7; it must return None or (point, normal"),
                ("pass", "return ([0, 0], [0, 0, 1], 1, 0)", "crashed:ValueError: nearest returned a point of the shape (2,)"),
                ("pass", "return (center, center, 1, 1.5)", "crashed:ValueError: nearest returned the triangle 1.5"),
                ("pass", "return (center, center, 'far', 0)", "crashed:ValueError: could not convert string to float")):
            with self.subTest(status):
                _, rows = self.verified(self.script(build=build, nearest=nearest), "--detector", "brute-force", "--timeout", "1.5")
                self.assertEqual([row["status"] for row in rows][0], "ok")
                self.assertTrue(rows[1]["status"].startswith(status), rows[1]["status"])
                self.assertEqual(run("validate", self.folder / "results.csv").returncode, 0)

    def test_no_python_outlives_its_worker(self):
        note = self.folder / "process"
        self.verified(self.script(nearest=f"open({str(note)!r}, 'w').write(str(os.getpid()))\n        while True: pass"),
                      "--timeout", "1")
        process = int(note.read_text(encoding="utf-8"))
        deadline = time.monotonic() + 10
        while pathlib.Path(f"/proc/{process}").exists() and time.monotonic() < deadline:
            time.sleep(0.05)
        stat = pathlib.Path(f"/proc/{process}/stat")
        self.assertTrue(not stat.exists() or stat.read_text(encoding="utf-8").rsplit(")", 1)[1].split()[0] == "Z")


if __name__ == "__main__":
    unittest.main(verbosity=2)
