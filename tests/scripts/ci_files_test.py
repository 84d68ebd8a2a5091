#!/usr/bin/python3
"""What the program writes for other programs: Google Benchmark's JSON, read by that library's own compare.py and held
against what its other readers ask for; JUnit's XML; Markdown.

usage: ci_files_test.py PROGRAM HOSTILE_PLUGIN
"""
import csv
import json
import os
import pathlib
import re
import statistics
import subprocess
import sys
import tempfile
import unittest
import xml.etree.ElementTree as ElementTree

import jsonschema

HOSTILE = sys.argv.pop()
PROGRAM = sys.argv.pop()
COMPARE = pathlib.Path("/usr/share/benchmark/compare.py")  # of Debian's libbenchmark-tools

TIME = {"type": "number", "minimum": 0}
TEXT = {"type": "string"}
COUNT = {"type": "integer", "minimum": 0}
# As Google Benchmark's user guide and its reporter have it.
SCHEMA = {
    "type": "object", "required": ["context", "benchmarks"],
    "properties": {
        "context": {
            "type": "object",
            "required": ["date", "host_name", "executable", "num_cpus", "mhz_per_cpu", "cpu_scaling_enabled", "caches",
                         "load_avg", "library_build_type"],
            "properties": {
                "date": {"type": "string", "pattern": r"^\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d"}, "host_name": TEXT,
                "executable": TEXT, "num_cpus": {"type": "integer", "minimum": 1}, "mhz_per_cpu": COUNT,
                "cpu_scaling_enabled": {"type": "boolean"}, "library_build_type": {"enum": ["release", "debug"]},
                "load_avg": {"type": "array", "items": TIME},
                "caches": {"type": "array", "items": {
                    "type": "object", "required": ["type", "level", "size", "num_sharing"],
                    "properties": {"type": TEXT, "level": COUNT, "size": COUNT, "num_sharing": COUNT}}}}},
        "benchmarks": {"type": "array", "items": {
            "type": "object",
            "required": ["name", "family_index", "per_family_instance_index", "run_name", "run_type", "repetitions",
                         "threads", "iterations", "real_time", "cpu_time", "time_unit"],
            "properties": {"name": TEXT, "run_name": TEXT, "family_index": COUNT, "per_family_instance_index": COUNT,
                           "repetitions": {"type": "integer", "minimum": 1}, "threads": {"const": 1},
                           "iterations": {"type": "integer", "minimum": 1}, "real_time": TIME, "cpu_time": TIME,
                           "time_unit": {"enum": ["ns"]}, "run_type": {"enum": ["iteration", "aggregate"]}},
            "if": {"properties": {"run_type": {"const": "iteration"}}},
            "then": {"required": ["repetition_index"], "properties": {"repetition_index": COUNT}},
            "else": {"required": ["aggregate_name", "aggregate_unit"],
                     "properties": {"aggregate_name": TEXT, "aggregate_unit": {"enum": ["time", "percentage"]}}}}}}}

SCENE = ["--mesh", "icosphere:2", "--trajectory", "slide", "--steps", "200", "--query", "nearest"]
SHORT = ["--quick", "--no-cold", "--benchmark_repetitions=3", "--benchmark_min_time=0.001"]
TWO = ["--detector", "grid-group", "--detector", "aabb-tree:leaf_size=8"]


def run(*words, hostile=""):
    return subprocess.run([PROGRAM, *map(str, words)], capture_output=True, text=True, check=False,
                          env={**os.environ, "HOSTILE_PLUGIN": hostile})


class Files(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def succeed(self, *words, status=0, hostile=""):
        done = run(*words, hostile=hostile)
        self.assertEqual(done.returncode, status, done.stdout + done.stderr)
        return done

    def expect_tables(self, text):
        """Every line of a Markdown table has as many cells as its header."""
        tables = re.findall(r"(?:^\|.*\|\n)+", text, re.M)
        self.assertTrue(tables, text)
        for table in tables:
            lines = table.splitlines()
            self.assertRegex(lines[1], r"^(\| --- )+\|$")
            cells = [len(re.findall(r"(?<!\\)\|", line)) for line in lines]
            self.assertEqual(set(cells), {cells[0]}, table)
        return tables


class GoogleBenchmark(Files):
    def benched(self, name, *more, status=0, hostile=""):
        file = self.folder / name
        self.succeed("bench", *SCENE, *SHORT, *more, f"--benchmark_out={file}", "--benchmark_out_format=json",
                     "--out", self.folder / "out", status=status, hostile=hostile)
        written = json.loads(file.read_text(encoding="utf-8"))
        jsonschema.validate(written, SCHEMA)
        return file, written

    def test_entries_are_repetitions_and_what_sums_them_up(self):
        _, written = self.benched("a.json", *TWO)
        with open(self.folder / "out" / "results.csv", encoding="utf-8", newline="") as results:
            rows = list(csv.DictReader(results))
        self.assertEqual(len(rows), 2)
        names = set()
        for family, row in enumerate(rows):
            contestant = row["detector"] + (":" + row["options"] if row["options"] else "")
            name = f"{contestant}/icosphere:2/slide/nearest"
            names.add(name)
            entries = [entry for entry in written["benchmarks"] if entry["run_name"] == name]
            self.assertEqual({entry["family_index"] for entry in entries}, {family})
            each = [entry for entry in entries if entry["run_type"] == "iteration"]
            self.assertEqual([entry["repetition_index"] for entry in each], [0, 1, 2])
            self.assertEqual({entry["name"] for entry in each}, {name})
            sums = {entry["aggregate_name"]: entry for entry in entries if entry["run_type"] == "aggregate"}
            self.assertEqual(list(sums), ["mean", "median", "stddev", "cv", "undisturbed"])
            for key in ("real_time", "cpu_time"):
                times = [entry[key] for entry in each]
                self.assertAlmostEqual(sums["mean"][key] / statistics.mean(times), 1)
                self.assertAlmostEqual(sums["median"][key] / statistics.median(times), 1)
                self.assertAlmostEqual(sums["stddev"][key], statistics.stdev(times), delta=1e-6 * times[0])
                self.assertAlmostEqual(sums["cv"][key], statistics.stdev(times) / statistics.mean(times), 6)
            for what, entry in sums.items():
                self.assertEqual(entry["name"], f"{name}_{what}")
                self.assertEqual(entry["aggregate_unit"], "percentage" if what == "cv" else "time")
            self.assertAlmostEqual(sums["median"]["real_time"] / float(row["ns_per_query"]), 1, 4)
            self.assertAlmostEqual(sums["undisturbed"]["real_time"] / float(row["ns_undisturbed"]), 1, 4)
            self.assertEqual({entry["iterations"] % int(row["steps"]) for entry in each}, {0})
        self.assertEqual({entry["run_name"] for entry in written["benchmarks"]}, names)
        self.assertEqual(written["failed"], [])

    def compare(self, *words):
        done = subprocess.run(["/usr/bin/python3", COMPARE, "--no-color", *map(str, words)], capture_output=True, text=True,
                              check=False)
        self.assertEqual(done.returncode, 0, done.stdout + done.stderr)
        return done.stdout

    def test_compare_py_reads_it(self):
        before, written = self.benched("before.json", *TWO)
        after = self.folder / "after.json"
        for entry in written["benchmarks"]:
            if entry["run_name"].startswith("grid-group") and entry.get("aggregate_unit") != "percentage":
                entry["real_time"] *= 2
        after.write_text(json.dumps(written), encoding="utf-8")
        said = self.compare("benchmarks", before, after)
        change = r"\s+([+-]\d+\.\d+)\s+[+-]\d+\.\d+\s"
        for name, expected in (("grid-group/icosphere:2/slide/nearest_mean", "+1.0000"),
                               ("grid-group/icosphere:2/slide/nearest_undisturbed", "+1.0000"),
                               ("aabb-tree:leaf_size=8/icosphere:2/slide/nearest_median", "+0.0000")):
            self.assertEqual(re.search(re.escape(name) + change, said)[1], expected, said)
        self.assertIn("OVERALL_GEOMEAN", said)
        said = self.compare("filters", before, "grid-group", "aabb-tree:leaf_size=8")
        self.assertIn("[grid-group vs. aabb-tree:leaf_size=8]/icosphere:2/slide/nearest_median", said)

    def test_every_entry_has_what_other_readers_ask_for(self):
        # github-action-benchmark: the value with its unit and three numbers beside it. Bencher: name, time, unit.
        _, written = self.benched("a.json", *TWO)
        for entry in written["benchmarks"]:
            line = f"{entry['name']} {entry['real_time']} {entry['time_unit']}/iter"
            beside = f"iterations: {entry['iterations']}\ncpu: {entry['cpu_time']} {entry['time_unit']}\nthreads: {entry['threads']}"
            self.assertRegex(line, r"^\S+ [0-9.e+-]+ ns/iter$")
            self.assertRegex(beside, r"^iterations: \d+\ncpu: [0-9.e+-]+ ns\nthreads: 1$")
        names = [entry["name"] for entry in written["benchmarks"] if entry["run_type"] == "aggregate"]
        self.assertEqual(len(names), len(set(names)))

    def test_summaries_alone(self):
        _, written = self.benched("a.json", *TWO, "--benchmark_report_aggregates_only=true")
        self.assertEqual({entry["run_type"] for entry in written["benchmarks"]}, {"aggregate"})
        self.assertEqual(len(written["benchmarks"]), 10)

    def test_one_repetition_has_no_spread(self):
        _, written = self.benched("a.json", *TWO, "--benchmark_repetitions=1")
        self.assertEqual([entry.get("aggregate_name") for entry in written["benchmarks"]],
                         [None, "undisturbed", None, "undisturbed"])

    def test_what_failed_has_no_time(self):
        _, written = self.benched("a.json", "--detector", "brute-force", "--plugin", HOSTILE, status=1,
                                  hostile="crash in a query")
        self.assertEqual({entry["run_name"] for entry in written["benchmarks"]},
                         {"brute-force/icosphere:2/slide/nearest"})
        self.assertEqual(written["failed"], [{"name": "hostile/icosphere:2/slide/nearest",
                                              "error_message": "crashed:SIGABRT"}])

    def test_what_is_not_written_is_refused_at_once(self):
        file = self.folder / "a.json"
        for flags, why in ((["--benchmark_out_format=csv"], "is not json"), (["--benchmark_out_format=console"], "is not json"),
                           (["--benchmark_format=json"], "is not console"), (["--benchmark_out="], "needs a file"),
                           (["--benchmark_out"], "needs a file"), (["--suite", f"--benchmark_out={file}"], "does not go")):
            done = self.succeed("bench", *([] if "--suite" in flags else SCENE[:2]), *flags, status=2)
            self.assertIn(why, done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)
        done = self.succeed("bench", *SCENE, *SHORT, f"--benchmark_out={self.folder}/none/a.json", status=3)
        self.assertEqual(done.stderr.count("\n"), 1)
        self.assertEqual(list(self.folder.iterdir()), [])


class JUnit(Files):
    def cases_in(self, name, suite):
        """Outcome and message of each case, by class and name; the counts agree with them."""
        root = ElementTree.parse(self.folder / name).getroot()
        self.assertEqual(root.tag, "testsuites")
        found = {}
        for case in root[0]:
            self.assertEqual(case.tag, "testcase")
            self.assertGreaterEqual(float(case.get("time")), 0)
            tags = [(child.tag, child.get("message")) for child in case]
            found[case.get("classname"), case.get("name")] = tags[0] if tags else ("passed", None)
        outcomes = [outcome for outcome, _ in found.values()]
        for element in (root, root[0]):
            self.assertEqual(element.get("name"), f"touchmark {suite}")
            counts = [int(element.get(key)) for key in ("tests", "failures", "skipped", "errors")]
            self.assertEqual(counts, [len(outcomes), outcomes.count("failure"), outcomes.count("skipped"), 0])
        return found

    def verified(self, how, status):
        self.succeed("verify", *SCENE, "--detector", "grid-group", "--plugin", HOSTILE, "--junit", self.folder / "v.xml",
                     "--markdown", self.folder / "v.md", status=status, hostile=how)
        found = self.cases_in("v.xml", "verify")
        self.assertEqual(found["grid-group", "icosphere:2/slide/nearest"], ("passed", None))
        self.assertEqual(len(found), 2)
        self.expect_tables((self.folder / "v.md").read_text(encoding="utf-8"))
        return found["hostile", "icosphere:2/slide/nearest"]

    def test_verify_fails_what_is_broken_alone(self):
        outcome, message = self.verified("find nothing", 1)
        self.assertEqual(outcome, "failure")
        self.assertIn("missed", message)
        self.assertEqual(self.verified("crash in a query", 1)[0], "failure")
        self.assertEqual(self.verified("approximate", 0), ("passed", None))
        self.assertEqual(self.verified("refuse to build", 0)[0], "skipped")

    def test_texts_of_others_are_escaped(self):
        _, message = self.verified("refuse to build", 0)
        self.assertTrue(message.startswith("refused: 320 triangles are <too> many & more"), message)

    def test_stress(self):
        self.succeed("stress", "--family", "ordinary", "--probes", "50", "--detector", "grid-group", "--plugin", HOSTILE,
                     "--junit", self.folder / "s.xml", "--markdown", self.folder / "s.md", status=1)
        found = self.cases_in("s.xml", "stress")
        self.assertEqual({(group, found[group, name][0]) for group, name in found},
                         {("grid-group", "passed"), ("hostile", "failure")})
        self.assertEqual({name for _, name in found}, {"ordinary/touches", "ordinary/nearest"})
        self.expect_tables((self.folder / "s.md").read_text(encoding="utf-8"))

    def test_gate(self):
        baseline = self.folder / "gate.csv"
        asked = ["gate", *SCENE, "--detector", "grid-group", "--baseline", baseline, "--rounds", "5", "--tolerance", "90%"]
        self.succeed(*asked, "--write-baseline")
        checked = run(*asked, "--junit", self.folder / "g.xml", "--markdown", self.folder / "g.md")
        found = self.cases_in("g.xml", "gate")
        expected = {0: "passed", 1: "failure", 4: "skipped"}[checked.returncode]
        self.assertEqual(found["grid-group", "icosphere:2/slide/nearest"][0], expected)
        self.expect_tables((self.folder / "g.md").read_text(encoding="utf-8"))


class Markdown(Files):
    def test_bench_has_a_table_a_trajectory(self):
        self.succeed("bench", *SCENE, "--trajectory", "hover", *SHORT, *TWO, "--markdown", self.folder / "b.md")
        text = (self.folder / "b.md").read_text(encoding="utf-8")
        tables = self.expect_tables(text)
        self.assertEqual(len(tables), 2)
        for table in tables:
            self.assertEqual(table.count("\n"), 4)
        self.assertIn("### slide", text)
        self.assertIn("### hover", text)
        self.assertEqual(text.count("````") % 2, 0)


if __name__ == "__main__":
    unittest.main()
