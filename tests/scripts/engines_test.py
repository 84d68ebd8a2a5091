#!/usr/bin/python3
"""The arithmetic of scripts/engines on made rows."""
import importlib.machinery
import importlib.util
import math
import pathlib
import subprocess
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "engines"
LOADER = importlib.machinery.SourceFileLoader("engines", str(SCRIPT))
engines = importlib.util.module_from_spec(importlib.util.spec_from_loader("engines", LOADER))
LOADER.exec_module(engines)

AUDITED = {"detector": "jolt-default", "diagonal": "2", "made_up": "3", "contacts": "60", "missed": "1", "true_contacts": "50",
           "shape": "surface", "status": "differs"}
SWEPT = {"steps": "200", "false_contacts": "2", "missed": "5", "status": "ok"}
HEADER = ",".join(engines.Finding._fields)


def point(true, said, place="near"):
    return {"true_distance": str(true), "distance": str(said), "place": place}


def found(points=(), audited=(), swept=()):
    return engines.finding("default", "part", {**AUDITED, **dict(audited)}, list(points), {**SWEPT, **dict(swept)})


class Engines(unittest.TestCase):
    def test_shares_are_of_the_contacts_that_could_be_wrong(self):
        row = found([point(1, 1)])
        self.assertEqual((row.made_up_permille, row.missed_permille), (50, 20))
        self.assertEqual((row.sweeps_made_up_permille, row.sweeps_missed_permille), (10, 25))
        self.assertEqual(engines.permille(0, 0), 0)

    def test_a_form_is_no_part_of_the_name(self):
        self.assertEqual((found().engine, found().form), ("jolt", "default"))

    def test_a_quantile_is_a_value_that_was_measured(self):
        values = list(range(100, 0, -1))
        self.assertEqual([engines.quantile(values, share) for share in (0.5, 0.99, 1)], [50, 99, 100])
        self.assertEqual(engines.quantile([7], 0.5), 7)
        self.assertTrue(math.isnan(engines.quantile([], 1)))

    def test_errors_are_those_on_20_cm(self):
        # On a diagonal of 2 an error of 0.001 is 0.0005 of it, and of 200,000 um that is 100.
        row = found([point(0.5, 0.501), point(0.5, 0.5), point(0.5, "inf")])
        self.assertAlmostEqual(engines.errors_um([point(0.5, 0.501)], 2, "surface")[0], 100)
        self.assertEqual((row.error_p50_um < 101, row.error_max_um), (True, math.inf))

    def test_a_solid_has_no_distances_inside(self):
        points = [point(0.5, 0, "inside"), point(0.5, 0.5)]
        self.assertEqual(found(points, {"shape": "solid"}).error_max_um, 0)
        self.assertAlmostEqual(found(points).error_max_um, 50000)

    def test_what_an_engine_cannot_do_is_told(self):
        self.assertEqual(found([point(1, "")], swept={"status": "unsupported"}).cannot, "nearest sweep")
        self.assertEqual(found([point(1, 1)]).cannot, "")

    def test_a_failure_is_no_zero(self):
        crashed = {"made_up": "", "contacts": "", "missed": "", "true_contacts": "", "status": "crashed:SIGSEGV"}
        row = found([], crashed)
        self.assertEqual((engines.contacts(row), engines.distances(row), engines.kind_and_text(row)[0]), ("crashed", "crashed", "failed"))
        row = found([point(1, 1)], {"made_up": "0", "missed": "0", "status": "ok"}, {"status": "timeout"})
        self.assertEqual((engines.contacts(row), engines.sweeps(row)), ("0", "timeout"))

    def test_kinds_are_by_the_worst_fault(self):
        right = found([point(1, 1.0001)], {"made_up": "0", "missed": "0"})  # off by 10 um
        self.assertEqual(engines.kind_and_text(right)[0], "right")
        self.assertEqual(engines.kind_and_text(right._replace(error_max_um=20.1))[0], "inexact")
        self.assertEqual(engines.kind_and_text(right._replace(missed_permille=0.5)), ("wrong", "0.5"))

    def test_forms_with_the_same_cells_share_a_line(self):
        rows = ["a,{},part,m,ok,surface,sweep,400,0,{},0.01,12.34,inf,0,0,0".format(form, missed)
                for form, missed in (("best", 0), ("as-is", 0), ("default", 12.5))]
        with tempfile.TemporaryDirectory() as folder:
            pathlib.Path(folder, "engines.csv").write_text("\n".join([HEADER, *rows]) + "\n", encoding="utf-8")
            def table(name):
                done = subprocess.run([SCRIPT, "--out", folder, "--table", name], capture_output=True, text=True, check=False)
                self.assertEqual(done.returncode, 0, done.stderr)
                return done.stdout.splitlines()[2:]
            self.assertEqual(table("contacts"), ["| a | best, as-is | 0 |", "| a | default | 12.5 / 0 |"])
            self.assertEqual(table("distances"), ["| a | best, as-is, default | < 0.1 / 12 / none found |"])
            self.assertEqual(table("sweeps"), [])


if __name__ == "__main__":
    unittest.main()
