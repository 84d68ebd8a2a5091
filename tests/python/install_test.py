#!/usr/bin/python3
"""Installs the Python module with pip from an export of the sources, without a network, and looks at what came of it.

usage: install_test.py SOURCE_DIRECTORY
"""
import importlib.metadata
import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv.pop(1)).resolve()
TOP = ("CMakeLists.txt", "LICENSE", "pyproject.toml")
FOLDERS = ("core", "docs", "python")


def export(to):
    """What git archive would give of these, with what is not committed yet; without .git."""
    for name in TOP:
        shutil.copy(SOURCE / name, to / name)
    for name in FOLDERS:
        shutil.copytree(SOURCE / name, to / name, ignore=shutil.ignore_patterns("__pycache__"))


class Installed(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        exported = pathlib.Path(cls.temporary.name) / "exported"
        exported.mkdir()
        export(exported)
        before = {path.name for path in exported.iterdir()}
        cls.target = pathlib.Path(cls.temporary.name) / "target"
        done = subprocess.run(
            [sys.executable, "-m", "pip", "install", "--no-build-isolation", "--no-deps", "--no-index", "--target", cls.target,
             "."], cwd=exported, capture_output=True, text=True, check=False,
            env={**os.environ, "PIP_DISABLE_PIP_VERSION_CHECK": "1", "PIP_ROOT_USER_ACTION": "ignore"})
        if done.returncode != 0:
            raise AssertionError(done.stdout + done.stderr)
        cls.left_behind = {path.name for path in exported.iterdir()} - before

    def run_installed(self, code):
        done = subprocess.run([sys.executable, "-c", code], capture_output=True, text=True, check=False,
                              env={**os.environ, "PYTHONPATH": str(self.target)})
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.strip()

    def version(self):
        text = (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8")
        return re.search(r"project\(touchmark VERSION (\S+)", text)[1]

    def test_the_metadata_are_those_of_the_project(self):
        found, = importlib.metadata.distributions(path=[str(self.target)])
        self.assertEqual(found.metadata["Name"], "touchmark")
        self.assertEqual(found.version, self.version())
        self.assertEqual(found.metadata["License"], "MIT")
        self.assertEqual([re.sub("[ ()]", "", needed) for needed in found.requires], ["numpy>=1.20"])
        names = {file.name for file in found.files}
        self.assertLessEqual({"__init__.py", "_native.pyi", "py.typed", "LICENSE"}, names)

    def test_what_is_installed_answers(self):
        self.assertEqual(self.run_installed("import touchmark; print(touchmark.__version__)"), self.version())
        self.assertEqual(self.run_installed(
            "import doctest, touchmark; print(doctest.testmod(touchmark))"), "TestResults(failed=0, attempted=4)")

    def test_the_wheel_is_for_this_platform_and_the_sources_stay_as_they_were(self):
        wheel = next(self.target.glob("*.dist-info/WHEEL")).read_text(encoding="utf-8")
        self.assertIn("Root-Is-Purelib: false", wheel)
        self.assertRegex(wheel, r"Tag: cp\d+-cp\d+-" + (r"manylinux_2_\d+_x86_64" if platform.machine() == "x86_64" else "linux_"))
        self.assertLessEqual(self.left_behind, {"build"})

    def test_the_platform_has_all_that_is_needed(self):
        sys.path.insert(0, str(SOURCE / "python"))
        from build_backend import platform_of
        headers = "  NEEDED               libc.so.6\n  required from libc.so.6:\n    0x09691a75 0x00 02 GLIBC_2.2.5\n"
        for name, found in (("GLIBCXX_3.4.30", "manylinux_2_36"), ("GLIBCXX_3.4.31", "manylinux_2_40"), ("GLIBC_2.99", None), ("ZLIB_1.2", None)):
            self.assertEqual(platform_of(f"{headers}    0x09691a75 0x00 03 {name}\n"), found)
        self.assertIsNone(platform_of(headers + "  NEEDED               libgmp.so.10\n"))

    def test_the_native_part_shows_nothing_but_its_entry(self):
        native = next(self.target.glob("touchmark/_native*.so"))
        symbols = subprocess.run(["nm", "-D", "--defined-only", native], capture_output=True, text=True, check=True).stdout
        self.assertIn("PyInit__native", symbols)
        self.assertNotIn("touchmark", symbols)


if __name__ == "__main__":
    unittest.main()
