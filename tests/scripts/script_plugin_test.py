#!/usr/bin/python3
"""Contestants in Python and JavaScript, as a user runs them: examples of docs/plugins.md, and scripts that misbehave.

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
EXAMPLES = ROOT / "docs" / "examples" / "plugin"
# The Python of this test comes first where the program looks for one.
ENVIRONMENT = {**os.environ, "PATH": f"/usr/bin:{os.environ['PATH']}"}
SCENE = ("--mesh", "cube", "--trajectory", "slide", "--steps", "40", "--query", "nearest", "--reach", "inf")


def run(*arguments, env=None):
    return subprocess.run([PROGRAM, *arguments], capture_output=True, text=True, timeout=120, check=False,
                          env=env or ENVIRONMENT)


class Scripts:
    """What holds in each language."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def script(self, text="", **parts):
        path = self.folder / self.FILE
        path.write_text(text or self.text(**parts), encoding="utf-8")
        return path

    def rows(self):
        with open(self.folder / "results.csv", newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def verified(self, plugin, *more, env=None):
        done = run("verify", *SCENE, "--plugin", plugin, "--out", self.folder, *more, env=env)
        return done, self.rows()

    def test_the_example_is_verified_by_each_query_that_it_has(self):
        done = run("verify", "--mesh", "icosphere:1", "--trajectory", "slide", "--trajectory", "jump", "--steps", "100",
                   "--plugin", EXAMPLES / self.FILE)
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("400 answers judged exactly", done.stdout)
        self.assertRegex(done.stdout, rf"{self.NAME} +approximate +400 +0 +0 .* as claimed")

    def test_a_new_plugin_is_the_example(self):
        done = run("new-plugin", self.folder / "new", "--language", self.LANGUAGE.lower())
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn(f"--plugin {self.folder}/new/{self.FILE}\n", done.stdout)
        self.assertEqual([path.name for path in (self.folder / "new").iterdir()], [self.FILE])
        self.assertEqual((self.folder / "new" / self.FILE).read_bytes(), (EXAMPLES / self.FILE).read_bytes())

    def test_what_is_wrong_is_counted(self):
        done, (row,) = self.verified(self.script())
        self.assertEqual(row["wrong_point"], "40")
        self.assertGreater(float(row["max_distance_error"]), 0.5)
        self.assertEqual(row["status"], "ok")
        self.assertEqual(done.returncode, 0)  # it claims nothing
        _, (row,) = self.verified(self.script(nearest=self.NOT_A_NUMBER))
        self.assertEqual(row["malformed"], "40")

    def test_its_times_hold_what_the_script_takes_and_the_way_there_is_told(self):
        plugin = self.script(nearest=self.SLOW)
        done = run("bench", *SCENE, "--plugin", plugin, "--quick", "--no-cold", "--benchmark_repetitions=1",
                   "--benchmark_min_time=0.001", "--out", self.folder)
        (row,) = self.rows()
        self.assertGreater(float(row["ns_per_query"]), 2e6)
        self.assertGreater(float(row["ns_p50"]), 2e6)
        self.assertRegex(done.stderr,
                         rf"touchmark: mine: of each of its times [0-9.]+ us are the way to {self.LANGUAGE} and back")

    def test_what_is_no_contestant_is_refused_in_one_line(self):
        for text, why in self.refused():
            with self.subTest(why):
                path = self.script(text or "\n")
                done = run("verify", *SCENE, "--plugin", path)
                self.assertEqual((done.returncode, done.stdout), (2, ""), done.stderr)
                self.assertEqual(done.stderr.count("\n"), 1, done.stderr)
                self.assertIn(f"--plugin {path}: ", done.stderr)
                self.assertIn(why, done.stderr)

    def test_without_the_interpreter_one_line_says_what_to_install(self):
        example = EXAMPLES / self.FILE
        done = run("list", "--plugin", example, env={**ENVIRONMENT, "PATH": str(self.folder)})
        self.assertEqual(done.returncode, 2)
        self.assertEqual(done.stderr, f"touchmark: --plugin {example}: there is no {self.COMMAND} in PATH, which runs "
                                      f"a plug-in in {self.LANGUAGE}: apt-get install {self.PACKAGE}\n")

    def test_what_fails_later_has_a_status_and_ends_nothing(self):
        for build, nearest, status in self.failures():
            with self.subTest(status):
                plugin = self.script(build=build, nearest=nearest)
                timeout = "4" if status == "timeout" else "60"
                _, rows = self.verified(plugin, "--detector", "brute-force", "--timeout", timeout)
                self.assertEqual([row["status"] for row in rows][0], "ok")
                self.assertTrue(rows[1]["status"].startswith(status), rows[1]["status"])
                self.assertEqual(run("validate", self.folder / "results.csv").returncode, 0)

    def test_no_interpreter_outlives_its_worker(self):
        note = self.folder / "process"
        self.verified(self.script(nearest=self.HANGS.format(note=note)), "--timeout", "10")
        process = int(note.read_text(encoding="utf-8"))
        deadline = time.monotonic() + 10
        while pathlib.Path(f"/proc/{process}").exists() and time.monotonic() < deadline:
            time.sleep(0.05)
        stat = pathlib.Path(f"/proc/{process}/stat")
        self.assertTrue(not stat.exists() or stat.read_text(encoding="utf-8").rsplit(")", 1)[1].split()[0] == "Z")


class PythonPlugin(Scripts, unittest.TestCase):
    LANGUAGE, COMMAND, PACKAGE = "Python", "python3", "python3-numpy"
    FILE, NAME = "mine.py", "mine-py"
    FAR = "return (center + [0, 0, 1], [0, 0, -1], 1, 0)"
    NOT_A_NUMBER = "return (center, [float('nan')] * 3, float('nan'), None)"
    SLOW = f"time.sleep(0.002); {FAR}"
    HANGS = "open('{note}', 'w').write(str(os.getpid()))\n        while True: pass"

    @staticmethod
    def text(build="pass", nearest=FAR):
        return f"""
import os, time
class Detector:
    def __init__(self, vertices, faces):
        {build}
    def nearest(self, center, reach):
        {nearest}
"""

    def refused(self):
        return (("class Detector:\n    x = (\n", "SyntaxError: "),
                ("import no_such_module_here\n", "No module named"),
                ("", "class Detector"), ("Detector = 7\n", "class Detector"),
                ("raise SystemExit(3)\n", "SystemExit: 3"),
                ("1 / 0\n", "ZeroDivisionError: division by zero (mine.py, line 1)"),
                ("class Detector:\n    pass\n", "it answers nothing"),
                ("name = 'a:b'\n" + self.text(), '"a:b"'), ("name = 7\n" + self.text(), "name is a int"),
                ("guarantee = 'perfect'\n" + self.text(), "perfect"),
                ("import os\nos.abort()\n", "Python was ended by SIGABRT"),
                ("import os\nos._exit(5)\n", "Python has ended with status 5"))

    def test_without_numpy_one_line_says_so(self):
        (self.folder / "numpy.py").write_text("raise ImportError('broken')\n", encoding="utf-8")
        done = run("list", "--plugin", EXAMPLES / self.FILE, env={**ENVIRONMENT, "PYTHONPATH": str(self.folder)})
        self.assertEqual(done.returncode, 2)
        self.assertIn("broken: a plug-in in Python needs numpy\n", done.stderr)

    def failures(self):
        return (
            ("raise MemoryError('too many')", "pass", "refused: MemoryError: too many (mine.py, line 5)"),
            ("os._exit(9)", "pass", "refused: Python has ended with status 9"),
            ("while True: pass", "pass", "timeout"),
            ("pass", "return center[7]", "crashed:IndexError: index 7 is out of bounds"),
            ("pass", "os.abort()", "crashed:Python was ended by SIGABRT"),
            ("pass", "exit(4)", "crashed:SystemExit: 4 (mine.py, line 7)"),
            ("pass", "while True: pass", "timeout"),
            ("pass", "return 7", "crashed:ValueError: nearest returned 7; it must return None or (point, normal"),
            ("pass", "return ([0, 0], [0, 0, 1], 1, 0)",
             "crashed:ValueError: nearest returned a point of the shape (2,)"),
            ("pass", "return (center, center, 1, 1.5)", "crashed:ValueError: nearest returned the triangle 1.5"),
            ("pass", "return (center, center, 'far', 0)", "crashed:ValueError: could not convert string to float"))


class JavaScriptPlugin(Scripts, unittest.TestCase):
    LANGUAGE, COMMAND, PACKAGE = "JavaScript", "node", "nodejs"
    FILE, NAME = "mine.mjs", "mine-js"
    FAR = "return {point: [center[0], center[1], center[2] + 1], normal: [0, 0, -1], distance: 1, triangle: 0};"
    NOT_A_NUMBER = "return {point: center, normal: [NaN, NaN, NaN], distance: NaN};"
    SLOW = f"const end = performance.now() + 2; while (performance.now() < end); {FAR}"
    HANGS = "fs.writeFileSync('{note}', String(process.pid)); while (true);"

    @staticmethod
    def text(build="", nearest=FAR, before=""):
        return f"""{before}
import fs from "fs";
let built = 0;
export async function build(vertices, triangles) {{
  if (built++ > 0) {{ {build} }}
  return {{ nearest(center, reach) {{
    {nearest}
  }} }};
}}
"""

    def refused(self):
        def built(text):
            return f"export function build() {{\n{text}\n}}\n"
        return (("\nconst x = (;\n", "SyntaxError: Unexpected token ';' (mine.mjs, line 2)"),
                ("import 'no-such-package-here';\n", "Cannot find package 'no-such-package-here'"),
                ("", "it exports no function build"), ("export const build = 7;\n", "it exports no function build"),
                ("process.exit(5);\n", "node has ended with status 5"),
                ("process.abort();\n", "node was ended by SIGABRT"),
                ("\nnull.x;\n", "(mine.mjs, line 2)"), ("throw 'a text';\n", "thrown: 'a text'"),
                ("await new Promise(() => {});\n", "a promise is never settled"),
                (built("setTimeout(() => { throw Error('late'); }); return new Promise(() => {});"),
                 "Error: late (mine.mjs, line 2)"),
                (built(""), "build returned undefined; it must return an object with the queries"),
                (built("throw Error('no cubes');"), "build, tried with a cube: Error: no cubes (mine.mjs, line 2)"),
                (built("return {};"), "it answers nothing"),
                (self.text(before="export const name = 'a:b';"), '"a:b"'),
                (self.text(before="export const name = 7;"), "name is 7; it must be a string"),
                (self.text(before="export const guarantee = 'perfect';"), "perfect"))

    def failures(self):
        return (
            ("throw RangeError('too many')", "", "refused: RangeError: too many (mine.mjs, line 5)"),
            ("process.exit(9)", "", "refused: node has ended with status 9"),
            ("await new Promise(() => {})", "", "refused: Error: a promise is never settled"),
            ("while (true);", "", "timeout"),
            ("", "return center.x.y;",
             "crashed:TypeError: Cannot read properties of undefined (reading 'y') (mine.mjs, line 7)"),
            ("", "process.abort();", "crashed:node was ended by SIGABRT"),
            ("", "while (true);", "timeout"),
            ("", "return Promise.resolve(null);",
             "crashed:TypeError: nearest returned a promise; it must return its answer"),
            ("", "return 7;", "crashed:TypeError: nearest returned 7; it must return null or {point, normal"),
            ("", "", "crashed:TypeError: nearest returned undefined; it must return null or {point, normal"),
            ("", "return {point: [0, 0], normal: center, distance: 1};",
             "crashed:TypeError: nearest returned the point [ 0, 0 ]; it must hold 3 numbers"),
            ("", "return {point: center, normal: [0, 0, '1'], distance: 1};",
             "crashed:TypeError: nearest returned the normal '1'; it must be a number"),
            ("", "return {point: center, normal: center, distance: 1, triangle: 1.5};",
             "crashed:TypeError: nearest returned the triangle 1.5"),
            ("", "return {point: center, normal: center};",
             "crashed:TypeError: nearest returned the distance undefined; it must be a number"))

    def test_a_node_that_is_too_old_is_refused(self):
        pretence = "Object.defineProperty(process, 'versions', {value: {node: '16.20.2'}});"
        (self.folder / "old.cjs").write_text(pretence, encoding="utf-8")
        node = self.folder / "node"
        node.write_text(f"#!/bin/sh\nPATH=${{PATH#*:}} exec node -r {self.folder}/old.cjs \"$@\"\n", encoding="utf-8")
        node.chmod(0o755)
        path = f"{self.folder}:{ENVIRONMENT['PATH']}"
        done = run("list", "--plugin", EXAMPLES / self.FILE, env={**ENVIRONMENT, "PATH": path})
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        self.assertIn("the node in PATH is 16.20.2; a plug-in in JavaScript needs 18 or newer: "
                      "apt-get install nodejs\n", done.stderr)

    def test_packages_are_found_from_its_folder_upward_and_may_load_slowly(self):
        package = self.folder / "node_modules" / "engine"
        package.mkdir(parents=True)
        (package / "package.json").write_text('{"name": "engine", "main": "main.js"}', encoding="utf-8")
        (package / "main.js").write_text(
            "module.exports = {load: () => new Promise((done) => setTimeout(done, 50, {far: 1}))};", encoding="utf-8")
        (self.folder / "inner").mkdir()
        path = self.folder / "inner" / self.FILE
        path.write_text(self.text(before="import engine from 'engine'; const loaded = await engine.load();",
                                  nearest="return loaded.far === 1 ? null : undefined;"), encoding="utf-8")
        _, (row,) = self.verified(path)
        self.assertEqual((row["status"], row["missed"]), ("ok", "40"))

    def test_sweeps_have_a_fraction_and_what_is_built_is_destroyed(self):
        path = self.script("""
import fs from "fs";
export function build() {
  return {
    first_hit(from, to, radius) {
      return {fraction: 0.25, point: [...from], normal: Float64Array.of(0, 0, 1), distance: radius};
    },
    destroy() { fs.appendFileSync(new URL("destroyed", import.meta.url), "x"); },
  };
}
""")
        done = run("query", "--mesh", "cube", "--trajectory", "slide", "--steps", "3", "--query", "sweep",
                   "--radius", "0.5", "--plugin", path)
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = list(csv.DictReader(done.stdout.splitlines()))
        self.assertEqual({(row["distance"], row["normal_z"]) for row in rows}, {("0.5", "1")})
        self.assertTrue((self.folder / "destroyed").read_text(encoding="utf-8").startswith("x"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
