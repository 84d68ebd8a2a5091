#!/usr/bin/python3
"""Installs from a build folder in which not everything is built. An empty file stands for a library or a program that is.

usage: unbuilt_test.py SOURCE_DIRECTORY
"""
import os
import pathlib
import subprocess
import sys
import tempfile
import unittest

SOURCE = pathlib.Path(sys.argv.pop(1)).resolve()


def run(*command):
    return subprocess.run(command, capture_output=True, text=True, check=False)


class Unbuilt(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.directory = pathlib.Path(cls.temporary.name)
        cls.build = cls.directory / "build"
        cls.core = cls.build / "core" / "libtouchmark_core.a"
        done = run("cmake", "-S", SOURCE, "-B", cls.build, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                   "-DTOUCHMARK_BUILD_TESTS=OFF")
        if done.returncode != 0:
            raise AssertionError(done.stdout + done.stderr)

    def setUp(self):
        self.prefix = pathlib.Path(tempfile.mkdtemp(dir=self.directory))
        self.core.unlink(missing_ok=True)

    def install(self, *options):
        return run("cmake", "--install", self.build, "--prefix", self.prefix, *options)

    def command_for(self, target):
        return f"This builds it: cmake --build {self.build} --target {target}\n"

    def installed(self):
        return {path.name for path in self.prefix.rglob("*")}

    def test_nothing_is_installed_of_a_build_that_never_ran(self):
        done = self.install()
        self.assertEqual(done.returncode, 1)
        for target in ("touchmark_core", "touchmark_mesh_io", "touchmark_mesh_io_assimp", "touchmark_c", "touchmark"):
            self.assertIn(f"Not built, so not installed: {target} (", done.stderr)
            self.assertIn(self.command_for(target), done.stderr)
        self.assertEqual(self.installed(), set())

    def test_what_is_built_is_installed_and_the_rest_named_last(self):
        self.core.touch()
        (self.build / "bin").mkdir(exist_ok=True)
        (self.build / "bin" / "touchmark").touch()  # without the workers that it needs
        done = self.install()
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        for line, target in zip(done.stdout.splitlines()[-4:], ("touchmark_mesh_io", "touchmark_mesh_io_assimp", "touchmark_c", "touchmark")):
            self.assertIn(f"Not built, so not installed: {target} (", line)
            self.assertIn(self.command_for(target), line + "\n")
        names = self.installed()
        self.assertTrue({"libtouchmark_core.a", "touchmark-core.cmake", "touchmark.pc", "contestant.h",
                         "touchmark-plot"} <= names)
        self.assertEqual(names & {"touchmark-c.cmake", "touchmark-c.pc", "touchmark.h", "mesh_io.h", "mesh_io_assimp.h",
                                  "touchmark-mesh_io.cmake"}, set())
        self.assertFalse([name for name in names if name.startswith("libtouchmark-c")])
        self.assertFalse(os.path.lexists(self.prefix / "bin" / "touchmark"))

    def test_a_plug_in_builds_against_a_part(self):
        self.core.touch()
        self.install()
        build = self.directory / "plugin"
        done = run("cmake", "-S", SOURCE / "docs" / "examples" / "plugin", "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}")
        self.assertEqual(done.returncode, 0, done.stderr)
        done = run("cmake", "--build", build)
        self.assertEqual(done.returncode, 0, done.stderr)

    def test_a_component_that_is_not_built_is_an_error(self):
        self.core.touch()
        for component, target in (("c", "touchmark_c"), ("program", "touchmark")):
            done = self.install("--component", component)
            self.assertEqual(done.returncode, 1)
            self.assertIn(self.command_for(target), done.stderr)
        self.assertEqual(self.installed(), set())
        self.assertEqual(self.install("--component", "plots").returncode, 0)

    def test_packages_demand_all(self):
        self.core.touch()
        done = run("cpack", "--config", self.build / "CPackConfig.cmake", "-B", self.directory / "packages",
                   "-D", "CPACK_COMPONENTS_ALL=dev")
        self.assertNotEqual(done.returncode, 0)
        self.assertIn(self.command_for("touchmark_mesh_io"), done.stderr)
        self.assertEqual(list((self.directory / "packages").glob("*.deb")), [])


if __name__ == "__main__":
    unittest.main()
