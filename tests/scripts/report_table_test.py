#!/usr/bin/python3
"""scripts/report-table and scripts/busy-trials on made results."""
import csv
import pathlib
import subprocess
import tempfile
import unittest

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
ROW = {"schema": 1, "run_id": "r", "detector": "a", "options": "", "mesh": "m", "triangles": 10, "trajectory": "slide",
       "query": "nearest", "steps": 2000, "radius": 0.5, "reach": 0.5, "guarantee": "exact", "missed": 0,
       "false_contacts": 0, "wrong_triangle": 0, "unresolved": 0, "beyond_bound": 0, "wrong_point": 0, "wrong_normal": 0,
       "malformed": 0, "max_distance_error": 0, "status": "ok", "ns_per_query": 5000, "ns_p50": 90, "ns_p90": 100,
       "ns_p99": 200, "ns_p999": 400, "ns_max": 9000, "update_rate_hz": 2e5, "ns_undisturbed": 100,
       "ns_undisturbed_low": 98, "ns_undisturbed_high": 103, "disturbed_share": 0.1}

# Says of "a" what it always takes, and of "b" what depends on the number of the run.
BENCH = """#!/usr/bin/python3
import csv, json, pathlib, sys
folder = pathlib.Path(sys.argv[sys.argv.index("--out") + 1])
count = pathlib.Path(COUNT)
number = int(count.read_text()) if count.exists() else 0
count.write_text(str(number + 1))
rows = [dict(detector="a", options="", trajectory="slide", guarantee="exact", ns_undisturbed=100, ns_undisturbed_low=99,
             ns_undisturbed_high=101, ns_per_query=900 if number % 2 else 100, disturbed_share=0),
        dict(detector="b", options="x=1", trajectory="slide", guarantee="exact", ns_undisturbed=[OTHER][number % 4],
             ns_undisturbed_low=99, ns_undisturbed_high=101, ns_per_query=150, disturbed_share=0)]
with open(folder / "results.csv", "w", newline="") as file:
    writer = csv.DictWriter(file, rows[0])
    writer.writeheader()
    writer.writerows(rows)
about = {"steadiness": [{"trajectory": "slide", "conclusive": number != INCONCLUSIVE, "control": {"ratio": 1}}]}
(folder / "run.json").write_text(json.dumps(about))
sys.exit(STATUS)
"""


def cells(line):
    return [cell.strip() for cell in line.split("|")[1:-1]]


class ReportTable(unittest.TestCase):
    def table(self, rows, *more):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "results.csv"
            with open(path, "w", newline="", encoding="utf-8") as file:
                writer = csv.DictWriter(file, rows[0])
                writer.writeheader()
                writer.writerows(rows)
            return subprocess.run([SCRIPTS / "report-table", path, *more], capture_output=True, text=True, check=False)

    def test_tells_times_over_the_reference_and_their_mean(self):
        rows = [{**ROW, "detector": name, "options": options, "trajectory": trajectory, "ns_undisturbed": ns}
                for name, options, times in (("b", "x=1", (300, 1200)), ("b", "", (500, 1300)), ("a", "", (100, 100)))
                for trajectory, ns in zip(("slide", "jump"), times)]
        gone = {**ROW, "detector": "d", "status": "timeout", **{name: "" for name in ROW if name.startswith("ns_")},
                "update_rate_hz": ""}
        done = self.table([*rows, gone])
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = [cells(line) for line in done.stdout.splitlines()]
        self.assertEqual(lines[0], ["detector", "slide", "jump", "all", "exact"])
        self.assertEqual(lines[2:], [["`a`", "1", "1", "1", "yes"], ["`b:x=1`", "3", "12", "6", "yes"],
                                     ["`d`", "timeout", "", "", ""]])
        self.assertIn("| `b:x=1` | 300 | 1,200 | 600 | yes |", self.table(rows, "--absolute").stdout)
        self.assertIn("| `a` | 0.33 |", self.table(rows, "--reference", "b:x=1").stdout)

    def test_tells_times_with_emptied_caches_beside_the_warm_ones(self):
        rows = [{**ROW, "detector": name, "trajectory": trajectory, "ns_undisturbed": warm, "cold_ns_p50": cold}
                for name, warm, colds in (("a", 100, (1000, 500)), ("b", 300, (2000, 4000)))
                for trajectory, cold in zip(("hand", "jump"), colds)]
        lines = [cells(line) for line in self.table(rows).stdout.splitlines()]
        self.assertEqual(lines[2:], [["`a`", "1 / 1", "1 / 1", "1 / 1", "yes"], ["`b`", "3 / 2", "3 / 8", "3 / 4", "yes"]])
        self.assertIn("| `b` | 300 / 2,000 |", self.table(rows, "--absolute").stdout)

    def test_has_a_row_for_each_of_the_eight_fastest_detectors(self):
        rows = [{**ROW, "detector": name, "options": options, "ns_undisturbed": 100 + 10 * k}
                for k, name in enumerate("ihgfedcba") for options in ("slow=1", "")]
        rows += [{**ROW, "detector": "a", "options": "quick=1", "ns_undisturbed": 50}]
        lines = [cells(line)[0] for line in self.table(rows).stdout.splitlines()[2:]]
        self.assertEqual(lines, ["`a:quick=1`", *(f"`{name}:slow=1`" for name in "ihgfedc")])

    def test_says_who_is_exact(self):
        found = {"b": dict(rounding=9), "c": dict(guarantee="approximate"), "e": dict(beyond_tolerance=4, missed=1, rounding=7)}
        rows = [{**ROW, "beyond_tolerance": 0, "rounding": 0}]
        rows += [{**rows[0], "detector": name, "ns_undisturbed": 200 + k, **errors} for k, (name, errors) in enumerate(found.items())]
        lines = [cells(line)[-1] for line in self.table(rows).stdout.splitlines()[2:]]
        self.assertEqual(lines, ["yes", "to rounding", "to rounding", "no, 5 of 2,000 off"])

    def test_refuses_what_it_cannot_put_in_relation(self):
        for rows, more, text in (([ROW, ROW], [], "twice"), ([{**ROW, "missed": 1}], [], "no exact contestant"),
                                 ([ROW], ["--reference", "z"], "--reference z")):
            done = self.table(rows, *more)
            self.assertEqual(done.returncode, 2)
            self.assertIn(text, done.stderr)
            self.assertEqual(len(done.stderr.splitlines()), 1)


class BusyTrials(unittest.TestCase):
    def trials(self, other, inconclusive=-1, status=0):
        with tempfile.TemporaryDirectory() as folder:
            program = pathlib.Path(folder) / "touchmark"
            text = BENCH.replace("OTHER", other).replace("INCONCLUSIVE", str(inconclusive)).replace("STATUS", str(status))
            program.write_text(text.replace("COUNT", repr(folder + "/count")))
            program.chmod(0o755)
            return subprocess.run([SCRIPTS / "busy-trials", "--program", program, "--runs", "2", "--busy", "0,1", "--out",
                                   folder + "/trials.csv"], capture_output=True, text=True, check=False)

    def test_counts_the_runs_that_agree(self):
        done = self.trials("130, 130, 130, 130")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = [cells(line)[:5] for line in done.stdout.splitlines()[2:]]
        self.assertEqual(rows, [["0", "2", "2", "0", "2"], ["1", "2", "2", "0", "0"]])

    def test_finds_the_run_that_turns_the_order_over(self):
        done = self.trials("130, 90, 130, 130")
        self.assertEqual(done.returncode, 1, done.stderr)
        rows = [cells(line)[:4] for line in done.stdout.splitlines()[2:]]
        self.assertEqual(rows, [["0", "2", "2", "0"], ["1", "2", "1", "0"]])
        self.assertIn("beside 1, run 1: slide: b:x=1 fastest, not a", done.stderr)

    def test_counts_the_inconclusive_ones_and_says_why_there_are_none(self):
        self.assertEqual(self.trials("130, 130, 130, 130", inconclusive=2).returncode, 1)
        done = self.trials("130, 130, 130, 130", status=2)
        self.assertEqual(done.returncode, 2)
        self.assertIn("run 1 beside 0", done.stderr.splitlines()[-1])


if __name__ == "__main__":
    unittest.main()
