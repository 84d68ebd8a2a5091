#!/usr/bin/python3
"""scripts/report on made-up recordings: what it reads, how large the page is, what the page asks for, and what it does without
the interactive parts."""
import base64
import csv
import json
import math
import os
import pathlib
import random
import re
import struct
import subprocess
import sys
import tempfile
import unittest
import zlib

import numpy

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(pathlib.Path(__file__).parent)]

import made_up_steps  # noqa: E402
from made_up_steps import Contestant  # noqa: E402
from reporting import packing, parts, words  # noqa: E402
from reporting.recording import Recording  # noqa: E402
from reporting.steps_file import Damaged, StepsFile, times_of  # noqa: E402

REPORT = ROOT / "scripts" / "report"
BUDGET = 3_000_000


def can_build():
    try:
        parts.built()
    except parts.Missing:
        return False
    return True


def unpacked(page, name):
    """What an element of the page carries, as the page's loader sees it."""
    text = re.search(rf'<script type="application/octet-stream" id="{name}">([^<]*)</script>', page)[1]
    return zlib.decompress(base64.b85decode(text.replace(".", "<")))


def items_of(stream, about):
    """What the page's reader makes of an array of unsigned integers, in plain arithmetic."""
    offset, items, kind, order = about
    width = int(kind[1:]) // 8
    numbers = [sum(stream[offset + plane * items + item] << (8 * plane) for plane in range(width)) for item in range(items)]
    for turn in range(order):
        if turn == 0:
            numbers = [number // 2 if number % 2 == 0 else -(number + 1) // 2 for number in numbers]
        numbers = [sum(numbers[:item + 1]) for item in range(items)]
    return [number % (1 << (8 * width)) for number in numbers]


class InFolder(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name) / "run"
        self.folder.mkdir()

    def write(self, steps=300, **wrong):
        contestants = [Contestant("grid-group", 100, steps, 1), Contestant("fcl:bv=obb", 2000, steps, 2, **wrong)]
        made_up_steps.write(self.folder, contestants, steps)
        return contestants

    def report(self, *arguments, **environment):
        return subprocess.run([REPORT, *(arguments or [self.folder])], capture_output=True, text=True, check=False,
                              env={**os.environ, **environment})

    def page(self, **environment):
        done = self.report(**environment)
        self.assertEqual(done.returncode, 0, done.stderr)
        return (self.folder / "report.html").read_text(encoding="utf-8")


class ReadingSteps(InFolder):
    def test_times_are_what_was_written_and_their_ends_exact(self):
        one = self.write()[0]
        file = StepsFile(self.folder / "steps.bin")
        times = times_of(file, file.traces[0]["contestants"][0]["ns"])
        self.assertEqual(times.max(), max(one.ns))
        self.assertEqual(times.min(), min(one.ns))
        for read, written in zip(times, one.ns):
            self.assertAlmostEqual(read / written, 1, delta=1e-4)

    def test_answers_work_and_charges_are_what_was_written(self):
        one = self.write(wrong=[7, 9])[1]
        file = StepsFile(self.folder / "steps.bin")
        row = file.traces[0]["contestants"][1]
        self.assertEqual(list(file.block(row["work"])), one.work)
        self.assertEqual([step for step, kinds in enumerate(file.block(row["charged"])) if kinds], [7, 9])

    def test_a_damaged_file_is_told_of_and_the_page_made_without_it(self):
        self.write()
        path = self.folder / "steps.bin"
        whole = path.read_bytes()
        for damaged in (b"", b"TMSTEPS\n", b"TMSTEPT\n" + whole[8:], whole[:8] + b"\2" + whole[9:], whole[:40], b"TMSTEPS\n" + b"\xff" * 100):
            path.write_bytes(damaged)
            with self.assertRaises(Damaged):
                StepsFile(path)
            self.assertIn("There is no replay", self.page())

    def test_a_block_that_was_cut_off_leaves_a_page_that_says_so(self):
        self.write()
        path = self.folder / "steps.bin"
        path.write_bytes(path.read_bytes()[:-400])
        if not can_build():
            self.skipTest("without esbuild no page reads blocks")
        page = self.page()
        self.assertIn("There is no replay: ", page)
        self.assertIn("a block is damaged", page)
        self.assertIsNone(json.loads(unpacked(page, "data"))["recordings"][0]["replay"])

    def test_a_header_that_lacks_what_it_should_have_is_told_of(self):
        self.write()
        path = self.folder / "steps.bin"
        if not can_build():
            self.skipTest("without esbuild no page reads blocks")
        for trace in ({}, {"low": 5}, []):
            text = json.dumps({"schema": 1, "run_id": made_up_steps.RUN_ID, "traces": [trace], "mesh": {"near": {}}}).encode()
            path.write_bytes(b"TMSTEPS\n" + struct.pack("<II", 1, len(text)) + text)
            self.assertIn("its header is not as", self.page())

    def test_steps_of_another_run_are_left_out(self):
        self.write()
        results = self.folder / "results.csv"
        results.write_text(results.read_text(encoding="utf-8").replace(made_up_steps.RUN_ID, "another"), encoding="utf-8")
        self.assertIn("steps.bin is of another run", self.page())


class Page(InFolder):
    def test_says_who_is_fastest_who_holds_which_rate_and_who_is_wrong(self):
        self.write(steps=1000, wrong=range(10))
        sentences = words.verdict(Recording(self.folder))
        self.assertIn("grid-group</strong> is the fastest that was never wrong in 1,000 checked steps", sentences[0])
        self.assertIn("2 held 1 kHz at every warm step, 2 held 4 kHz and 2 held 10 kHz", sentences[1])
        self.assertEqual(sentences[2], "Wrong: fcl:bv=obb at 1 % of the steps.")

    def test_a_slowest_step_that_is_the_period_holds_and_one_above_does_not(self):
        self.assertIn("holds 1, 4 and 10 kHz", words.holding("It", 100_000))
        self.assertIn("holds 1 and 4 kHz", words.holding("It", 100_001))
        self.assertIn("too long for 1 kHz", words.holding("It", 1_000_001))

    def test_asks_the_network_for_nothing(self):
        self.write()
        page = self.page()
        # What a browser would fetch; addresses in comments and in XML namespaces are none of it.
        self.assertEqual(re.findall(r"""<(?:script|img|link|iframe|source)[^>]*\b(?:src|href)=(?!["']?(?:data:|#))[^ >]+""", page), [])
        self.assertEqual(re.findall(r"url\((?!\s*['\"]?data:)\s*['\"]?[a-z]+:", page), [])
        self.assertEqual(re.findall(r"@import", page), [])
        self.assertIn("default-src 'none'", page)

    def test_names_from_files_cannot_become_elements(self):
        self.write()
        results = self.folder / "results.csv"
        results.write_text(results.read_text(encoding="utf-8").replace("ball", "</script><b>x"), encoding="utf-8")
        self.assertNotIn("</script><b>", self.page())

    def test_twenty_contestants_with_20000_steps_stay_within_the_budget(self):
        if not can_build():
            self.skipTest("the interactive parts cannot be built here")
        steps = 20_000
        made_up_steps.write(self.folder, [Contestant(f"detector-{k}", 50 * 1.5 ** k, steps, k) for k in range(20)], steps)
        page = self.page()
        self.assertLess(len(page.encode()), BUDGET)
        data, stream = json.loads(unpacked(page, "data")), unpacked(page, "arrays")
        offset, items, kind, _ = data["recordings"][0]["replay"]["traces"][0]["contestants"][19]["ns"]
        self.assertEqual((items, kind), (steps, "u8"))
        self.assertGreaterEqual(len(stream), offset + items)

    def test_arrays_come_back_from_differences_and_from_base_85(self):
        smooth = numpy.array([(k * k + (k % 7)) % 65536 for k in range(500)], numpy.uint16)
        packer = packing.Packer()
        about = [packer.add(array) for array in (smooth, smooth.astype(numpy.uint32) << 15, numpy.array([0, 255, 0], numpy.uint8),
                                                 numpy.array([0.1, -1e300, math.inf]), numpy.zeros(0, numpy.uint8))]
        stream = zlib.decompress(base64.b85decode(packer.text().replace(".", "<")))
        self.assertGreater(about[0][3], 0)
        self.assertEqual(items_of(stream, about[0]), list(smooth))
        self.assertEqual(items_of(stream, about[1]), list(smooth.astype(numpy.uint32) << 15))
        self.assertEqual(items_of(stream, about[2]), [0, 255, 0])
        self.assertEqual(struct.unpack("<3d", bytes(stream[about[3][0] + plane * 3 + item] for item in range(3) for plane in range(8))),
                         (0.1, -1e300, math.inf))
        self.assertEqual(about[4][1], 0)

    def test_nothing_packed_can_end_its_element(self):
        draw = random.Random(1)
        self.assertNotRegex(packing.packed(draw.randbytes(100_000)), r"[<\s]|</")

    def test_without_the_interactive_parts_there_are_pictures_and_a_reason(self):
        self.write()
        subprocess.run([ROOT / "scripts" / "plot", self.folder], check=True, capture_output=True)
        page = self.page(TOUCHMARK_JAVASCRIPT="/nowhere", XDG_CACHE_HOME=str(self.folder / "cache"))
        self.assertIn("The interactive parts of this page are missing", page)
        self.assertIn("scripts/setup report", page)
        self.assertIn('src="data:image/png;base64,', page)
        self.assertNotIn("<script", page)
        self.assertIn("grid-group", page)

    def test_a_folder_without_steps_has_a_page_that_says_so(self):
        self.write()
        (self.folder / "steps.bin").unlink()
        self.assertIn("This folder has no steps.bin", self.page())

    def rewrite(self, change):
        """Each row of results.csv as `change` makes it."""
        path = self.folder / "results.csv"
        with open(path, newline="", encoding="utf-8") as file:
            reader = csv.DictReader(file)
            rows, columns = list(reader), reader.fieldnames
        for number, row in enumerate(rows):
            change(number, row)
        with open(path, "w", newline="", encoding="utf-8") as file:
            writer = csv.DictWriter(file, columns)
            writer.writeheader()
            writer.writerows(rows)

    def test_a_contestant_that_failed_is_told_of(self):
        self.write()
        self.rewrite(lambda number, row: number == 1 and row.update(status="crashed:SIGSEGV", ns_per_query="", ns_p50="", ns_p90="", ns_p99="",
                                                                    ns_p999="", ns_max="", judged=""))
        page = self.page()
        self.assertIn("Did not finish everywhere: fcl:bv=obb.", page)
        self.assertIn("crashed:SIGSEGV", page)

    def test_all_that_failed_is_no_verdict(self):
        self.write()
        self.rewrite(lambda number, row: row.update(status="timeout", ns_per_query="", ns_max="", ns_p999=""))
        self.assertIn("No contestant finished all trajectories without a wrong answer.", self.page())

    def test_numbers_that_are_none_are_dashes(self):
        self.write()
        self.rewrite(lambda number, row: row.update(ns_p999="nan", ns_max="inf", bytes="-nan", max_distance_error_of_diagonal="nan", judged="nan"))
        page = self.page()
        self.assertIn("grid-group", page)
        self.assertNotRegex(re.sub(r"<script.*?</script>", "", page, flags=re.S), r">\s*-?(nan|inf)\b")

    def test_one_contestant_alone_is_the_first(self):
        made_up_steps.write(self.folder, [Contestant("grid-group", 100, 300, 1)], 300)
        self.assertIn("grid-group</strong> is the fastest that was never wrong", self.page())

    def test_results_without_a_row_are_refused_in_one_line(self):
        self.write()
        results = self.folder / "results.csv"
        for text, why in ((results.read_text(encoding="utf-8").splitlines()[0] + "\n", "no row follows the header"), ("", "")):
            results.write_text(text, encoding="utf-8")
            done = self.report()
            self.assertEqual((done.returncode, done.stderr.count("\n")), (2, 1), done.stderr)
            self.assertIn(why, done.stderr)
            self.assertFalse((self.folder / "report.html").exists())

    def test_results_of_several_questions_are_not_mixed(self):
        self.write()
        results = self.folder / "results.csv"
        lines = results.read_text(encoding="utf-8").splitlines()
        results.write_text("\n".join([*lines, *(line.replace(",ball,", ",cube,") for line in lines[1:])]) + "\n", encoding="utf-8")
        page = self.page()
        self.assertIn("results.csv has 2 questions; tables and verdict are of the first: mesh ball, query nearest.", page)

    def test_what_queries_looked_at_is_read_or_its_fault_told(self):
        self.write()
        visited = self.folder / "visited.json"
        step = {"step": 100, "found": True, "boxes": [[0, 0, 0, 1, 1, 1, 1], [0, 0, 0, 0.5, 1, 1, 0]], "triangles": [3]}
        good = {"schema": 1, "run_id": made_up_steps.RUN_ID, "rows": [{"detector": "grid-group", "options": "", "trajectory": "slide", "steps": [step]}]}
        visited.write_text(json.dumps(good), encoding="utf-8")
        if can_build():
            self.assertEqual(json.loads(unpacked(self.page(), "data"))["recordings"][0]["visits"]["rows"][0]["name"], "grid-group")
        short = {**good, "rows": [{**good["rows"][0], "steps": [{**step, "boxes": [[0, 0, 0, 1]]}]}]}
        for content, told in (("{", "is not as it should be"), ("[]", "is not as it should be"), (json.dumps({**good, "schema": 2}), "is of version 2"),
                              (json.dumps(short), "is not as it should be"), (json.dumps({**good, "run_id": "another"}), "is of another run")):
            visited.write_text(content, encoding="utf-8")
            self.assertIn(told, self.page())

    def test_a_suite_has_its_own_sentence(self):
        cells = "mesh,trajectory,query,reach,caches,ours,exact_rival,exact_ratio\na,slide,nearest,1%,warm,x,y,4\nb,jump,nearest,1%,warm,x,y,0.25\nb,slide,nearest,1%,warm,x,,\n"
        (self.folder / "suite.csv").write_text(cells, encoding="utf-8")
        page = self.page()
        self.assertIn("In 1 of 2 cells the best of ours is faster than the fastest exact rival; over all, the rival takes <strong>1.00 times</strong>", page)
        self.assertIn("The worst cell: 0.25 times, b, jump, nearest, reach 1%, caches warm. 1 more have no such pair", page)

    def test_proxies_are_summed_up_by_method(self):
        (self.folder / "proxy.csv").write_text("method,options,family,courses,crossings,max_ns\np,,a,2,3,5\np,,b,4,5,4\nq,,a,1,0,\n", encoding="utf-8")
        page = self.page()
        self.assertIn('<td>p</td><td></td><td data-v="6">6</td>', page)
        self.assertIn('<td data-v="8">8</td>', page)

    def test_growth_with_the_number_of_bodies_is_shown(self):
        (self.folder / "bodies.csv").write_text("schema,detector,bodies,tick_over_one\n1,grid-group,100,1.25\n", encoding="utf-8")
        page = self.page()
        self.assertIn("Growth with the number of bodies", page)
        self.assertIn('<td data-v="1.25">1.25</td>', page)

    def test_a_run_json_of_other_shapes_leaves_its_facts_out(self):
        self.write()
        for about in ([], {"steadiness": 5}, {"load_average": "x", "clock": 5, "command_line": 3}, {"steadiness": [{"control": None}, 5]},
                      {"steadiness": [{"control": {"ratio": "x", "ratio_low": None}, "disturbed_share": "a"}]},
                      {"mesh": 5, "cores": "x", "clock": {"cost_ns": "abc"}}):
            (self.folder / "run.json").write_text(json.dumps(about), encoding="utf-8")
            self.assertIn("grid-group", self.page(), about)

    def test_a_scene_names_its_bodies_and_why_there_is_no_replay(self):
        self.write()
        (self.folder / "steps.bin").unlink()
        run = self.folder / "run.json"
        run.write_text(json.dumps({**json.loads(run.read_text(encoding="utf-8")), "mesh": {"name": "ball", "bodies": 12}}), encoding="utf-8")
        page = self.page()
        self.assertIn("ball, 12 bodies, 576 triangles, nearest", page)
        self.assertIn("a scene of bodies has none", page)

    def test_two_recordings_are_compared(self):
        self.write()
        other = self.folder.with_name("after")
        other.mkdir()
        made_up_steps.write(other, [Contestant("grid-group", 50, 300, 1)], 300)
        done = self.report(self.folder, other, "--out", self.folder / "both.html")
        self.assertEqual(done.returncode, 0, done.stderr)
        page = (self.folder / "both.html").read_text(encoding="utf-8")
        self.assertIn("after against run", page)
        self.assertIn('data-v="0.5"', page)
        self.assertIn("None of embree, aabb-tree, brute-force is in all recordings", page)

    def test_a_folder_without_results_is_refused_in_one_line(self):
        done = self.report()
        self.assertEqual(done.returncode, 2)
        self.assertRegex(done.stderr, r"\Areport: .*: no results\.csv in it, nor one of .*\n\Z")

    def test_a_page_that_cannot_be_written_is_told_of_and_leaves_nothing(self):
        self.write()
        done = self.report(self.folder, "--out", self.folder / "missing" / "page.html")
        self.assertEqual(done.returncode, 3)
        self.assertRegex(done.stderr, r"cannot write .*: No such file")


unittest.main()
