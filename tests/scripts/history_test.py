#!/usr/bin/python3
"""scripts/history on made-up recordings."""
import csv
import importlib.machinery
import importlib.util
import pathlib
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
loader = importlib.machinery.SourceFileLoader("history_script", str(ROOT / "scripts" / "history"))
history = importlib.util.module_from_spec(importlib.util.spec_from_loader("history_script", loader))
loader.exec_module(history)

FIELDS = ["detector", "options", "mesh", "trajectory", "query", "status", "ns_per_query", "ns_p999"]


class Rows(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.recording = pathlib.Path(self.folder.name) / "some-machine" / "2026-01-01-abcdefg"
        self.recording.mkdir(parents=True)

    def tearDown(self):
        self.folder.cleanup()

    def write(self, *rows):
        with open(self.recording / "results.csv", "w", encoding="utf-8", newline="") as file:
            writer = csv.writer(file)
            writer.writerow(FIELDS)
            writer.writerows(rows)

    def test_are_over_embree_on_the_same_trajectory(self):
        self.write(["embree", "", "cube", "slide", "nearest", "ok", "100", "400"],
                   ["embree", "", "cube", "hover", "nearest", "ok", "10", "40"],
                   ["grid-group", "build=lazy", "cube", "hover", "nearest", "ok", "5", "80"])
        last = list(history.rows_of(self.recording))[-1]
        self.assertEqual(last["detector"], "grid-group:build=lazy")
        self.assertEqual((last["machine"], last["recording"]), ("some-machine", "2026-01-01-abcdefg"))
        self.assertEqual((last["over_embree"], last["p999_over_embree"]), ("0.5", "2"))

    def test_lack_what_was_not_measured(self):
        self.write(["aabb-tree", "", "cube", "slide", "nearest", "ok", "100", ""],
                   ["bullet", "", "cube", "slide", "nearest", "crashed", "", ""])
        rows = list(history.rows_of(self.recording))
        self.assertEqual([row["detector"] for row in rows], ["aabb-tree"])
        self.assertEqual((rows[0]["over_embree"], rows[0]["p999_over_embree"]), ("", ""))

    def test_are_refused_of_what_is_no_recording(self):
        with self.assertRaises(history.BadInput):
            list(history.rows_of(self.recording))


if __name__ == "__main__":
    unittest.main()
