#!/usr/bin/python3
"""scripts/plot on small made-up results, good and bad."""
import csv
import filecmp
import pathlib
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
import forked  # noqa: E402

PLOT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "plot"
COLUMNS = (
    "schema,run_id,detector,options,mesh,triangles,trajectory,query,steps,radius,reach,guarantee,missed,"
    "false_contacts,wrong_triangle,max_distance_error,max_distance_error_ulp,max_normal_angle_deg,unresolved,status,"
    "ns_per_query,ns_p50,ns_p90,ns_p99,ns_p999,ns_max,update_rate_hz,deadline_misses_1khz,longest_miss_run_1khz,"
    "build_ms,first_answer_ms,bytes,heap_bytes,work_mean,work_max,repetitions,beyond_bound,wrong_point,wrong_normal,malformed,"
    "beyond_tolerance,rounding"
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
        return forked.run(PLOT, *(arguments or [self.directory]))

    def pictures(self):
        return sorted(path.name for path in (self.directory / "plots").iterdir())

    def assert_refused(self, message):
        done = self.plot()
        self.assertEqual(done.returncode, 2, done.stderr)
        self.assertEqual(done.stderr, f"plot: {self.directory}/results.csv: {message}\n")
        self.assertFalse((self.directory / "plots").exists())

    def test_draws_what_applies_to_one_run_twice(self):
        self.write(GOOD, {**GOOD, "detector": "fcl", "options": "bv=kios", "missed": 3}, CRASHED)
        done = self.plot()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(self.pictures(), [f"{name}.{kind}" for name in ("errors", "latency", "time_error", "update_rate")
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
        for text in ("missed contacts", "0.3 % (3 of 1,000)", "crashed in slide", "no error"):
            self.assertIn(text, errors)

    def test_tells_rounding_from_distances_that_are_off(self):
        apart = {**GOOD, "detector": "cgal", "guarantee": "approximate", "beyond_bound": 7, "beyond_tolerance": 2, "rounding": 5}
        self.write(GOOD, apart, {**apart, "detector": "old", "beyond_tolerance": "", "rounding": ""})
        self.assertEqual(self.plot(self.directory, "--only", "errors").returncode, 0)
        errors = (self.directory / "plots" / "errors.svg").read_text(encoding="utf-8")
        for text in ("0.2 % (2 of 1,000)", "0.5 % (5 of 1,000)", "0.7 % (7 of 1,000)", "distance off by rounding, less than that"):
            self.assertEqual(errors.count(f"<!-- {text} -->"), 1, text)

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
        self.assertEqual(self.plot(self.directory, "--only", "latency,update_rate").returncode, 0)
        self.assertIn("latency-a_b.stl-nearest.png", self.pictures())
        self.assertEqual(len(self.pictures()), 12)

    def test_leaves_out_what_has_no_data_and_says_why(self):
        self.write(CRASHED, {**CRASHED, "detector": "other", "status": "unsupported"})
        done = self.plot()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(self.pictures(), ["errors.png", "errors.svg"])  # who failed, and how
        for line in ("latency: left out: no row has times", "update_rate: left out: no row has an update rate",
                     "time_error: left out: no detector has times and errors on every trajectory"):
            self.assertIn(line, done.stdout.splitlines())

    def test_shows_no_trade_of_time_for_error_where_nobody_errs(self):
        self.write(GOOD)
        self.assertIn("time_error: left out: nobody errs", self.plot(self.directory, "--only", "time_error").stdout)

    def test_lists_who_does_not_err_in_time_against_error_a_row_each(self):
        self.write({**GOOD, "detector": "fcl", "missed": 3}, GOOD, {**GOOD, "detector": "embree"})
        self.plot(self.directory, "--only", "time_error")
        picture = (self.directory / "plots" / "time_error.svg").read_text(encoding="utf-8")
        for text in ("Missed and false contacts", "Without such errors", "grid-group", "embree", "fcl"):
            self.assertEqual(picture.count(f"<!-- {text}"), 1, text)  # in the legend or beside its row, not in both

    def test_draws_brackets_by_budget_and_keeps_them_from_time_against_error(self):
        brackets = ["bracket_p50", "bracket_max"]
        COLUMNS.extend(brackets)
        self.addCleanup(lambda: [COLUMNS.remove(column) for column in brackets])
        bounded = {**GOOD, "guarantee": "conservative", "max_distance_error": 0.4}
        self.write(GOOD, {**bounded, "options": "budget=64", "bracket_p50": 1e-3, "bracket_max": 0.4},
                   {**bounded, "options": "budget=256", "bracket_p50": 0, "bracket_max": 2e-3})
        done = self.plot()
        self.assertIn("time_error: left out: nobody errs", done.stdout)
        picture = (self.directory / "plots" / "budgets.svg").read_text(encoding="utf-8")
        for text in ("<!-- 64 -->", "<!-- 256 -->", "<!-- exact -->", "<!-- widest bracket, of the diagonal -->"):
            self.assertEqual(picture.count(text), 1, text)
        self.write(GOOD)
        self.assertNotIn("budgets", self.plot().stdout)

    def test_draws_the_clocks_own_cost_where_it_is_known(self):
        self.write(GOOD)
        self.plot(self.directory, "--only", "latency")
        self.assertNotIn("the clock", (self.directory / "plots" / "latency.svg").read_text(encoding="utf-8"))
        COLUMNS.append("clock_cost_ns")
        self.addCleanup(COLUMNS.pop)
        self.write({**GOOD, "clock_cost_ns": 24}, {**GOOD, "detector": "fcl", "clock_cost_ns": 22}, {**CRASHED})
        self.plot(self.directory, "--only", "latency")
        self.assertIn("23 ns: the clock, part of every time",
                      (self.directory / "plots" / "latency.svg").read_text(encoding="utf-8"))

    def test_counts_errors_as_shares_of_what_each_was_asked(self):
        self.write({**GOOD, "missed": 10}, {**GOOD, "detector": "fcl", "steps": 50, "missed": 10})
        self.plot(self.directory, "--only", "errors")
        picture = (self.directory / "plots" / "errors.svg").read_text(encoding="utf-8")
        for text in ("<!-- 1 % (10 of 1,000) -->", "<!-- 20 % (10 of 50) -->", "share of the steps"):
            self.assertIn(text, picture)

    def test_names_who_is_not_shown_in_time_against_error(self):
        self.write({**GOOD, "missed": 3}, {**GOOD, "trajectory": "jump"}, {**GOOD, "detector": "fcl"})
        self.plot(self.directory, "--only", "time_error")
        picture = (self.directory / "plots" / "time_error.svg").read_text(encoding="utf-8")
        self.assertIn("not everywhere answered, so not shown: fcl", picture)

    def test_draws_only_what_was_asked_for(self):
        self.write(GOOD)
        self.assertEqual(self.plot("--only", "latency", self.directory).stdout, f"{self.directory}/plots/latency.png\n")
        self.assertEqual(self.pictures(), ["latency.png", "latency.svg"])

    def test_takes_a_file_and_another_place_for_the_pictures(self):
        self.write(GOOD)
        elsewhere = self.directory / "a" / "b"
        self.assertEqual(self.plot(self.directory / "results.csv", "--only", "latency", "--out", elsewhere).returncode, 0)
        self.assertTrue((elsewhere / "latency.png").exists())

    def test_draws_emptied_caches_only_where_they_were_timed(self):
        self.write(GOOD)
        self.assertIn("cold: left out", self.plot("--only", "cold", self.directory).stdout)
        with open(self.directory / "results.csv", "w", newline="", encoding="utf-8") as file:
            row = {**GOOD, "cold_l2_ns_p50": 300, "cold_ns_p50": 5000, "cold_ns_p99": 9000}
            writer = csv.DictWriter(file, [*COLUMNS, "cold_l2_ns_p50", "cold_ns_p50", "cold_ns_p99"])
            writer.writeheader()
            writer.writerow(row)
        self.assertEqual(self.plot("--only", "cold", self.directory).stdout, f"{self.directory}/plots/cold.png\n")
        self.assertEqual(self.pictures(), ["cold.png", "cold.svg"])

    def test_draws_a_stress_run_as_contestants_by_families(self):
        fields = ("detector,options,family,query,status,probes,missed,false_contacts,wrong_triangle,beyond_bound,wrong_point,"
                  "wrong_normal,malformed,crashes,timeouts,refusals,adversarial")
        (self.directory / "stress.csv").write_text(
            fields + "\ngrid-group,,needles,nearest,ok,90,0,0,0,0,0,0,0,0,0,0,1\n"
            "fcl,bv=obb,needles,nearest,wrong,90,40,6,0,0,0,0,0,0,0,0,1\nfcl,bv=obb,caps,nearest,inexact,90,0,0,0,7,0,0,0,0,0,0,0\n"
            "grid-group,,caps,nearest,crashed,0,0,0,0,0,0,0,0,1,0,0,0\n", encoding="utf-8")
        done = self.plot()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(self.pictures(), ["stress.png", "stress.svg"])
        picture = (self.directory / "plots" / "stress.svg").read_text(encoding="utf-8")
        for text in ("fcl:bv=obb", "needles", "<!-- 51% -->", "<!-- ~7.8% -->", "<!-- C -->", "270 answers",
                     "180 of them at the edge"):
            self.assertIn(text, picture)

    def test_draws_proxies_by_families_and_their_stab(self):
        (self.directory / "proxy.csv").write_text(
            "method,options,family,probe,ticks,crossings,pops,violations\n"
            "penalty,,cracks,ball,1000,20,20,30\npenalty,,cracks,point,1000,7,0,0\n"
            "finger-proxy,epsilon=1e-3,cracks,ball,1000,0,0,0\nvirtual-proxy,,stabs,ball,1000,0,0,3\n", encoding="utf-8")
        (self.directory / "stab.csv").write_text(
            "method,step,goal_x,goal_z,proxy_x,proxy_z\nsurface,0,,,0,0\nsurface,1,,,0.01,0\nsurface,2,,,0,0.01\n"
            "penalty,0,0,0.02,0,0.02\npenalty,1,0,-0.01,0,-0.01\n", encoding="utf-8")
        done = self.plot()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(self.pictures(), ["proxy.png", "proxy.svg", "stab.png", "stab.svg"])
        picture = (self.directory / "plots" / "proxy.svg").read_text(encoding="utf-8")
        for text in ("finger-proxy:epsilon=1e-3, ball", "cracks", "<!-- 20k -->", "<!-- 7k -->", "<!-- &lt;r -->", "4,000 ticks"):
            self.assertIn(text, picture)

    def test_draws_a_paced_loop_as_ticks_later_than_a_time(self):
        (self.directory / "servo_histogram.csv").write_text(
            "schema,detector,options,trajectory,loop,time,up_to_ns,ticks\n1,grid-group,,slide,detector,latency,20000,999\n"
            "1,grid-group,,slide,detector,latency,3000000,1\n1,grid-group,,slide,detector,query,500,1000\n"
            "1,grid-group,,slide,idle,latency,19000,1000\n", encoding="utf-8")
        (self.directory / "run.json").write_text(
            '{"servo": {"rate_hz": 1000, "ticks": 1000, "load": "cpu", "scheduler": "SCHED_FIFO 50"}}', encoding="utf-8")
        done = self.plot()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(self.pictures(), ["servo.png", "servo.svg"])
        picture = (self.directory / "plots" / "servo.svg").read_text(encoding="utf-8")
        for text in ("grid-group", "1,000 ticks at 1000 Hz, load cpu, SCHED_FIFO 50", "nothing asked", "the period: 1 ms"):
            self.assertIn(text, picture)

    def test_draws_the_suite_scene_by_property_and_frames_losses(self):
        head = "mesh,trajectory,query,reach,caches,ours,status,exact_ratio,any_ratio,exact_tail_ratio,any_tail_ratio\n"
        (self.directory / "suite.csv").write_text(
            head + "bunny,slide:speed=0.1%,nearest,0.5%,warm,best,ok,2.5,0.8,,\nbunny,jump,touches,5%,warm,best,ok,3.25,3.25,,\n"
            "hair:9,jump,nearest,inf,warm,best,ok,0.43,0.43,,\nhair:9,jump,nearest,inf,warm,grid-group,ok,0.11,0.11,,\n"
            "foam:9,jump,sweep,5%,warm,best,not measured,,,,\n", encoding="utf-8")
        done = self.plot()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertEqual(self.pictures(), ["suite-any.png", "suite-any.svg", "suite.png", "suite.svg"])
        self.assertIn("suite-exact_tail: left out: no cell was measured", done.stdout)
        picture = (self.directory / "plots" / "suite.svg").read_text(encoding="utf-8")
        for text in ("bunny", "foam:9", "<!-- 2.5 -->", "<!-- 0.43 -->", "3 scenes, 3 of 4 cells", "framed: a rival is ahead"):
            self.assertIn(text, picture)
        self.assertNotIn("<!-- 0.11 -->", picture)

    def test_says_where_the_numbers_are_from(self):
        self.write(GOOD)
        (self.directory / "run.json").write_text('{"cpu": "Abacus 3", "commit": "beef"}', encoding="utf-8")
        self.plot(self.directory, "--only", "latency")
        self.assertIn(f"{self.directory.name}, Abacus 3, commit beef",
                      (self.directory / "plots" / "latency.svg").read_text(encoding="utf-8"))
        (self.directory / "run.json").write_text("{", encoding="utf-8")
        done = self.plot()
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1))
        self.assertIn("run.json: not JSON", done.stderr)

    def test_takes_any_name_as_it_is(self):
        self.write({**GOOD, "mesh": "/models/$\\frac{$.stl", "trajectory": "손 $x^$.csv", "detector": "n" * 200}, CRASHED)
        done = self.plot()
        self.assertEqual((done.returncode, done.stderr), (0, ""))

    def test_ignores_columns_it_does_not_know(self):
        COLUMNS.append("joules")
        self.addCleanup(COLUMNS.pop)
        self.write({**GOOD, "joules": "1"})
        self.assertEqual(self.plot(self.directory, "--only", "latency").returncode, 0)

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
        self.write({**GOOD, "ns_p50": "inf"})
        self.assert_refused("line 2: column ns_p50: 'inf' is not finite")
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

    def test_refuses_wrong_arguments_in_one_line(self):
        for wrong in ([], ["a", "b"], ["--only", "latency,pie", "a"]):
            done = forked.run(PLOT, *wrong)
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), (wrong, done.stderr))


if __name__ == "__main__":
    unittest.main()
