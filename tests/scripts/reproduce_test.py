#!/usr/bin/python3
"""touchmark verify --reproduce: scripts that show what a plug-in answers wrongly.

Argument: the program.
"""
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

EXAMPLES = pathlib.Path(__file__).resolve().parents[2] / "docs" / "examples" / "plugin"
PROGRAM = sys.argv.pop(1)
ENVIRONMENT = {**os.environ, "PATH": f"/usr/bin:{os.environ['PATH']}"}
# It loses the last triangle of a mesh, and finds things twice as far as they are if "FAR" is 1.
PYTHON = """
import importlib.util, numpy as np
spec = importlib.util.spec_from_file_location("honest", {example!r})
honest = importlib.util.module_from_spec(spec)
spec.loader.exec_module(honest)
name, error = "liar", 0.0
class Detector:
    def __init__(self, vertices, faces):
        self.honest = honest.Detector(vertices, faces[:len(faces) - {lost}])
    def nearest(self, center, reach):
        found = self.honest.nearest(center, reach)
        return found and (found[0], found[1], {factor} * found[2], found[3])
"""
JAVASCRIPT = """
import {{ build as honest }} from {example!r};
export const name = "liar";
export const build = (vertices, triangles) => honest(vertices, triangles.slice(0, triangles.length - 3));
"""


class Reproduce(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.found = self.folder / "found"

    def liar(self, more="", lost=1, factor=1):
        path = self.folder / "liar.py"
        path.write_text(PYTHON.format(example=str(EXAMPLES / "mine.py"), lost=lost, factor=factor) + more, encoding="utf-8")
        return path

    def verify(self, plugin, *more):
        done = subprocess.run([PROGRAM, "verify", "--mesh", "cube", "--trajectory", "slide", "--trajectory", "jump", "--steps", "400", "--plugin", plugin,
                               "--reproduce", self.found, *more], capture_output=True, text=True, timeout=300, check=False, env=ENVIRONMENT)
        self.assertEqual(done.returncode, 0, done.stderr)  # who claims nothing breaks no claim
        return {path.name: path.read_text(encoding="utf-8") for path in self.found.iterdir()}, done

    def run_script(self, interpreter, name):
        done = subprocess.run([interpreter, self.found / name], capture_output=True, text=True, timeout=60, check=False, env=ENVIRONMENT)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout

    def test_a_lost_triangle_is_shown_by_two(self):
        scripts, done = self.verify(self.liar())
        script = scripts["liar-cube-nearest-missed.py"]
        self.assertRegex(script, r"^# missed by nearest, 2 of cube's 12 triangles: the distance is \d")
        self.assertLessEqual(script.count("\n"), 40)
        self.assertIn("liar-cube-nearest-missed.py: 2 of 12 triangles", done.stderr)
        self.assertEqual(self.run_script("/usr/bin/python3", "liar-cube-nearest-missed.py"), "answer: None\n")

    def test_a_distance_needs_one_triangle(self):
        scripts, _ = self.verify(self.liar(lost=0, factor=1.25))
        script = scripts["liar-cube-nearest-distance.py"]
        self.assertIn("1 of cube's 12 triangles", script)
        true = float(re.search(r"the distance is (\S+)", script)[1])
        said = self.run_script("/usr/bin/python3", "liar-cube-nearest-distance.py")
        self.assertAlmostEqual(self.distance_in(said), 1.25 * true)

    def distance_in(self, said):
        return float(re.findall(r"[-\d.]+(?:e-?\d+)?", said)[-2])

    def test_a_plugin_that_can_writes_the_script(self):
        scripts, done = self.verify(self.liar("def reproduce(vertices, faces, query):\n"
                                              "    return f'{len(faces)} faces, {query[\"query\"]}\\n' + 'x\\n' * 60\n"))
        header, text = scripts["liar-cube-nearest-missed.py"].splitlines()[:2]
        self.assertTrue(header.startswith("# missed by nearest"), header)
        self.assertEqual(text, "2 faces, nearest")
        self.assertIn("62 lines, more than 40", done.stderr)

    def test_javascript_imports_the_plugin(self):
        path = self.folder / "liar.mjs"
        path.write_text(JAVASCRIPT.format(example=str(EXAMPLES / "mine.mjs")), encoding="utf-8")
        scripts, _ = self.verify(path)
        name, = (name for name in scripts if name.endswith("nearest-missed.mjs"))
        self.assertRegex(scripts[name], r"^// missed by nearest, \d of cube's 12 triangles")
        self.assertEqual(self.run_script("node", name), "answer: null\n")

    def test_an_honest_plugin_leaves_nothing(self):
        scripts, done = self.verify(EXAMPLES / "mine.py")
        self.assertEqual(scripts, {}, done.stderr)

    def test_scenes_are_refused_in_one_line(self):
        done = subprocess.run([PROGRAM, "verify", "--scene", "field:3", "--plugin", self.liar(), "--reproduce", self.found],
                              capture_output=True, text=True, timeout=60, check=False, env=ENVIRONMENT)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        self.assertIn("--mesh", done.stderr)


if __name__ == "__main__":
    unittest.main()
