#!/usr/bin/python3
"""The schemas in results/ as Debian's validator reads them, and whether `touchmark validate` judges alike.

Argument: the program.
"""
import copy
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

try:
    import jsonschema
except ImportError:  # scripts/setup test installs it
    jsonschema = None

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = sys.argv.pop(1)
RECORDED = sorted(ROOT.glob("results/*/*/run.json"))
DAMAGED = [  # path to a member, and what stands there instead; None: nothing
    (["schema"], 2), (["run_id"], "x"), (["date"], "yesterday"), (["finished"], 1), (["cores"], 0), (["cores"], 2.5),
    (["cores"], 2.0), (["load_average"], [1, 2]), (["load_average"], [1, 2, -3]), (["workers_core"], "any"),
    (["workers_core"], "all"), (["libraries"], {"fmt": 9}), (["mesh", "fnv1a"], "12"), (["mesh", "triangles"], None),
    (["query"], "near"), (["simd"], "sse9"), (["radius"], "inf"), (["radius"], "0.5"), (["reach"], "radius"), (["reach"], -1),
    (["trajectories"], []), (["trajectories", 0, "steps"], 0), (["contestants", 1, "options"], {"a": 1}),
    (["contestants", 1, "name"], None), (["clock"], None), (["new_member"], "is allowed"),
]


@unittest.skipIf(jsonschema is None, "python3-jsonschema is missing")
class RunSchema(unittest.TestCase):
    def setUp(self):
        self.schema = json.loads((ROOT / "bench/results/schemas/run.schema.json").read_text(encoding="utf-8"))
        self.validator = jsonschema.Draft7Validator(self.schema)

    def accepted_by_program(self, run):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "run.json"
            path.write_text(json.dumps(run), encoding="utf-8")
            done = subprocess.run([PROGRAM, "validate", path], capture_output=True, check=False)
        self.assertIn(done.returncode, (0, 1), done.stderr)
        return done.returncode == 0

    def test_is_a_schema(self):
        jsonschema.Draft7Validator.check_schema(self.schema)

    def test_accepts_what_is_recorded(self):
        self.assertTrue(RECORDED)
        for path in RECORDED:
            self.validator.validate(json.loads(path.read_text(encoding="utf-8")))

    def test_accepts_what_the_program_writes_of_a_stress_run(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([PROGRAM, "stress", "--detector", "brute-force", "--family", "tangent", "--probes", "30", "--out",
                            folder], capture_output=True, check=True)
            run = json.loads((pathlib.Path(folder) / "run.json").read_text(encoding="utf-8"))
        self.validator.validate(run)
        self.assertTrue(self.accepted_by_program(run))
        del run["families"]
        self.assertFalse(self.validator.is_valid(run))
        self.assertFalse(self.accepted_by_program(run))

    def test_accepts_what_the_program_writes(self):
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([PROGRAM, "bench", "--mesh", "icosphere:0", "--quick", "--no-cold", "--steps", "10", "--trajectory", "slide",
                            "--reach", "inf", "--detector", "brute-force", "--out", folder, "--benchmark_min_time=0.001"],
                           capture_output=True, check=True)
            run = json.loads((pathlib.Path(folder) / "run.json").read_text(encoding="utf-8"))
        self.validator.validate(run)
        self.assertTrue(self.accepted_by_program(run))

    def test_means_the_same_to_the_program(self):
        runs = [json.loads(path.read_text(encoding="utf-8")) for path in RECORDED]
        run = next(run for run in runs if "mesh" in run)  # a stress run has families instead
        verdicts = set()
        for path, value in DAMAGED:
            damaged = copy.deepcopy(run)
            inner = damaged
            for key in path[:-1]:
                inner = inner[key]
            if value is None:
                del inner[path[-1]]
            else:
                inner[path[-1]] = value
            verdict = self.validator.is_valid(damaged)
            self.assertEqual(self.accepted_by_program(damaged), verdict, (path, value))
            verdicts.add(verdict)
        self.assertEqual(verdicts, {False, True})


@unittest.skipIf(jsonschema is None, "python3-jsonschema is missing")
class VisitedSchema(unittest.TestCase):
    def test_accepts_what_the_program_writes(self):
        schema = json.loads((ROOT / "bench/results/schemas/visited.schema.json").read_text(encoding="utf-8"))
        jsonschema.Draft7Validator.check_schema(schema)
        with tempfile.TemporaryDirectory() as folder:
            subprocess.run([PROGRAM, "bench", "--mesh", "icosphere:1", "--quick", "--no-cold", "--steps", "40", "--trajectory", "slide",
                            "--detector", "grid-group", "--detector", "brute-force", "--out", folder, "--benchmark_min_time=0.001"],
                           capture_output=True, check=True)
            self.assertFalse((pathlib.Path(folder) / "visited.json").exists())
            report = [ROOT / "scripts" / "report", "--visits", folder]
            done = subprocess.run(report, env={**os.environ, "TOUCHMARK_PROGRAM": "/nowhere/touchmark"}, capture_output=True, text=True, check=False)
            self.assertEqual((done.returncode, done.stderr), (2, "report: there is no touchmark-tracer beside /nowhere/touchmark; "
                                                                 "scripts/build-program touchmark-tracer builds it\n"))
            subprocess.run(report, env={**os.environ, "TOUCHMARK_PROGRAM": PROGRAM}, capture_output=True, check=True)
            visited = json.loads((pathlib.Path(folder) / "visited.json").read_text(encoding="utf-8"))
        validator = jsonschema.Draft7Validator(schema)
        validator.validate(visited)
        self.assertEqual([(row["detector"], len(row["steps"])) for row in visited["rows"]], [("grid-group", 10)])
        del visited["rows"][0]["steps"][0]["found"]
        self.assertFalse(validator.is_valid(visited))


if __name__ == "__main__":
    unittest.main()
