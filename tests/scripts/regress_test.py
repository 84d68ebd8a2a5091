#!/usr/bin/python3
"""The judgement of scripts/regress, on made-up numbers whose truth is known."""
import argparse
import contextlib
import csv
import importlib.machinery
import importlib.util
import io
import json
import pathlib
import subprocess
import sys
import tempfile
import unittest
from unittest import mock

import numpy

SCRIPTS = pathlib.Path(__file__).resolve().parents[2] / "scripts"
sys.path.insert(0, str(SCRIPTS))
sys.dont_write_bytecode = True
from regression import builds, expectations, judge, measure, report  # noqa: E402
from regression.failure import BadInput  # noqa: E402

RUNS = 40


def setUpModule():
    judge.RESAMPLES = 300  # for speed: the ends of intervals are a little rougher


def rounds(seed, head=1.0, control=1.0, round_noise=0.02, sitting_noise=0.004, sittings=6, count=10):
    """Times of base, control and head, with what a disturbed machine adds: noise of every round, one shift for each
    build and sitting, and now and then a round that takes half as long again."""
    random = numpy.random.default_rng(seed)
    logs = numpy.log(1e6 * numpy.array([1, control, head])) + numpy.zeros((sittings, count, 3))
    logs += random.normal(0, round_noise, (sittings, count, 3)) + random.normal(0, sitting_noise, (sittings, 1, 3))
    logs += 0.4 * (random.random((sittings, count, 3)) < 0.03)
    return numpy.exp(logs)


def finding(seed, instructions=None, **truth):
    return judge.judge_pool(rounds(seed, **truth), judge.time_limit(instructions), numpy.random.default_rng(seed)).finding


def findings(instructions=None, **truth):
    return [finding(seed, instructions, **truth) for seed in range(RUNS)]


EVEN = judge.Interval(1, 1, 1)


def batch(what):
    return judge.Batch(EVEN, EVEN, what)


class Time(unittest.TestCase):
    def test_equal_builds_pass_every_time(self):
        self.assertEqual(findings(), ["fine"] * RUNS)

    def test_equal_builds_pass_even_where_instructions_rose(self):
        self.assertEqual(findings(instructions=1.01), ["fine"] * RUNS)

    def test_5_percent_is_found_where_instructions_rose(self):
        self.assertGreaterEqual(findings(instructions=1.05, head=1.05).count("slow"), RUNS - 4)

    def test_5_percent_may_be_the_layout_of_code_alone(self):
        self.assertEqual(findings(instructions=1.0, head=1.05), ["fine"] * RUNS)

    def test_15_percent_is_found_without_instructions(self):
        self.assertEqual(findings(head=1.15), ["slow"] * RUNS)

    def test_an_accepted_slowdown_passes_and_a_greater_one_does_not(self):
        limit = judge.time_limit(1.0, judge.Accepted(1.0, 1.15))
        for head, expected in ((1.15, "fine"), (1.35, "slow")):
            found = judge.judge_pool(rounds(1, head=head), limit, numpy.random.default_rng(1))
            self.assertEqual(found.finding, expected)

    def test_a_speedup_is_fine_and_is_told(self):
        found = judge.judge_pool(rounds(1, head=0.85), judge.TIME_FAIL, numpy.random.default_rng(1))
        self.assertEqual(found.finding, "fine")
        self.assertAlmostEqual(found.head.median, 0.85, delta=0.01)
        self.assertIn("faster", report.words(case(batches=[found], time_verdict=judge.PASS)))

    def test_nothing_is_believed_of_a_machine_that_tells_equal_builds_apart(self):
        self.assertEqual(findings(head=1.15, control=1.05), ["off"] * RUNS)
        self.assertEqual(findings(head=1.15, control=0.95), ["off"] * RUNS)

    def test_a_restless_machine_is_not_believed(self):
        self.assertEqual(set(findings(round_noise=0.5, sitting_noise=0.3)) - {"off", "wide"}, set())

    def test_the_interval_holds_the_truth_about_as_often_as_it_says(self):
        generator = numpy.random.default_rng(0)
        held = 0
        for seed in range(200):
            logs = numpy.log(rounds(seed, head=1.05))
            ratios = logs[:, :, 2] - logs[:, :, 0]
            found = judge.interval(ratios, judge.medians_drawn_anew(ratios, generator))
            held += found.low <= 1.05 <= found.high
        self.assertGreaterEqual(held, 180)

    def test_a_slowdown_counts_when_two_pools_agree(self):
        for found, verdict in (
            ("", None), ("slow", None), ("off", None), ("wide", None), ("fine", judge.PASS),
            ("slow fine", judge.PASS), ("wide fine", judge.PASS), ("slow slow", judge.REGRESSION),
            ("slow wide", None), ("off off", None), ("slow wide slow", judge.REGRESSION),
            ("wide slow slow", judge.REGRESSION), ("slow wide fine", judge.PASS),
        ):
            self.assertEqual(case_time(found).judged(), verdict, found)

    def test_what_is_left_open_is_undecided_only_if_nothing_was_found_against_it(self):
        above = judge.Interval(1.08, 1.1, 1.2)
        for found, head, verdict in (
            ("wide", EVEN, judge.UNDECIDED), ("off wide", EVEN, judge.UNDECIDED), ("slow wide", EVEN, judge.INCONCLUSIVE),
            ("wide off", EVEN, judge.INCONCLUSIVE), ("wide", above, judge.INCONCLUSIVE),
            ("slow fine", EVEN, judge.PASS), ("slow slow", above, judge.REGRESSION),
        ):
            self.assertEqual(case_time(found, head).verdict(), verdict, found)

    def test_batches_are_pooled_until_a_slowdown_is_to_be_confirmed(self):
        time, pooled = judge.CaseTime(judge.TIME_FAIL, 1), 0
        while time.is_open():
            time.add(rounds((1, len(time.batches)), head=1.15, round_noise=0.12, sittings=4), numpy.random.default_rng(1))
            pooled = 0 if time.batches[-1].finding == "slow" else pooled + 1
            self.assertEqual(time.pooled, pooled)
        self.assertEqual(time.verdict(), judge.REGRESSION)
        self.assertIn("wide", [batch.finding for batch in time.batches])

    def test_a_slowdown_once_found_is_not_dropped_for_one_good_batch(self):
        time = judge.CaseTime(judge.TIME_FAIL, 1)
        while time.is_open():
            batch = len(time.batches)
            time.add(rounds(batch, head=1.3 if batch == 0 else 1.0), numpy.random.default_rng(1))
        self.assertEqual([batch.finding for batch in time.batches][:2], ["slow", "wide"])
        self.assertEqual(time.verdict(), judge.PASS)

    def test_so_many_equal_controls_lean_by_chance(self):
        self.assertEqual([judge.chance_of_leaning(cases) for cases in (1, 16, 26)], [1, 3, 4])


def case_time(findings, head=EVEN):
    time = judge.CaseTime(judge.TIME_FAIL, 1)
    time.batches = [judge.Batch(head, EVEN, what) for what in findings.split()]
    return time


class Run:
    """The judgement of a run, on a machine as restless as was met: rounds differ by 7 %, some cases by more."""
    RESTLESS = {"round_noise": 0.07, "sitting_noise": 0.01, "sittings": 4, "count": 15}

    def __init__(self, seed, cases, limit=judge.TIME_FAIL):
        """cases: what the rounds of each are made of."""
        def take(batch, pending):
            return {case: rounds((seed, batch, case), **{**self.RESTLESS, **cases[case]}) for case in pending}
        self.found = judge.judge_times(take, dict.fromkeys(range(len(cases)), limit), numpy.random.default_rng(seed))
        times, untold = judge.time_verdicts(self.found)
        same = dict.fromkeys(range(len(cases)), "same")
        self.verdict, self.failed, self.open, self.undecided = judge.judge_all([], same, times, untold)


class WholeRuns(unittest.TestCase):
    def verdicts(self, cases, runs=RUNS):
        return [Run(seed, cases).verdict for seed in range(runs)]

    def test_equal_builds_pass_40_times_of_40(self):
        self.assertEqual(self.verdicts([{}] * 15 + [{"round_noise": 0.15}]), [judge.PASS] * RUNS)

    def test_15_percent_in_one_case_is_found_every_time(self):
        self.assertEqual(self.verdicts([{}, {"head": 1.15, "round_noise": 0.1}]), [judge.REGRESSION] * RUNS)

    def test_a_speedup_passes(self):
        self.assertEqual(self.verdicts([{"head": 0.85}] * 4, 10), [judge.PASS] * 10)

    def test_one_hopeless_case_passes_undecided_and_many_do_not(self):
        hopeless = {"round_noise": 1.5, "sitting_noise": 0.3}
        for seed in range(5):
            run = Run(seed, [{}] * 15 + [hopeless])
            self.assertEqual((run.verdict, run.undecided), (judge.PASS, [15]))
            run = Run(seed, [{}] * 13 + [hopeless] * 3)
            self.assertEqual((run.verdict, len(run.open)), (judge.INCONCLUSIVE, 3))

    def test_a_hopeless_case_with_more_instructions_does_not_pass(self):
        for told in ("warn", "unknown"):
            verdict, *_ = judge.judge_all([], {"a": told, "b": "same"}, {"a": judge.UNDECIDED, "b": judge.PASS})
            self.assertEqual(verdict, judge.INCONCLUSIVE)

    def test_a_control_that_is_off_yields_no_guess(self):
        for head in (1.0, 1.15):
            for control in (0.93, 1.07):
                self.assertEqual(self.verdicts([{"control": control, "head": head}] * 4, 2), [judge.INCONCLUSIVE] * 2)
                self.assertEqual(self.verdicts([{}] * 3 + [{"control": control, "head": head}], 2), [judge.INCONCLUSIVE] * 2)


class Instructions(unittest.TestCase):
    def test_warn_above_half_a_percent_and_fail_above_two(self):
        for ratio, expected in ((1.0, "same"), (1.005, "same"), (1.0051, "warn"), (1.02, "warn"), (1.0201, "fail"),
                                (1.05, "fail"), (0.95, "faster"), (None, "unknown")):
            self.assertEqual(judge.judge_instructions(ratio), expected, ratio)

    def test_accepted_ones_pass_and_more_do_not(self):
        accepted = judge.Accepted(instructions=1.05)
        self.assertEqual(judge.judge_instructions(1.05, accepted), "same")
        self.assertEqual(judge.judge_instructions(1.08, accepted), "fail")


def answer(**changes):
    return {"inputs": "01", "cells": 1, "spheres": 2, "boxes": 3, "triangles": 4, "answers": "0a", "details": "0b",
            "needs_file": False, "note": "", **changes}


class Answers(unittest.TestCase):
    def told(self, **changes):
        return [(kind, text) for _, kind, text in judge.judge_answers({"a": answer()}, {"a": answer(**changes)})]

    def test_the_same_numbers_pass(self):
        self.assertEqual(self.told(), [])

    def test_every_difference_fails(self):
        self.assertEqual(self.told(answers="0c"), [("fail", "other answers")])
        self.assertEqual(self.told(details="0c"), [("fail", "other points or normals")])
        self.assertEqual(self.told(inputs="02"), [("fail", "the inputs changed: another scene or trajectory")])
        for counter in measure.COUNTERS:
            self.assertEqual(self.told(**{counter: 9})[0][0], "fail")
        self.assertEqual(self.told(boxes=9), [("fail", "boxes looked at: 9, expected 3")])
        self.assertEqual(self.told(note="this core knows no such detector", inputs=""),
                         [("fail", "this core knows no such detector")])

    def test_new_and_lost_cases_fail(self):
        told = list(judge.judge_answers({"old": answer()}, {"new": answer()}))
        self.assertEqual([(case, kind) for case, kind, _ in told], [("old", "fail"), ("new", "fail")])

    def test_a_mesh_that_is_not_here_is_skipped_and_told(self):
        missing = {"needs_file": True, "inputs": "", "note": "the mesh is not installed"}
        self.assertEqual(self.told(**missing), [("skip", "the mesh is not installed")])
        self.assertEqual(self.told(needs_file=True, inputs="02")[0][0], "skip")
        self.assertEqual(self.told(needs_file=True, answers="0c")[0][0], "fail")


class Verdict(unittest.TestCase):
    def verdict(self, answers=(), instructions=None, times=None, untold=()):
        return judge.judge_all(list(answers), instructions or {}, times or {}, untold)[0]

    def test_restless_timing_hides_no_failure(self):
        restless = {"a": judge.INCONCLUSIVE}
        self.assertEqual(self.verdict(times=restless), judge.INCONCLUSIVE)
        self.assertEqual(self.verdict([("a", "fail", "other answers")], times=restless), judge.REGRESSION)
        self.assertEqual(self.verdict(instructions={"b": "fail"}, times=restless), judge.REGRESSION)
        self.assertEqual(self.verdict(times={**restless, "b": judge.REGRESSION}), judge.REGRESSION)

    def test_warnings_and_skipped_meshes_pass(self):
        self.assertEqual(self.verdict([("a", "skip", "not here")], {"a": "warn", "b": "faster"}, {"a": judge.PASS}),
                         judge.PASS)

    def test_what_was_not_measured_is_not_passed(self):
        self.assertEqual(self.verdict(untold=["base does not build"]), judge.INCONCLUSIVE)


def case(**changes):
    return {"answers": [], "instructions_ratio": 1.0, "instructions_finding": "same", "time_verdict": judge.PASS,
            "batches": [batch("fine")], **changes}


class Report(unittest.TestCase):
    def test_the_gravest_is_told_of_each_case(self):
        self.assertEqual(report.words(case()), "ok")
        self.assertEqual(report.words(case(answers=["other answers"], time_verdict=judge.REGRESSION)),
                         "other answers; SLOWER")
        self.assertEqual(report.words(case(instructions_finding="fail")), "MORE INSTRUCTIONS")
        self.assertEqual(report.words(case(batches=[batch("slow"), batch("fine")])), "slower once, not again")
        self.assertEqual(report.words(case(batches=[batch("off")] * 3, time_verdict=judge.INCONCLUSIVE)),
                         "time inconclusive: off, off, off")
        self.assertEqual(report.words(case(time_verdict=None)), "time not believed")
        self.assertEqual(report.words(case(batches=[judge.Batch(judge.Interval(0.9, 1, 1.2), EVEN, "wide")],
                                           time_verdict=judge.UNDECIDED)), "time undecided within -10 to +20 %")

    def test_the_table_has_a_line_for_each_case(self):
        lines = report.table({"a": case(), "b": case(batches=[], time_verdict=None)}).splitlines()
        self.assertEqual(len(lines), 3)
        self.assertIn("+0.0 % [+0.0, +0.0]", lines[1])

    def test_the_record_is_json(self):
        record = json.loads(report.as_json({"cases": {"a": case()}}))
        self.assertEqual(record["cases"]["a"]["batches"][0]["head"], {"low": 1, "median": 1, "high": 1})


class Files(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)

    def test_an_update_names_what_changed_and_keeps_what_is_not_here(self):
        path = self.folder / "answers.json"
        expectations.update_answers(path, {"a": answer(), "b": answer(), "c": answer()}, "first")
        changed = expectations.update_answers(
            path, {"a": answer(), "b": answer(boxes=9), "c": answer(note="not installed", inputs="")}, "fewer boxes")
        self.assertEqual(changed, ["b"])
        self.assertEqual(json.loads(path.read_text())["reason"], "fewer boxes")
        read = expectations.read_answers(path)
        self.assertEqual((read["b"]["boxes"], read["c"]["boxes"]), (9, 3))
        self.assertEqual([child.name for child in self.folder.iterdir()], ["answers.json"])

    def test_a_slowdown_is_accepted_against_its_own_base_only(self):
        path = self.folder / "accepted.json"
        expectations.write_accepted(path, "base one", "right for needles", {"a": (1.03, 0.99)})
        self.assertEqual(expectations.read_accepted(path, "base one"), {"a": judge.Accepted(1.03, 1.0)})
        self.assertEqual(expectations.read_accepted(path, "base two"), {})
        self.assertEqual(expectations.read_accepted(self.folder / "none.json", "base one"), {})

    def test_a_broken_expectation_is_refused_by_name(self):
        path = self.folder / "answers.json"
        with self.assertRaisesRegex(BadInput, "is missing"):
            expectations.read_answers(path)
        for text in ("{", '{"schema": 2, "cases": {}}'):
            path.write_text(text)
            with self.assertRaisesRegex(BadInput, "answers.json"):
                expectations.read_answers(path)

    def test_a_dump_of_callgrind_is_read_with_its_name(self):
        path = self.folder / "dump.1"
        path.write_text("version: 1\ndesc: Trigger: Client Request: grid-group/bunny/slide/nearest\n\nevents: Ir\n"
                        "fn=(1)\n5 100\ntotals: 1234\n")
        self.assertEqual(measure.read_dump(path), ("grid-group/bunny/slide/nearest", 1234))
        path.write_text("version: 1\ndesc: Trigger: Program termination\nevents: Ir\ntotals: 0\n")
        self.assertIsNone(measure.read_dump(path))

    def test_times_are_read_by_sitting_and_round(self):
        path = self.folder / "times.csv"
        path.write_text("case,sitting,round,base_ns,control_ns,head_ns\n" +
                        "".join(f'"a,b",{s},{r},1,2,{10 * s + r}\n' for s in range(2) for r in range(3)))
        times = measure.read_times(path)["a,b"]
        self.assertEqual(times.shape, (2, 3, 3))
        self.assertEqual(times[1, 2].tolist(), [1, 2, 12])


class Revisions(unittest.TestCase):
    """In a repository of three commits, each with another core."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = pathlib.Path(temporary.name) / "repository"
        (self.root / "core").mkdir(parents=True)
        patch = mock.patch.object(builds, "ROOT", self.root)
        patch.start()
        self.addCleanup(patch.stop)
        self.git("init", "-q", "-b", "work")
        self.commits = []
        for text in ("one", "two", "three"):
            (self.root / "core" / "a.h").write_text(text)
            (self.root / "CMakeLists.txt").write_text("project")
            self.git("add", ".")
            self.git("-c", "user.name=a", "-c", "user.email=a@b", "commit", "-q", "-m", text)
            self.commits.append(builds.commit_of("HEAD"))

    def git(self, *arguments):
        subprocess.run(["git", *arguments], cwd=self.root, check=True)

    def test_the_parent_is_the_base(self):
        self.assertEqual(builds.base_revision(None).commit, self.commits[1])

    def test_where_the_branch_left_main_is_the_base(self):
        self.git("update-ref", "refs/remotes/origin/main", self.commits[0])
        self.assertEqual(builds.base_revision(None).commit, self.commits[0])

    def test_on_main_the_parent_is_the_base(self):
        self.git("update-ref", "refs/remotes/origin/main", self.commits[2])
        self.assertEqual(builds.base_revision(None).commit, self.commits[1])

    def test_a_revision_that_is_not_there_is_named(self):
        with self.assertRaisesRegex(BadInput, "--against v9: no such revision"):
            builds.base_revision("v9")
        self.git("checkout", "-q", self.commits[0])
        with self.assertRaisesRegex(BadInput, "no parent"):
            builds.base_revision(None)

    def test_uncommitted_changes_are_told(self):
        self.assertNotIn("uncommitted", builds.head_revision().text)
        (self.root / "core" / "a.h").write_text("four")
        self.assertIn("uncommitted", builds.head_revision().text)

    def test_what_changed_is_what_is_judged(self):
        self.assertTrue(builds.is_unchanged_since(self.commits[2]))
        self.assertFalse(builds.is_unchanged_since(self.commits[1]))
        (self.root / "README.md").write_text("not judged")
        self.assertTrue(builds.is_unchanged_since(self.commits[2]))
        (self.root / "core" / "b.h").write_text("not committed")
        self.assertFalse(builds.is_unchanged_since(self.commits[2]))

    def test_a_tree_is_unpacked_anew_only_for_another_core(self):
        folder = self.root.parent / "base"
        source = builds.extracted(self.commits[0], folder)
        self.assertEqual((source / "core" / "a.h").read_text(), "one")
        (source / "core" / "a.h").write_text("mark")
        builds.extracted(self.commits[0], folder)
        self.assertEqual((source / "core" / "a.h").read_text(), "mark")
        builds.extracted(self.commits[1], folder)
        self.assertEqual((source / "core" / "a.h").read_text(), "two")


def measured(**changes):
    return {"a": answer(**changes), "b": answer(**changes)}


class Comparison(unittest.TestCase):
    """The whole of scripts/regress with made-up measurements in the place of builds."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.out = pathlib.Path(temporary.name)
        loader = importlib.machinery.SourceFileLoader("regress", str(SCRIPTS / "regress"))
        self.regress = importlib.util.module_from_spec(importlib.util.spec_from_loader("regress", loader))
        loader.exec_module(self.regress)
        self.regress.EXPECTED = self.out / "answers.json"
        self.regress.ACCEPTED = self.out / "accepted.json"
        self.regress.builds = mock.Mock(wraps=builds, DoesNotBuild=builds.DoesNotBuild, ROOT=self.out)
        self.regress.say = lambda text: None
        expectations.update_answers(self.regress.EXPECTED, measured(), "first")

    def compare(self, head="head", base="base", answers=None, instructions=1.0, truths=({},), unchanged=False, **options):
        """truths: what the rounds of each batch are made of. Returns the exit status and the record."""
        library = {"head": self.out / "head.so", "base": self.out / "base.so"}
        library["head"].write_text(head)
        library["base"].write_text(base or "")
        fakes = self.regress.builds
        fakes.head_revision.side_effect = fakes.base_revision.side_effect = lambda *_: builds.Revision("c0ffee", "text")
        fakes.core_of.side_effect = lambda commit: "core of base"
        fakes.is_unchanged_since.side_effect = lambda commit: unchanged
        fakes.extracted.side_effect = fakes.synchronised.side_effect = lambda *_: None

        def plugin(source, folder, driver=False):
            if base is None and not driver:
                raise builds.DoesNotBuild("base: the plug-in does not build; see build.log")
            return library["head" if driver else "base"]
        fakes.plugin.side_effect = plugin
        batches = iter(truths)

        def times(driver, plugins, out, seed, cases=()):
            now = next(batches)
            return {name: rounds(seed, **now) for name in cases or ("a", "b")}
        counted = [{"a": 1000, "b": 1000}, {"a": 1000, "b": 1000 * instructions}]
        arguments = argparse.Namespace(out=self.out, against=None, seed=1, accept=False,
                                       reason=None, **options)
        self.arguments = arguments
        with mock.patch.object(measure, "answers", lambda _, plugins: [answers or measured(), measured()][:len(plugins)]), \
                mock.patch.object(measure, "instructions", lambda *_: counted), \
                mock.patch.object(measure, "times", times), contextlib.redirect_stdout(io.StringIO()) as printed:
            status = self.regress.compare(arguments)
        self.printed = printed.getvalue()
        return status, json.loads((self.out / "report.json").read_text())

    def test_equal_builds_pass(self):
        status, record = self.compare()
        self.assertEqual((status, record["verdict"], record["failed"]), (0, "pass", []))
        self.assertEqual(len(record["cases"]["a"]["batches"]), 1)
        self.assertIn("verdict: PASS", self.printed)

    def test_the_same_bits_are_not_timed(self):
        status, record = self.compare(head="same", base="same", truths=())
        self.assertEqual((status, record["same_build"]), (0, True))

    def test_a_base_with_the_same_core_is_not_built(self):
        status, record = self.compare(base=None, unchanged=True, truths=())
        self.assertEqual((status, record["same_build"]), (0, True))

    def test_a_slowdown_fails_after_two_batches(self):
        status, record = self.compare(truths=({"head": 1.15}, {"head": 1.15}))
        self.assertEqual((status, record["failed"]), (1, ["a: slower", "b: slower"]))
        self.assertEqual(len(record["cases"]["a"]["batches"]), 2)

    def test_instructions_fail_of_their_own_case(self):
        status, record = self.compare(instructions=1.03)
        self.assertEqual((status, record["failed"]), (1, ["b: more instructions"]))

    def test_a_restless_machine_is_inconclusive_and_hides_no_other_answers(self):
        restless = ({"control": 1.06, "sitting_noise": 0.001},) * judge.BATCHES
        self.assertEqual(self.compare(truths=restless)[0], 4)
        status, record = self.compare(answers=measured(answers="0c"), truths=restless)
        self.assertEqual((status, record["failed"]), (1, ["a: other answers", "b: other answers"]))
        self.assertEqual(len(record["inconclusive"]), 1)
        self.assertIn("a: base finds what is expected", record["remarks"])
        self.assertIn("--update-expected", self.printed)

    def test_a_base_that_does_not_build_leaves_the_answers_to_be_judged(self):
        status, record = self.compare(base=None, truths=())
        self.assertEqual(status, 4)
        self.assertIn("does not build", record["inconclusive"][0])
        self.assertEqual(self.compare(base=None, answers=measured(boxes=9), truths=())[0], 1)

    def test_an_accepted_slowdown_passes_the_next_time(self):
        slower = {"instructions": 1.05, "truths": ({"head": 1.12}, {"head": 1.12})}
        with mock.patch.object(self.regress.builds, "ROOT", self.out):
            self.compare(**slower)
            comparison = self.regress.Comparison(self.arguments)
            comparison.ratios, comparison.findings = {"a": 1.0, "b": 1.05}, {"a": "same", "b": "fail"}
            comparison.times = {"a": judge.REGRESSION, "b": judge.REGRESSION}
            slow = judge.Batch(judge.Interval(1.1, 1.12, 1.14), judge.Interval(1, 1, 1), "slow")
            comparison.batches = {"a": [slow, slow], "b": [slow, slow]}
            self.regress.accept(comparison, "worth it")
        self.assertEqual(self.compare(**slower)[0], 0)


class AnswersOfAFile(unittest.TestCase):
    """scripts/regress --answers, for what another compiler's touchmark-regression has written."""

    def setUp(self):
        self.cases = expectations.read_answers(SCRIPTS.parent / "results" / "expected" / "answers.json")

    def judged(self, **changed):
        """Exit status and text, for what is expected but for one case."""
        header = ("case", "needs_file", *expectations.FIELDS, "note")
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "answers.csv"
            with open(path, "w", newline="", encoding="utf-8") as file:
                rows = csv.DictWriter(file, header)
                rows.writeheader()
                for name, case in self.cases.items():
                    rows.writerow({"case": name, "needs_file": "0", **case, **changed.get(name, {})})
            done = subprocess.run([SCRIPTS / "regress", "--answers", path], capture_output=True, text=True, check=False)
        return done.returncode, done.stdout

    def test_pass_where_they_are_the_expected_ones(self):
        self.assertEqual(self.judged(), (0, f"{len(self.cases)} of {len(self.cases)} cases have the expected answers and work\n"))

    def test_fail_where_an_answer_or_the_work_differs(self):
        name = next(iter(self.cases))
        for change in ({"answers": "0" * 16}, {"details": "0" * 16}, {"triangles": 7}, {"inputs": "0" * 16}):
            status, text = self.judged(**{name: change})
            self.assertEqual(status, 1)
            self.assertIn(f"failed: {name}", text)

    def test_tell_what_was_left_out_and_fail_where_that_is_all(self):
        left_out = {"needs_file": "1", **dict.fromkeys(expectations.FIELDS, ""), "note": "left out"}
        name = next(iter(self.cases))
        status, text = self.judged(**{name: left_out})
        self.assertEqual(status, 0)
        self.assertIn(f"left out: {name}", text)
        self.assertEqual(self.judged(**dict.fromkeys(self.cases, left_out))[0], 1)

    def test_that_are_missing_are_refused(self):
        done = subprocess.run([SCRIPTS / "regress", "--answers", "/no/such/file"], capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 3)
        self.assertNotIn("Traceback", done.stderr)


class CommandLine(unittest.TestCase):
    def test_wrong_arguments_are_refused(self):
        for arguments in (["--accept"], ["--update-expected"], ["--update-expected", "--reason", " "],
                          ["--reason", "why"], ["--seed", "-1"],
                          ["--accept", "--update-expected", "--reason", "why"], ["--against", "no-such-revision"]):
            with tempfile.TemporaryDirectory() as out:
                done = subprocess.run([SCRIPTS / "regress", *arguments, "--out", out], capture_output=True, text=True,
                                      check=False)
            self.assertEqual(done.returncode, 2, arguments)
            self.assertNotIn("Traceback", done.stderr)


if __name__ == "__main__":
    unittest.main()
