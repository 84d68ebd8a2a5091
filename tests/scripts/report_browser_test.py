#!/usr/bin/python3
"""The page of scripts/report in a real browser without network: `scripts/dev page` runs it, since Chromium is too large for
every CI run. A folder as argument is used in place of a made-up recording."""
import csv
import os
import pathlib
import re
import subprocess
import sys
import tempfile
import unittest

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "scripts"), str(pathlib.Path(__file__).parent)]

import made_up_steps  # noqa: E402
from browser import Browser, chromium  # noqa: E402
from made_up_steps import Contestant  # noqa: E402

CONTESTANTS, STEPS = 20, 20_000
INTERACTIVE_MS = 2000
WRONG = range(100, 160)


class Page(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        if not chromium():
            raise RuntimeError("chromium is not installed: scripts/setup page")
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        names = ["grid-group", "sphere-cluster", "fcl:bv=obb", "libccd+aabb", "fcl:bv=aabb,method=distance,narrow=exact"]
        names += [f"sphere-cluster:lookup=scan,precise=false,clustering={k}%" for k in range(CONTESTANTS - len(names))]
        cls.contestants = [Contestant(name, 100 * 1.4 ** k, STEPS, k, WRONG if k == 3 else ()) for k, name in enumerate(names)]
        made_up_steps.write(cls.folder, cls.contestants, STEPS)
        subprocess.run([ROOT / "scripts" / "report", cls.folder], check=True, stdout=subprocess.DEVNULL)
        cls.path = cls.folder / "report.html"
        with open(cls.folder / "results.csv", newline="", encoding="utf-8") as file:
            cls.rows = {record["detector"]: record for record in csv.DictReader(file)}
        cls.browser = Browser()

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.temporary.cleanup()

    def setUp(self):
        self.browser.errors.clear()
        self.browser.requests.clear()
        self.browser.resize(1300, 1000)
        self.ready_ms = self.browser.open(self.path)
        self.addCleanup(self.leave)

    def leave(self):
        """So that the next address is loaded anew."""
        self.browser.send("Page.navigate", url="about:blank")
        self.browser.until("location.href === 'about:blank'")

    def hash(self):
        return self.browser.run("location.hash")

    def step(self):
        found = re.search(r"\bstep=(\d+)", self.hash())
        return int(found[1]) if found else None

    def click(self, selector):
        x, y, width, height = self.browser.box(selector)
        self.browser.mouse("mousePressed", x + width / 2, y + height / 2, 1)
        self.browser.mouse("mouseReleased", x + width / 2, y + height / 2)

    def test_loads_in_time_without_an_error_or_a_request(self):
        self.assertLess(self.ready_ms, INTERACTIVE_MS * float(os.environ.get("TOUCHMARK_SLOWER", "1")))
        self.assertEqual(self.browser.errors, [])
        self.assertEqual([url for url in self.browser.requests if not url.startswith(("file:", "data:", "blob:"))], [])

    def test_sorts_by_any_column_and_back(self):
        first = "document.querySelector('table.ratios tbody tr').dataset.name"
        self.assertEqual(self.browser.run(first), "grid-group")
        self.click("table.ratios thead th:nth-child(2) button")
        self.click("table.ratios thead th:nth-child(2) button")
        self.assertEqual(self.browser.run(first), f"{self.contestants[-1].detector}:{self.contestants[-1].options}")
        self.assertEqual(self.browser.run("document.querySelector('table.ratios thead th:nth-child(2)').ariaSort"), "descending")

    def test_the_worst_step_has_the_number_of_the_csv(self):
        self.browser.run("[...document.querySelectorAll('.lists details')].forEach((one) => { one.open = true; })")
        self.click(".lists button.step[data-name='grid-group']")
        worst = self.contestants[0].slowest(1)[0]
        self.assertEqual(self.step(), worst)
        cells = self.browser.run("[...document.querySelectorAll('.about-step tr.current td')].map((cell) => cell.textContent)")
        most = float(self.rows["grid-group"]["ns_max"])
        self.assertEqual(cells[0], f"{most / 1000:.3g} µs")
        self.assertEqual(cells[-1], "right")
        self.assertIn(f"--step {worst}", self.browser.run("document.querySelector('.about-step .command code').textContent"))

    def test_dragging_over_the_curves_filters_all_of_them(self):
        x, y, width, height = self.browser.box(".chart[aria-label^='Time of each step']")
        self.browser.drag((x + width * 0.3, y + height / 2), (x + width * 0.5, y + height / 2))
        begin, end = map(int, re.search(r"steps=(\d+)-(\d+)", self.hash()).groups())
        self.assertLess(begin, end)
        self.assertLess(end - begin, STEPS / 3)
        counts = self.browser.run("[...document.querySelectorAll('[aria-label=\"The stretch in numbers\"] tbody tr td:nth-child(2)')].map((cell) => cell.textContent)")
        self.assertEqual(set(counts), {str(end - begin)})

    def test_an_address_leads_to_the_same_view(self):
        self.leave()
        self.browser.open(self.path, "#trajectory=slide&shown=fcl:bv%3Dobb&steps=90-200&step=101&contestant=libccd%2Baabb&color=error")
        self.assertEqual(self.browser.run("document.querySelector('.about-step h3').textContent"), "Step 101 of slide")
        self.assertIn("missed", self.browser.run("document.querySelector('.about-step tr.current').textContent"))
        self.assertEqual(self.browser.run("[...document.querySelectorAll('.swatches input:checked')].map((box) => box.value)"), ["fcl:bv=obb"])

    def test_the_keyboard_steps_plays_and_opens_the_numbers(self):
        self.browser.run("document.querySelector('.stage').focus()")
        for key, expected in (("ArrowRight", 1), ("ArrowRight", 2), ("ArrowLeft", 1), ("PageDown", 101)):
            self.browser.press(key)
            self.assertEqual(self.step(), expected)
        self.browser.press(" ", "Space", " ")
        self.browser.until("Number(/step=(\\d+)/.exec(location.hash)[1]) > 101")
        self.browser.press(" ", "Space", " ")
        self.assertEqual(self.browser.run("document.querySelector('.play').textContent"), "Play")
        self.browser.run("document.querySelector('table.ratios button.pick').focus()")
        self.browser.press("Enter", "Enter", "\r")
        self.assertIn("Measure again: touchmark bench", self.browser.until("document.querySelector('#details')?.textContent"))
        self.browser.press("Escape")
        self.browser.until("!document.querySelector('#details')")

    def test_cells_tell_their_errors_on_focus_and_on_hover(self):
        self.browser.run("document.querySelector('table.ratios td[tabindex=\"0\"]').focus()")
        for key in ("ArrowDown", "ArrowDown", "ArrowDown", "ArrowRight"):
            self.browser.press(key)
        self.assertEqual(self.browser.run("document.activeElement.closest('tr').dataset.name"), "libccd+aabb")
        self.assertIn("60 × missed contact", self.browser.run("document.querySelector('#tip:not([hidden])').textContent"))
        self.assertEqual(self.browser.run("document.activeElement.getAttribute('aria-describedby')"), "tip")
        self.browser.press("Escape")
        self.assertTrue(self.browser.run("document.querySelector('#tip').hidden"))
        x, y, width, height = self.browser.box("table.ratios tbody tr:nth-child(4) td.errs")
        self.browser.mouse("mouseMoved", x + width / 2, y + height / 2)
        self.assertIn("slide: 60 × missed contact", self.browser.until("document.querySelector('#tip:not([hidden])')?.textContent"))

    def test_scrubbing_moves_the_step(self):
        self.browser.run("(() => { const one = document.querySelector('.scrub'); one.value = 1234; one.dispatchEvent(new Event('input')); })()")
        self.assertEqual(self.step(), 1234)

    def test_a_step_is_saved_with_mesh_probe_and_command(self):
        self.browser.run("URL.createObjectURL = (blob) => { window.saved = blob.text(); return 'blob:none'; }; HTMLAnchorElement.prototype.click = () => {};")
        self.browser.run("document.querySelector('.lists details[open] button.step').click()")
        self.browser.run("document.querySelector('button.save').click()")
        text = self.browser.run("window.saved")
        self.assertIn("v 0.9 0 0\n", text)
        self.assertIn("# triangle 0\nf 1 2 3\n", text)
        self.assertIn("--radius 0.05 --reach 0.05 --step 0 | judged", text)
        self.assertEqual(subprocess.run(["sh", "-n"], input=text, text=True, check=False).returncode, 0)

    def test_nothing_runs_over_the_edge_at_any_width_or_text_size(self):
        for width in (360, 600, 1000, 1300, 2560):
            for size in ("100%", "200%"):
                self.browser.resize(width, 900)
                self.browser.run(f"document.documentElement.style.fontSize = '{size}'")
                over = self.browser.run("document.documentElement.scrollWidth - document.documentElement.clientWidth")
                self.assertLessEqual(over, 0, f"{width} px, text at {size}: {self.widest()}")

    def widest(self):
        return self.browser.run("[...document.querySelectorAll('main *')].filter((one) => one.getBoundingClientRect().right > innerWidth + 1 && !one.closest('.scroll'))"
                                ".map((one) => one.tagName + '.' + one.className).slice(0, 5).join(' ')")

    def test_paper_is_light_whatever_the_system_prefers(self):
        self.browser.prefer(prefers_color_scheme="dark")
        self.browser.run("window.dispatchEvent(new Event('beforeprint'))")
        self.assertEqual(self.browser.run("getComputedStyle(document.body).backgroundColor"), "rgb(255, 255, 255)")
        self.assertEqual(self.browser.run(CONTRAST), [])
        self.browser.run("window.dispatchEvent(new Event('afterprint'))")
        self.assertEqual(self.browser.run("getComputedStyle(document.body).backgroundColor"), "rgb(20, 23, 26)")
        self.browser.prefer()

    def test_every_control_has_a_name_and_a_place_in_the_order_of_tabs(self):
        nameless = self.browser.run("""[...document.querySelectorAll('button, input, select, [role=region], [role=application], [role=img]')]
            .filter((one) => one.getClientRects().length && !(one.ariaLabel || one.textContent.trim() || one.labels?.length || one.title)).map((one) => one.outerHTML.slice(0, 80))""")
        self.assertEqual(nameless, [])
        self.assertEqual(self.browser.run("[...document.querySelectorAll('button, input, select')].filter((one) => one.tabIndex < 0).length"), 0)

    def test_text_has_contrast_in_light_and_dark(self):
        for scheme in ("light", "dark"):
            self.browser.prefer(prefers_color_scheme=scheme)
            worst = self.browser.run(CONTRAST)
            self.assertEqual(worst, [], scheme)
        self.browser.prefer()


class OldBrowser(unittest.TestCase):
    def test_a_browser_that_cannot_unpack_the_page_says_so_and_has_the_tables(self):
        with tempfile.TemporaryDirectory() as folder:
            made_up_steps.write(folder, [Contestant("grid-group", 100, 300, 1)], 300)
            subprocess.run([ROOT / "scripts" / "report", folder], check=True, stdout=subprocess.DEVNULL)
            browser = Browser()
            self.addCleanup(browser.close)
            browser.send("Page.addScriptToEvaluateOnNewDocument", source="delete window.DecompressionStream")
            browser.send("Page.navigate", url=(pathlib.Path(folder) / "report.html").as_uri())
            self.assertIn("this browser is too old", browser.until("document.querySelector('header .notice[role=alert]')?.textContent"))
            self.assertIn("grid-group", browser.run("document.querySelector('table.ratios').textContent"))
            self.assertEqual(browser.errors, [])


class OddNames(unittest.TestCase):
    """Names from files are text, whatever is in them."""

    NAMES = ["<img src=x onerror=window.hacked=1>", "</script><script>window.hacked=1</script>", "naïve-検出器:größe=½", "a\"b'c\\d`e$(exit 3)", "two\nlines&amp;"]

    def test_neither_page_nor_saved_test_takes_them_for_anything_else(self):
        with tempfile.TemporaryDirectory() as temporary:
            folder = pathlib.Path(temporary) / "<b>run & co"
            folder.mkdir()
            contestants = [Contestant(name, 100 * 2 ** k, 300, k, range(20, 25) if k == 1 else ()) for k, name in enumerate(self.NAMES)]
            made_up_steps.write(folder, contestants, 300, trajectory="<i>slide</i>", mesh="<u>ball</u>\nrm -r /")
            (folder / "stress.csv").write_text("detector,options,family,probes,missed\n<b>x</b>,,<script>window.hacked=1</script>,1,0\n", encoding="utf-8")
            subprocess.run([ROOT / "scripts" / "report", folder], check=True, stdout=subprocess.DEVNULL)
            browser = Browser()
            self.addCleanup(browser.close)
            browser.open(folder / "report.html")
            browser.run("URL.createObjectURL = (blob) => { window.saved = blob.text(); return 'blob:none'; }; HTMLAnchorElement.prototype.click = () => {};")
            for place in range(len(self.NAMES)):
                browser.run(f"document.querySelectorAll('table.ratios button.pick')[{place}].click()")
                browser.run("document.querySelector('#details').close()")
                browser.run(f"document.querySelectorAll('.lists details')[{place}].querySelector('button.step').click()")
                browser.run("document.querySelector('button.save').click()")
                script = browser.run("window.saved")
                self.assertEqual(subprocess.run(["sh", "-n"], input=script, text=True, check=False).returncode, 0, script[:500])
                self.assertRegex(script.splitlines()[1], r"\A# Step \d+ of <i>slide</i> on <u>ball</u> rm -r /, cut")
                asked = subprocess.run(["sh", "-c", script], env={**os.environ, "TOUCHMARK": "/bin/echo"}, capture_output=True, text=True, check=False)
                self.assertEqual(asked.stderr, "")
            self.assertEqual(browser.run("[window.hacked, document.querySelectorAll('img, main b > *, i, u').length, document.querySelectorAll('script').length]"), [None, 0, 5])
            self.assertEqual(sorted(browser.run("[...document.querySelectorAll('.swatches input')].map((one) => one.value)")), sorted(self.NAMES))
            self.assertEqual(browser.errors, [])


class SavedTest(unittest.TestCase):
    """A real run, whose steps are saved and asked again, as a user would."""

    @classmethod
    def setUpClass(cls):
        found = [path for build in ("release", "dev") if (path := ROOT / "build" / build / "bin" / "touchmark").is_file()]
        if not found:
            raise RuntimeError("touchmark is not built: scripts/build-program")
        cls.program = found[0]
        cls.temporary = tempfile.TemporaryDirectory()
        cls.folder = pathlib.Path(cls.temporary.name)
        subprocess.run([cls.program, "bench", "--quick", "--no-cold", "--mesh", "icosphere:3", "--trajectory", "slide", "--steps", "400",
                        "--detector", "grid-group", "--detector", "libccd+aabb", "--benchmark_min_time=0.001",
                        "--out", cls.folder], check=True, capture_output=True)
        subprocess.run([ROOT / "scripts" / "report", cls.folder], check=True, stdout=subprocess.DEVNULL)
        cls.browser = Browser()
        cls.browser.open(cls.folder / "report.html")
        cls.browser.run("URL.createObjectURL = (blob) => { window.saved = blob.text(); return 'blob:none'; }; HTMLAnchorElement.prototype.click = () => {};")

    @classmethod
    def tearDownClass(cls):
        cls.browser.close()
        cls.temporary.cleanup()

    def saved(self, name, kind):
        """The first step of a list, saved: the script, and the page's cells about the contestant there."""
        self.browser.run(f"document.querySelector('.swatches input[value=\"{name}\"]').checked || document.querySelector('.swatches input[value=\"{name}\"]').click()")
        self.browser.run(f"document.querySelector('.lists {kind} button.step[data-name=\"{name}\"]').click()")
        cells = self.browser.run("[...document.querySelectorAll('.about-step tr.current td')].map((cell) => cell.textContent)")
        self.browser.run("document.querySelector('button.save').click()")
        return self.browser.run("window.saved"), cells

    def ask(self, script):
        return subprocess.run(["sh", "-c", script], env={**os.environ, "TOUCHMARK": str(self.program)}, capture_output=True, text=True, check=False)

    def test_the_slowest_step_gives_the_numbers_of_the_page_again(self):
        script, cells = self.saved("grid-group", "ol")
        done = self.ask(script)
        self.assertEqual((done.returncode, done.stderr), (0, ""), done.stdout)
        fields = done.stdout.split(",")
        self.assertEqual(fields[0], "right: 0")
        self.assertEqual(cells[4], "right")
        self.assertEqual(fields[3] or "–", cells[3])  # the distance, to the last digit

    def test_a_wrong_step_is_wrong_again_with_the_same_answer(self):
        script, cells = self.saved("libccd+aabb", "ul")
        done = self.ask(script)
        self.assertEqual((done.returncode, done.stderr), (1, ""), done.stdout)
        fields = done.stdout.splitlines()[-1].split(",")
        self.assertRegex(fields[0], r"\Awrong: \d+\Z")
        self.assertNotEqual(cells[4], "right")
        self.assertEqual((fields[1], fields[3] or "–"), ("1" if cells[2] == "yes" else "0", cells[3]))

    def test_a_contestant_that_does_not_answer_is_neither_right_nor_wrong(self):
        script, _ = self.saved("grid-group", "ol")
        done = subprocess.run(["sh", "-c", script], env={**os.environ, "TOUCHMARK": "false"}, capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout), (2, ""))

    def test_what_a_slow_step_looked_at_is_told(self):
        self.saved("grid-group", "ol")
        self.assertRegex(self.browser.run("document.querySelector('.visited').textContent"), r"\Agrid-group: Looked at ")
        self.assertEqual(self.browser.errors, [])


# Every text against the ground behind it: 4.5 to 1, as WCAG's AA demands.
CONTRAST = """(() => {
  const parsed = (text) => { const found = text.match(/[\\d.]+/g).map(Number); return found.length < 4 ? [...found, 1] : found; };
  const light = (color) => { const [r, g, b] = color.slice(0, 3).map((one) => { one /= 255; return one <= 0.03928 ? one / 12.92 : ((one + 0.055) / 1.055) ** 2.4; }); return 0.2126 * r + 0.7152 * g + 0.0722 * b; };
  const ground = (one) => { for (; one; one = one.parentElement) { const color = parsed(getComputedStyle(one).backgroundColor); if (color[3] === 1) return color; } return matchMedia('(prefers-color-scheme: dark)').matches ? [20, 23, 26, 1] : [255, 255, 255, 1]; };
  const bad = new Set();
  for (const one of document.querySelectorAll('header *, main *')) {
    if (![...one.childNodes].some((node) => node.nodeType === 3 && node.textContent.trim())) continue;
    if (one.tagName === 'OPTION' || !one.getClientRects().length) continue;
    const [a, b] = [light(parsed(getComputedStyle(one).color)), light(ground(one))].sort((x, y) => y - x);
    const ratio = (a + 0.05) / (b + 0.05);
    if (ratio < 4.5) bad.add(`${one.tagName}.${one.className} ${ratio.toFixed(2)}`);
  }
  return [...bad];
})()"""


if __name__ == "__main__":
    unittest.main()
