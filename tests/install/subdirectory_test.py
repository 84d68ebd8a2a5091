#!/usr/bin/python3
"""Builds the project as a subdirectory of another one, with shared libraries, and installs both.

usage: subdirectory_test.py SOURCE_DIRECTORY
"""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = pathlib.Path(sys.argv.pop(1)).resolve()


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(f"{command}\n{done.stdout}{done.stderr}")
    return done.stdout


class Subdirectory(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        directory = pathlib.Path(cls.temporary.name)
        shutil.copy(HERE / "CMakeLists.txt", directory)
        shutil.copy(HERE / "answers.cpp", directory / "example.cpp")
        cls.build = directory / "build"
        cls.prefix = directory / "prefix"
        run("cmake", "-S", directory, "-B", cls.build, "-G", "Ninja", f"-DSOURCE={SOURCE}", "-DBUILD_SHARED_LIBS=ON",
            "-DTOUCHMARK_BUILD_MESH_IO=OFF", "-DTOUCHMARK_CCACHE=ON", "-DCMAKE_CXX_FLAGS=-O1")
        run("cmake", "--build", cls.build)
        run("cmake", "--install", cls.build, "--prefix", cls.prefix)
        cls.library = next(cls.prefix.rglob("libtouchmark_core.so"))

    def test_the_program_finds_the_headers_as_if_they_were_installed(self):
        self.assertIn("grid group", run(self.build / "example"))

    def test_an_error_thrown_by_the_library_is_caught_as_what_it_is(self):
        self.assertIn("triangle", run(self.build / "example").splitlines()[-1])

    def test_the_library_carries_the_version_of_its_interface(self):
        version = re.search(r"project\(touchmark VERSION (\d+)\.(\d+)\.(\d+)",
                            (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8"))
        major, minor, patch = version.groups()
        self.assertIn(f"libtouchmark_core.so.{major}.{minor}]", run("readelf", "-d", self.library))
        self.assertEqual(self.library.resolve().name, f"libtouchmark_core.so.{major}.{minor}.{patch}")

    def test_the_library_exports_no_inline_function_of_its_own(self):
        symbols = run("nm", "-DC", "--defined-only", self.library)
        self.assertIn(" T touchmark::GridGroup::build(", symbols)
        # A weak function is an inline one, or made from a template.
        self.assertEqual(re.findall(r" W (touchmark::[\w:~]+\(.*)", symbols), [])

    def test_the_library_calls_its_own_functions_whatever_a_program_defines(self):
        calls = [line for line in run("objdump", "-RC", self.library).splitlines() if "JUMP_SLOT" in line]
        self.assertTrue(calls)
        self.assertEqual([line for line in calls if "touchmark::" in line or "Eigen::" in line], [])


if __name__ == "__main__":
    unittest.main()
