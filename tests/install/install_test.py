#!/usr/bin/python3
"""Installs the library into a temporary prefix, and builds README's example against it in both ways.

usage: install_test.py BUILD_DIRECTORY
"""
import ctypes
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
BUILD = pathlib.Path(sys.argv.pop(1)).resolve()

# A plug-in with the installed library inside.
PLUGIN = """#include <exception>

#include <core/brute_force/brute_force.h>
#include <core/grid_group/grid_group.h>
#include <core/mesh_io/mesh_io.h>
#include <core/sphere_cluster/sphere_cluster.h>

namespace {

template <class D>
double distance_by(const touchmark::TriangleMesh& mesh, const touchmark::Vec3& center, double reach) {
  const D detector = D::build(mesh);
  typename D::Session session;
  const auto contact = detector.nearest({center, 0}, reach, session);
  return contact ? contact->distance : -1;
}

}  // namespace

/// The distance of a point from the mesh in a file, -1 beyond the reach; -2 where detectors differ, -3 where
/// the file cannot be read.
extern "C" double distance_from(const char* file, double x, double y, double z, double reach) {
  try {
    const touchmark::TriangleMesh mesh = touchmark::load_mesh(file);
    const touchmark::Vec3 center(x, y, z);
    const double distance = distance_by<touchmark::BruteForce>(mesh, center, reach);
    const bool same = distance_by<touchmark::GridGroup>(mesh, center, reach) == distance &&
                      distance_by<touchmark::SphereCluster>(mesh, center, reach) == distance;
    return same ? distance : -2;
  } catch (const std::exception&) {
    return -3;
  }
}
"""


def run(*command, **options):
    done = subprocess.run(command, capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command}\n{done.stdout}{done.stderr}")
    return done.stdout


def readme_example():
    """The C++ of README.md and the output that it promises."""
    text = (HERE.parents[1] / "README.md").read_text(encoding="utf-8")
    return re.search(r"```cpp\n(.*?)```", text, re.S)[1], re.search(r"```cpp.*?prints `(.*?)`", text, re.S)[1]


class Install(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        directory = pathlib.Path(cls.temporary.name)
        first = directory / "first"
        run("cmake", "--install", BUILD, "--prefix", first)
        cls.prefix = directory / "moved"  # a package may be unpacked anywhere
        first.rename(cls.prefix)
        cls.source = directory / "consumer"
        cls.source.mkdir()
        shutil.copy(HERE / "CMakeLists.txt", cls.source)
        code, cls.promised = readme_example()
        (cls.source / "example.cpp").write_text(code, encoding="utf-8")

    def find(self, pattern):
        return next(self.prefix.rglob(pattern))

    def test_the_readme_example_builds_with_find_package(self):
        build = self.source / "build"
        run("cmake", "-S", self.source, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}")
        run("cmake", "--build", build)
        self.assertEqual(run(build / "example").rstrip("\n"), self.promised)

    def test_the_readme_example_builds_with_pkg_config(self):
        environment = {**os.environ, "PKG_CONFIG_PATH": str(self.find("touchmark.pc").parent)}
        flags = run("pkg-config", "--cflags", "--libs", "touchmark", env=environment).split()
        program = self.source / "with_pkg_config"
        run("g++", "-std=c++20", self.source / "example.cpp", *flags, "-o", program)
        self.assertEqual(run(program).rstrip("\n"), self.promised)

    def test_the_examples_print_what_the_page_on_the_library_says(self):
        docs = HERE.parents[1] / "docs"
        page = (docs / "library.md").read_text(encoding="utf-8")
        promised = dict(re.findall(r"`(\w+)` prints:\n\n```text\n(.*?)```", page, re.S))
        self.assertEqual(sorted(promised), sorted(path.stem for path in (docs / "examples").glob("*.cpp")))
        build = self.source / "examples"
        run("cmake", "-S", docs / "examples", "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}")
        run("cmake", "--build", build)
        for name, output in promised.items():
            self.assertEqual(run(build / name), output, name)

    def test_a_program_that_reads_files_asks_for_mesh_io(self):
        source = self.source / "reader"
        source.mkdir()
        shutil.copy(HERE / "CMakeLists.txt", source)
        (source / "example.cpp").write_text(
            "#include <core/mesh_io/mesh_io.h>\n"
            "int main(int, char** a) { return touchmark::load_mesh(a[1]).size() == 1 ? 0 : 1; }\n", encoding="utf-8")
        (source / "one.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", encoding="utf-8")
        build = source / "build"
        run("cmake", "-S", source, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}", "-DLIBRARY=mesh_io")
        run("cmake", "--build", build)
        run(build / "example", source / "one.off")

    def test_a_plug_in_has_the_library_inside_and_can_be_loaded(self):
        source = self.source / "plugin"
        source.mkdir()
        shutil.copy(HERE / "CMakeLists.txt", source)
        (source / "plugin.cpp").write_text(PLUGIN, encoding="utf-8")
        (source / "one.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", encoding="utf-8")
        build = source / "build"
        run("cmake", "-S", source, "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}", "-DLIBRARY=mesh_io")
        run("cmake", "--build", build)
        distance_from = ctypes.CDLL(str(build / "plugin.so")).distance_from
        distance_from.restype = ctypes.c_double
        distance_from.argtypes = [ctypes.c_char_p] + 4 * [ctypes.c_double]
        mesh = os.fsencode(source / "one.off")
        self.assertEqual(distance_from(mesh, 0.25, 0.25, 2, 3), 2)
        self.assertEqual(distance_from(mesh, 0.25, 0.25, 2, 1), -1)
        self.assertEqual(distance_from(os.fsencode(source / "none.off"), 0, 0, 0, 1), -3)

    def test_no_installed_header_needs_one_that_is_not(self):
        include = self.prefix / "include" / "touchmark"
        headers = sorted(path.relative_to(include).as_posix() for path in include.rglob("*.h"))
        self.assertIn("core/probe.h", headers)
        run("g++", "-std=c++20", "-fsyntax-only", "-I", include, "-isystem", "/usr/include/eigen3", "-x", "c++", "-",
            input="".join(f"#include <{header}>\n" for header in headers))

    def test_nothing_of_the_program_or_the_rivals_is_installed(self):
        names = {path.name for path in self.prefix.rglob("*") if path.is_file()}
        self.assertFalse({name for name in names if "bench" in name or "fcl" in name or "bullet" in name})
        self.assertIn("libtouchmark_core.a", names)


if __name__ == "__main__":
    unittest.main()
