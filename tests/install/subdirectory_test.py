#!/usr/bin/python3
"""Builds a project that has this one inside, in several ways: as a subdirectory, fetched and installed, with settings and
targets of its own. The folder parent/ is that project.

usage: subdirectory_test.py SOURCE_DIRECTORY FOLDER   (for the builds, which are kept: the next run compiles what has changed)
"""
import json
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
SOURCE = pathlib.Path(sys.argv.pop(1)).resolve()
FOLDER = pathlib.Path(sys.argv.pop(1)).resolve()
WARNINGS = "-Wall -Wextra -Werror -Wconversion -Wsign-conversion"
WITHOUT_EIGEN = "-DCMAKE_DISABLE_FIND_PACKAGE_Eigen3=ON"
WITHOUT_ASSIMP = "-DCMAKE_DISABLE_FIND_PACKAGE_assimp=ON"
# As long as these are the same, what is compiled of Touchmark is, too: one build serves several parents.
STATIC = (f"-DCMAKE_CXX_COMPILER={shutil.which('clang++') or 'g++'}", f"-DCMAKE_CXX_FLAGS={WARNINGS}",
          WITHOUT_ASSIMP)
SHARED = ("-DCMAKE_CXX_COMPILER=g++", f"-DCMAKE_CXX_FLAGS=-O1 {WARNINGS}", "-DBUILD_SHARED_LIBS=ON", "-DCMAKE_CXX_STANDARD=23",
          "-DCMAKE_CXX_VISIBILITY_PRESET=hidden", "-DCMAKE_POSITION_INDEPENDENT_CODE=ON", "-DCMAKE_UNITY_BUILD=ON")
ANSWERS = "triangle 0 at 0.125\npushed up: yes\nbody 0 at 0.875\n"


def run(*command):
    done = subprocess.run(command, capture_output=True, text=True, check=False)
    if done.returncode != 0:
        raise AssertionError(f"{command}\n{done.stdout}{done.stderr}")
    return done.stdout


class Subdirectory(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.prefix = FOLDER / "prefix"
        shutil.rmtree(cls.prefix, ignore_errors=True)
        cls.configure("shared", *SHARED, "-DEIGEN=plain", WITHOUT_EIGEN, "-DTOUCHMARK_INSTALL=ON")
        run("cmake", "--build", FOLDER / "shared")
        run("cmake", "--install", FOLDER / "shared", "--prefix", cls.prefix)
        cls.libraries = {name: next(cls.prefix.rglob(f"libtouchmark_{name}.so")) for name in ("core", "mesh_io")}

    @classmethod
    def configure(cls, build, *options):
        (FOLDER / build / "CMakeCache.txt").unlink(missing_ok=True)  # another parent's options
        return run("cmake", "-S", HERE / "parent", "-B", FOLDER / build, "-G", "Ninja",
                   f"-DTOUCHMARK_SOURCE={SOURCE}", "-DTOUCHMARK_CCACHE=ON", "-DCMAKE_EXPORT_COMPILE_COMMANDS=ON", *options)

    def build_and_check(self, build, errors):
        """The program's answers, and one line for each library that throws."""
        run("cmake", "--build", FOLDER / build)
        out = run(FOLDER / build / "app")
        self.assertTrue(out.startswith(ANSWERS), out)
        self.assertEqual(re.findall("^MeshError: ", out, re.M), errors * ["MeshError: "], out)

    def test_a_parent_that_hides_its_names_catches_what_shared_libraries_throw(self):
        self.build_and_check("shared", errors=2)

    def test_a_parent_has_its_imported_eigen_and_installs_nothing_of_ours(self):
        self.configure("static", *STATIC, "-DEIGEN=imported", WITHOUT_EIGEN, "-DCMAKE_CXX_STANDARD=17", "-DBY=excluded")
        self.build_and_check("static", errors=2)
        self.configure("static", *STATIC, "-DEIGEN=imported")
        with tempfile.TemporaryDirectory() as prefix:
            run("cmake", "--install", FOLDER / "static", "--prefix", prefix)
            self.assertEqual([path.name for path in pathlib.Path(prefix).rglob("*")], ["bin", "app"])

    def test_a_parent_that_fetches_it_has_it_without_assimp(self):
        said = self.configure("static", *STATIC, "-DBY=fetched")
        self.assertRegex(said, "touchmark::mesh_io_assimp, .* is left out: .*libassimp-dev")
        self.build_and_check("static", errors=2)

    def test_a_parent_with_an_eigen_of_its_own_finds_the_installed_package(self):
        self.configure("installed", *SHARED, "-DEIGEN=plain", WITHOUT_EIGEN, "-DBY=installed",
                       f"-DCMAKE_PREFIX_PATH={self.prefix}")
        self.build_and_check("installed", errors=2)

    def test_sources_are_compiled_apart_whatever_the_parent_unites(self):
        self.configure("apart", *SHARED, "-DTOUCHMARK_BUILD_C=ON", "-DTOUCHMARK_UNITY=OFF", "-DCMAKE_DISABLE_PRECOMPILE_HEADERS=ON")
        commands = json.loads((FOLDER / "apart" / "compile_commands.json").read_text(encoding="utf-8"))
        ours = {pathlib.Path(entry["file"]) for entry in commands if "CMakeFiles/touchmark_" in entry["command"]}
        # Draco's reader has a stand-in, for where the library is missing.
        self.assertEqual(ours, {path for path in (SOURCE / "core").rglob("*.cpp") if path.name != "gltf_draco_missing.cpp"})
        run("ninja", "-C", FOLDER / "apart", *(
            f"touchmark/core/CMakeFiles/touchmark_core.dir/{name}.cpp.o" for name in ("scene/pose", "triangle_mesh")))

    def test_the_library_carries_the_version_of_its_interface(self):
        version = re.search(r"project\(touchmark VERSION (\d+)\.(\d+)\.(\d+)",
                            (SOURCE / "CMakeLists.txt").read_text(encoding="utf-8"))
        major, minor, patch = version.groups()
        library = self.libraries["core"]
        self.assertIn(f"libtouchmark_core.so.{major}.{minor}]", run("readelf", "-d", library))
        self.assertEqual(library.resolve().name, f"libtouchmark_core.so.{major}.{minor}.{patch}")

    def test_the_libraries_export_their_functions_and_no_inline_one(self):
        for name, function in (("core", "GridGroup::build"), ("mesh_io", "load_mesh")):
            symbols = run("nm", "-DC", "--defined-only", self.libraries[name])
            self.assertIn(f" T touchmark::{function}(", symbols)
            self.assertIn(" V typeinfo for touchmark::MeshError\n", symbols)
            # A weak function is an inline one, or made from a template.
            self.assertEqual(re.findall(r" W (touchmark::[\w:~]+\(.*)", symbols), [])

    def test_the_library_calls_its_own_functions_whatever_a_program_defines(self):
        calls = [line for line in run("objdump", "-RC", self.libraries["core"]).splitlines() if "JUMP_SLOT" in line]
        self.assertTrue(calls)
        self.assertEqual([line for line in calls if "touchmark::" in line or "Eigen::" in line], [])


class Alone(unittest.TestCase):
    def test_the_libraries_are_configured_without_assimp_and_the_program_says_that_it_needs_it(self):
        with tempfile.TemporaryDirectory() as build:
            options = ("cmake", "-S", SOURCE, "-B", build, "-G", "Ninja", WITHOUT_ASSIMP, "-DTOUCHMARK_BUILD_TESTS=OFF")
            done = subprocess.run(options, capture_output=True, text=True, check=False)
            self.assertEqual(done.returncode, 1)
            self.assertIn("The program touchmark needs the readers of mesh files: install libassimp-dev", done.stderr)
            said = run(*options, "-DTOUCHMARK_BUILD_BENCH=OFF", "-DCMAKE_DISABLE_FIND_PACKAGE_pugixml=ON")
            self.assertRegex(said, "touchmark::mesh_io, .* is left out: install libpugixml-dev")


if __name__ == "__main__":
    unittest.main()
