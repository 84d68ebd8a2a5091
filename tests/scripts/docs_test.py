#!/usr/bin/python3
"""The documents: links lead somewhere, tables are what the sources say, and scripts/docs finds what differs."""
import os
import pathlib
import re
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
DOCS = ROOT / "scripts" / "docs"


def pages():
    return sorted([*ROOT.glob("*.md"), *(ROOT / "docs").rglob("*.md"), *(ROOT / "results").glob("*.md"),
                   *ROOT.glob("baselines/*.md"), *ROOT.glob("baselines/*/*.md")])


def prose(page):
    """Without blocks of code, whose brackets are no links."""
    return re.sub(r"^```.*?^```$", "", page.read_text(encoding="utf-8"), flags=re.M | re.S)


def anchors(page):
    """Of its headings, as GitHub makes them."""
    headings = re.findall(r"^#+ (.*)$", prose(page), re.M)
    return {re.sub(r"[^\w\- ]", "", heading.lower()).replace(" ", "-") for heading in headings}


class Documents(unittest.TestCase):
    def test_every_link_leads_somewhere(self):
        broken, found = [], 0
        for page in pages():
            text = prose(page)
            for link in re.findall(r"\]\(([^)\s]+)\)", text) + re.findall(r"^\[[^\]]+\]: (\S+)$", text, re.M):
                if re.match(r"\w+:", link):
                    continue
                found += 1
                path, _, anchor = link.partition("#")
                target = (page.parent / path) if path else page
                if not target.exists() or (anchor and anchor not in anchors(target)):
                    broken.append(f"{page.relative_to(ROOT)}: {link}")
        self.assertGreater(found, 30)
        self.assertEqual(broken, [])

    def test_every_path_that_is_named_exists(self):
        broken = []
        for page in [ROOT / "README.md", *(ROOT / "docs").rglob("*.md")]:
            for path in re.findall(r"`((?:core|baselines|bench|results|scripts|tests)/[\w./]*)`", prose(page)):
                if not (ROOT / path).exists():
                    broken.append(f"{page.relative_to(ROOT)}: {path}")
        self.assertEqual(broken, [])

    def test_tables_are_what_the_sources_say(self):
        done = subprocess.run([DOCS, "--check", "--tables", ROOT / "README.md", *(ROOT / "docs" / page for page in (
            "library.md", "reference/results-csv.md", "reference/run-json.md"))], capture_output=True, text=True, check=False)
        self.assertEqual((done.returncode, done.stdout, done.stderr), (0, "", ""))

    def test_every_public_header_is_described(self):
        cmake = (ROOT / "core" / "CMakeLists.txt").read_text(encoding="utf-8")
        listed = re.search(r"set\(touchmark_public_headers([^)]*)\)", cmake)[1].split() + ["mesh_io/mesh_io.h", "mesh_io_assimp/mesh_io_assimp.h"]
        doxyfile = (ROOT / "docs" / "Doxyfile").read_text(encoding="utf-8")
        self.assertEqual(sorted(re.findall(r"core/([\w/]+\.h)", doxyfile)), sorted(listed))
        described = re.findall(r"^\| `<touchmark/(\w+\.h)>`", (ROOT / "docs" / "library.md").read_text(encoding="utf-8"), re.M)
        self.assertEqual(sorted(described), sorted(pathlib.PurePath(header).name for header in listed))

    def test_every_block_of_commands_is_one_that_runs_or_says_why_not(self):
        command = re.compile(r"(?:\$ |sudo |[A-Z_]+=\S+ )*(?:scripts/|build/|(?:/usr/bin/)?(?:touchmark|cmake|ctest|g\+\+|cc|python3|pip|apt-get|git|"
                             r"snakemake|sbatch|vcpkg|rattler-build|export|cd) )")
        unmarked = []
        for page in pages():
            text = page.read_text(encoding="utf-8")
            others = re.sub(r"^```(?:console|sh)\n.*?^```$", "", text, flags=re.M | re.S)
            blocks = re.findall(r"^```text\n(.*?)^```$", others, re.M | re.S) + re.findall(r"(?:^    .*\n)+", prose(page), re.M)
            unmarked += [f"{page.relative_to(ROOT)}: {line.strip()}" for block in blocks for line in block.splitlines()
                         if command.match(line.strip())]
        self.assertEqual(unmarked, [])

    def test_the_first_pages_are_short(self):
        for page, lines in (("README.md", 80), ("CONTRIBUTING.md", 110)):
            self.assertLessEqual(len((ROOT / page).read_text(encoding="utf-8").splitlines()), lines, page)

    def test_results_hold_at_most_8_mb(self):
        listed = subprocess.run(["git", "ls-files", "-z", "results"], cwd=ROOT, capture_output=True, text=True, check=True).stdout
        self.assertLess(sum((ROOT / path).stat().st_size for path in listed.rstrip("\0").split("\0")), 8e6)


PAGE = """```console
$ touchmark twice a
$ touchmark twice b
```

```text
$ touchmark twice nothing
```

<!-- measured -->
```console
$ touchmark twice c
```
"""


class Docs(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.page = self.folder / "page.md"
        self.page.write_text(PAGE, encoding="utf-8")
        self.program("twice")

    def program(self, says, status=0):
        program = self.folder / "touchmark"
        program.write_text(f'#!/bin/sh\nshift\necho "{says} $1"\nexit {status}\n', encoding="utf-8")
        program.chmod(0o755)

    def docs(self, *words):
        return subprocess.run([DOCS, *words, self.page], capture_output=True, text=True, check=False,
                              env={**os.environ, "TOUCHMARK_PROGRAM": str(self.folder / "touchmark")})

    def test_writes_what_commands_print(self):
        self.assertEqual(self.docs().returncode, 0)
        text = self.page.read_text(encoding="utf-8")
        self.assertIn("$ touchmark twice a\ntwice a\n$ touchmark twice b\ntwice b\n```\n", text)
        self.assertIn("```text\n$ touchmark twice nothing\n```", text)
        self.assertIn("$ touchmark twice c\ntwice c\n```\n", text)
        self.assertEqual(self.docs("--check").returncode, 0)

    def test_finds_what_differs_and_changes_nothing(self):
        self.docs()
        before = self.page.read_text(encoding="utf-8")
        self.program("thrice")
        done = self.docs("--check")
        self.assertEqual(done.returncode, 1)
        self.assertIn("-twice b\n+thrice b\n", done.stdout)
        self.assertEqual(self.page.read_text(encoding="utf-8"), before)

    def test_keeps_what_was_measured_unless_it_is_asked_for(self):
        self.docs()
        self.program("thrice")
        self.docs()
        self.assertIn("thrice b\n```", self.page.read_text(encoding="utf-8"))
        self.assertIn("\ntwice c\n```", self.page.read_text(encoding="utf-8"))
        self.docs("--measured")
        self.assertIn("\nthrice c\n```", self.page.read_text(encoding="utf-8"))

    def test_names_shared_options_in_one_line_once_a_page_has_shown_them(self):
        self.page.write_text("<!-- shared -->\n```console\n$ touchmark help\n```\n\n```console\n$ touchmark help --more\n```\n", encoding="utf-8")
        program = self.folder / "touchmark"
        program.write_text("#!/bin/sh\nprintf 'Options:\\n  --mesh M   a mesh\\n  --rate HZ  a rate\\n'\n[ $# = 1 ] || echo '  --more     more'\n", encoding="utf-8")
        self.assertEqual(self.docs().returncode, 0)
        text = self.page.read_text(encoding="utf-8")
        self.assertIn("$ touchmark help\nOptions:\n  --mesh M   a mesh\n  --rate HZ  a rate\n```", text)
        self.assertIn("Options:\n  shared                      --mesh --rate\n  --more     more\n```", text)
        self.assertEqual(self.docs("--check").returncode, 0)

    def test_runs_blocks_of_a_shell_in_one_environment_and_leaves_nothing(self):
        self.page.write_text("""```sh
mkdir made && cd made
export SAID=so
```

```console
$ touchmark $SAID $(basename $PWD) > ~/kept && cat ~/kept
```
""", encoding="utf-8")
        self.program("$(pwd | sed 's,.*/,,')")
        self.assertEqual(self.docs().returncode, 0)
        self.assertIn("kept\nmade made\n```", self.page.read_text(encoding="utf-8"))
        self.assertFalse((ROOT / "made").exists())

    def test_finds_a_block_of_a_shell_that_fails_in_its_first_line(self):
        self.page.write_text("```sh\nfalse\ntrue\n```\n", encoding="utf-8")
        done = self.docs("--check")
        self.assertEqual(done.returncode, 1)
        self.assertIn("has exit status 1", done.stderr)

    def test_runs_with_other_words_where_the_page_says_so_and_not_where_it_says_why(self):
        self.page.write_text("""<!-- run with: --seconds 3600 => --seconds 1 -->
```console
$ touchmark twice --seconds 3600
```

<!-- not run: it would take a year -->
```console
$ no-such-command
```
""", encoding="utf-8")
        self.program("twice $*")
        self.assertEqual(self.docs().returncode, 0)
        text = self.page.read_text(encoding="utf-8")
        self.assertIn("$ touchmark twice --seconds 3600\ntwice --seconds 1 --seconds\n```", text)
        self.assertIn("$ no-such-command\n```", text)

    def test_refuses_other_words_for_what_the_block_does_not_hold(self):
        self.page.write_text("<!-- run with: a => b -->\n```sh\ntrue\n```\n", encoding="utf-8")
        self.assertIn("names 'a'", self.docs("--check").stderr)

    def test_finds_a_command_that_fails(self):
        self.docs()
        self.program("twice", status=2)
        done = self.docs("--check")
        self.assertEqual(done.returncode, 1)
        self.assertIn("'touchmark twice a' has exit status 2", done.stderr)

    def test_accepts_of_what_is_measured_that_the_machine_was_too_noisy(self):
        self.page.write_text(PAGE[PAGE.index("<!-- measured"):], encoding="utf-8")
        self.docs()
        self.program("twice", status=4)
        self.assertEqual(self.docs("--check").returncode, 0)
        self.program("twice", status=1)
        self.assertEqual(self.docs("--check").returncode, 1)


if __name__ == "__main__":
    unittest.main()
