#!/usr/bin/python3
"""scripts/report-table on made results."""
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


if __name__ == "__main__":
    unittest.main()
