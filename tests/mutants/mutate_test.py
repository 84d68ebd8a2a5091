#!/usr/bin/python3
"""What mutate.py refuses, and that a mutant asleep leaves the text's meaning alone."""
import pathlib
import tempfile
import unittest

import mutate

SOURCE = "int least(int a, int b) {\n  if (b < a) a = b;\n  return a;\n}\n"
ENTRY = """
[[mutant]]
name = "{name}"
bug = "b"
seen = "s"
[[mutant.edits]]
file = "core/least.cpp"
kind = "{kind}"
old = "{old}"
new = "{new}"
"""


class Mutate(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.root = pathlib.Path(self.folder.name)
        (self.root / "core").mkdir()
        (self.root / "core/least.cpp").write_text(SOURCE, encoding="utf-8")

    def tearDown(self):
        self.folder.cleanup()

    def generate(self, *entries):
        listing = self.root / "mutants.toml"
        listing.write_text("".join(ENTRY.format(**entry) for entry in entries), encoding="utf-8")
        mutate.generate(self.root, listing, self.root / "copy")
        return (self.root / "copy/core/least.cpp").read_text(encoding="utf-8")

    def refusal(self, *entries):
        with self.assertRaises(mutate.BadList) as caught:
            self.generate(*entries)
        return str(caught.exception)

    def entry(self, name="m", kind="expression", old="b < a", new="b > a"):
        return {"name": name, "kind": kind, "old": old, "new": new}

    def test_an_expression_is_switched_where_it_stands(self):
        text = self.generate(self.entry())
        self.assertIn("if ((::touchmark::mutants::m ? (b > a) : (b < a))) a = b;", text)
        self.assertEqual(text.count("\n"), SOURCE.count("\n") + 2, "only a declaration and #line are added")

    def test_a_text_that_is_gone_or_not_alone_is_refused(self):
        self.assertIn("core/least.cpp holds 'b <= a' 0 times, not once", self.refusal(self.entry(old="b <= a")))
        self.assertIn("holds 'int' 3 times, not once", self.refusal(self.entry(old="int")))

    def test_two_mutants_of_one_text_are_refused(self):
        fault = self.refusal(self.entry(), self.entry(name="n", kind="statement", old="if (b < a) a = b;", new="a = b;"))
        self.assertIn("mutants n and m change the same text", fault)

    def test_names_kinds_and_files_are_checked(self):
        self.assertIn("two mutants are called m", self.refusal(self.entry(), self.entry()))
        self.assertIn("unknown kind guess", self.refusal(self.entry(kind="guess")))
        (self.root / "core/least.cpp").unlink()
        self.assertIn("core/least.cpp is not there", self.refusal(self.entry()))

    def test_what_has_not_changed_is_not_written_again(self):
        self.generate(self.entry())
        path = self.root / "copy/core/least.cpp"
        before = path.stat().st_mtime_ns
        self.generate(self.entry())
        self.assertEqual(path.stat().st_mtime_ns, before)


if __name__ == "__main__":
    unittest.main()
