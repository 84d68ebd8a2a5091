#!/usr/bin/python3
"""scripts/plot on several made-up runs: growth; and what the pictures share."""
import csv
import json
import pathlib
import sys
import tempfile
import unittest

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
sys.dont_write_bytecode = True
sys.path.insert(0, str(SCRIPTS))

import forked  # noqa: E402
from drawing import detectors, layout, servo  # noqa: E402

ROW = {
    "detector": "grid-group", "options": "", "mesh": "bunny", "triangles": 69666, "trajectory": "slide", "query": "nearest",
    "steps": 1000, "radius": 0.005, "guarantee": "exact", "status": "ok", "missed": 0, "false_contacts": 0,
    "wrong_triangle": 0, "unresolved": 0, "beyond_bound": 0, "wrong_point": 0, "wrong_normal": 0, "malformed": 0,
    "max_distance_error": 0, "ns_p50": 90, "ns_p90": 110, "ns_p99": 130, "ns_p999": 150, "ns_max": 200,
    "update_rate_hz": 1e7, "ns_per_query": 100, "ns_per_query_mad": 1, "repetitions": 9, "answers_checksum": "1f",
}


def row(detector="grid-group", ns=100, **others):
    name, _, options = detector.partition(":")
    return {**ROW, "detector": name, "options": options, "ns_per_query": ns, "update_rate_hz": 1e9 / ns, **others}


class Folders(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.directory = pathlib.Path(temporary.name)
        self.out = self.directory / "pictures"

    def run_of(self, name, *rows, about=None):
        folder = self.directory / name
        folder.mkdir(parents=True)
        with open(folder / "results.csv", "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, list(ROW))
            writer.writeheader()
            writer.writerows(rows)
        if about:
            (folder / "run.json").write_text(json.dumps(about), encoding="utf-8")
        return folder

    def plot(self, *arguments):
        done = forked.run(SCRIPTS / "plot", *arguments, "--out", self.out)
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        return done.stdout

    def refusal(self, *arguments):
        done = forked.run(SCRIPTS / "plot", *arguments, "--out", self.out)
        self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
        self.assertFalse(self.out.exists())
        return done.stderr

    def picture(self, name):
        """matplotlib writes a comment with the text above each run of glyphs."""
        self.assertTrue((self.out / f"{name}.png").read_bytes().startswith(b"\x89PNG"))
        return (self.out / f"{name}.svg").read_text(encoding="utf-8")


class Scaling(Folders):
    HEADER = ["schema", "detector", "options", "trajectory", "quantity", "points", "exponent", "exponent_low", "exponent_high",
              "factor", "family", "query", "least_triangles", "most_triangles"]

    def scaled(self, *fits):
        rows = [row(name, mesh=f"soup:{n}", triangles=n) for name in ("grid-group", "fcl:bv=rss") for n in (100, 10000)]
        folder = self.run_of("a", *rows)
        with open(folder / "scaling.csv", "w", newline="", encoding="utf-8") as file:
            csv.writer(file).writerows([self.HEADER, *fits])
        return folder

    def fit(self, exponent, low="", high="", options="", detector="grid-group"):
        return [1, detector, options, "slide", "ns_per_query", 2, exponent, low, high, 100, "soup", "nearest", 100, 10000]

    def test_is_drawn_with_the_exponents_and_how_well_they_are_known(self):
        folder = self.scaled(self.fit(0.125, 0.025, 0.225), self.fit(0.5, detector="fcl", options="bv=rss"))
        self.plot(folder, "--only", "scaling")
        picture = self.picture("scaling")
        for text in ("<!-- 0.12 ± 0.10 -->", "<!-- 0.50 -->", "grid-group", "fcl:bv=rss", "Time of a query", "soup:100, soup:10000"):
            self.assertIn(text, picture)
        self.assertNotIn("Time to build", picture)

    def test_is_left_out_where_nothing_was_fitted(self):
        self.assertIn("scaling: left out", self.plot(self.scaled(), "--only", "scaling"))
        self.assertIn("scaling: left out", self.plot(self.run_of("b", row()), "--only", "scaling"))

    def test_refuses_a_table_that_is_none(self):
        self.assertIn("scaling.csv: line 2: column exponent: 'steep' is not a number",
                      self.refusal(self.scaled(self.fit("steep")), "--only", "scaling"))


class SeveralRuns(Folders):
    def test_of_one_scene_are_drawn_apart(self):
        self.plot(self.run_of("a", row()), self.run_of("b", row()), "--only", "latency")
        self.picture("latency-a")
        self.picture("latency-b")

    def test_of_one_name_do_not_overwrite_each_other(self):
        self.plot(self.run_of("x/run", row()), self.run_of("y/run", row()), "--only", "latency")
        self.picture("latency-run")
        self.picture("latency-run-2")


class Looks(unittest.TestCase):
    NAMES = ["brute-force", "fcl:bv=obbrss", "sphere-cluster:lookup=scan", "new-one", "embree", "fcl", "grid-group",
             "sphere-cluster", "grid-group:lookup=scan"]

    def test_order_is_ours_rivals_published_brute_force(self):
        self.assertEqual(detectors.in_order(self.NAMES + ["fcl"]),
                         ["sphere-cluster", "grid-group", "embree", "fcl", "fcl:bv=obbrss", "new-one", "grid-group:lookup=scan",
                          "sphere-cluster:lookup=scan", "brute-force"])

    KNOWN = [kind + (":" + options if options else "") for kind, known in detectors.KNOWN.items() for options in known]

    def test_no_two_known_detectors_look_alike_whatever_else_is_drawn(self):
        names = [*self.KNOWN, *(kind for kind in detectors.KINDS if kind and " " not in kind and kind not in detectors.KNOWN)]
        self.assertEqual(len(set(names)), len(names))
        alone = {name: self.look(name) for name in names}
        self.assertEqual(len(set(alone.values())), len(names))
        detectors.tell_apart([*names, "fcl:a=1", "new"])
        self.assertEqual({name: self.look(name) for name in names}, alone)

    @staticmethod
    def look(name):
        mark = detectors.mark(name)
        return mark["marker"], mark["fillstyle"], mark["color"]

    def test_the_six_first_forms_of_each_detector_differ_without_colour(self):
        names = [name for kind in detectors.KNOWN for name in self.KNOWN if name.partition(":")[0] == kind
                 and detectors.look(name) < 6]
        self.assertEqual(len({self.look(name)[:2] for name in names}), len(names))

    def test_detectors_that_are_not_known_are_told_apart_too(self):
        for names in (["fcl", "fcl:bv=obbrss", "fcl:a=1", "fcl:a=2", "fcl:a=3", "new", "newer", "newest"],
                      [*self.KNOWN, *(f"embree:quality={k}" for k in range(40)), *(f"plug-in-{k}" for k in range(40))]):
            detectors.tell_apart(names)
            self.assertEqual(len({self.look(name) for name in names}), len(names))

    def test_ticks_are_written_without_an_exponent(self):
        self.assertEqual([layout.rate(hz) for hz in (5, 1e3, 2.5e7, 1e9, 2e9)], ["5 Hz", "1 kHz", "25 MHz", "1 GHz", "2 GHz"])
        self.assertEqual([layout.percent(share) for share in (1, 0.0123, 1.3e-5, 1e-8)],
                         ["100 %", "1.2 %", "0.0013 %", "0.000001 %"])

    def test_nothing_is_cut_off_at_the_border(self):
        plt = layout.load_pyplot()
        figure = plt.figure(figsize=(4, 3))
        figure.text(0.95, 0.5, "well beyond the right border")
        figure.text(0.5, -0.1, "below")
        box = layout.whole(figure)
        self.assertGreater(box.x1, 5)
        self.assertLess(box.y0, -0.2)
        self.assertEqual((box.x0, box.y1), (0, 3))
        plt.close(figure)

    def test_trajectories_keep_their_marker_whatever_else_is_drawn(self):
        alone = layout.trajectory_mark("jump", ["jump"], "black")
        self.assertEqual(alone, layout.trajectory_mark("jump", ["slide", "mine.csv", "jump"], "black"))

    def test_marks_that_would_meet_stand_on_different_levels(self):
        self.assertEqual(layout.spread([100, 101, 5000, 5001, 5002], span=10), [0, 1, 0, 1, 2])

    def test_file_names_say_what_tells_pictures_apart_and_no_more(self):
        words = layout.telling_words([("a", "nearest", 0.5), ("b", "nearest", 0.25)])
        self.assertEqual(words, {("a", "nearest", 0.5): ["a"], ("b", "nearest", 0.25): ["b"]})
        words = layout.telling_words([("a", "nearest", 0.5), ("a", "nearest", 1 / 3)])
        self.assertEqual(layout.in_file_name(words["a", "nearest", 1 / 3]), "-0.333333")
        self.assertEqual(layout.telling_words([("a", "nearest")]), {("a", "nearest"): []})

    def test_legends_break_before_they_are_wider_than_the_picture(self):
        self.assertEqual(layout.entries_per_line(["abcde"] * 6, 100), 6)
        self.assertEqual(layout.entries_per_line(["abcde"] * 6, 4), 3)
        self.assertEqual(layout.entries_per_line(["abcde" * 20] + ["abcde"] * 5, 11.5), 4)
        self.assertEqual(layout.entries_per_line(["abcde"] * 6, 0.1), 1)


class Servo(unittest.TestCase):
    def test_the_share_of_later_ticks_falls_from_all_to_the_latest(self):
        buckets = [servo.Bucket({"detector": "a", "options": "", "trajectory": "slide", "loop": "idle", "time": "latency",
                                 "up_to_ns": str(ns), "ticks": str(ticks)}, 1) for ns, ticks in ((10, 6), (40, 1), (20, 3))]
        self.assertEqual(servo.later(buckets), [(10, 1.0), (20, 0.4), (40, 0.1)])


if __name__ == "__main__":
    unittest.main()
