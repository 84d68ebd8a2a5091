#!/usr/bin/python3
"""Makes the Debian packages of a build, and looks at them without installing any: what they hold and need, and whether
programs are built and run from what they unpack to. scripts/packaging/debian tries them on an empty Debian.

usage: packages_test.py BUILD_DIRECTORY
"""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import unittest

HERE = pathlib.Path(__file__).resolve().parent
ROOT = HERE.parents[1]
BUILD = pathlib.Path(sys.argv.pop(1)).resolve()
TOOLS = [tool for tool in ("dpkg-deb", "dpkg-shlibdeps") if not shutil.which(tool)]


def run(*command, **options):
    done = subprocess.run(command, capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command}\n{done.stdout}{done.stderr}")
    return done.stdout


def files_under(folder):
    return {path.relative_to(folder).as_posix() for path in folder.rglob("*") if not path.is_dir()}


def needed_libraries(program):
    return set(re.findall(r"NEEDED +(\S+)", run("objdump", "-p", program)))


@unittest.skipIf(TOOLS, f"missing: {', '.join(TOOLS)}")
class Packages(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.temporary = tempfile.TemporaryDirectory()
        cls.addClassCleanup(cls.temporary.cleanup)
        cls.folder = pathlib.Path(cls.temporary.name)
        run("cpack", "--config", BUILD / "CPackConfig.cmake", "-B", cls.folder, "-D", "CPACK_DEBIAN_COMPRESSION_TYPE=none")
        cls.files = {path.name.split("_")[0]: path for path in cls.folder.glob("*.deb")}
        cls.root = cls.folder / "unpacked"
        for path in cls.files.values():
            run("dpkg-deb", "-x", path, cls.root)
        cls.usr = cls.root / "usr"
        cls.version = re.search(r"project\(touchmark VERSION (\S+)", (ROOT / "CMakeLists.txt").read_text())[1]
        cls.minor = cls.version.rpartition(".")[0]
        cls.c_package = f"libtouchmark-c{cls.minor}"

    def field(self, package, name):
        return run("dpkg-deb", "-f", self.files[package], name).strip()

    def needs(self, package):
        return [entry.split(" ")[0] for entry in self.field(package, "Depends").split(", ")]

    def programs(self):
        return sorted(path for path in self.usr.rglob("touchmark*") if path.parent.name == "touchmark"
                      and path.suffix == "" and path.is_file() and "lib" in path.parts)

    def test_there_are_five(self):
        self.assertEqual(sorted(self.files), [self.c_package, "libtouchmark-dev", "python3-touchmark", "touchmark",
                                              "touchmark-plots"])

    def test_each_says_what_it_is_and_has_its_licence(self):
        for package in self.files:
            with self.subTest(package):
                self.assertEqual(self.field(package, "Version"), f"{self.version}-1")
                self.assertEqual(self.field(package, "Architecture") == "all", package == "touchmark-plots")
                summary, *lines = self.field(package, "Description").splitlines()
                self.assertLess(len(summary), 80)
                self.assertGreater(len(lines), 0)
                documents = self.usr / "share" / "doc" / package
                self.assertEqual((documents / "copyright").read_bytes(), (ROOT / "LICENSE").read_bytes())
                changes = run("gzip", "-dc", documents / "changelog.gz")
                self.assertEqual(changes, (ROOT / "CHANGELOG.md").read_text(encoding="utf-8"))
                self.assertIn(f"({self.version}-1)", run("gzip", "-dc", documents / "changelog.Debian.gz"))

    def test_what_is_installed_is_in_exactly_one_package(self):
        prefix = self.folder / "prefix"
        run("cmake", "--install", BUILD, "--prefix", prefix)
        self.assertFalse((prefix / "lib" / "python3").exists())  # pip installs the module
        run("cmake", "--install", BUILD, "--prefix", prefix, "--component", "python")
        unpacked = []
        for package, path in self.files.items():
            run("dpkg-deb", "-x", path, self.folder / package)
            unpacked += sorted(files_under(self.folder / package / "usr"))
        self.assertEqual(len(unpacked), len(set(unpacked)))
        self.assertEqual(set(unpacked), files_under(prefix))

    def test_the_program_needs_the_packages_of_its_libraries(self):
        programs = self.programs()
        self.assertIn("touchmark-worker-bullet-float", [path.name for path in programs])
        libraries = set().union(*(needed_libraries(path) for path in programs))
        self.assertGreater(len(libraries), 10)
        for line in run("ldd", *programs).splitlines():
            match = re.match(r"\s*(\S+) => (/\S+)", line)
            if match and match[1] in libraries:
                # By its name alone: dpkg may know it in /lib, and the loader in /usr/lib.
                owners = {entry.split(":")[0] for entry in run("dpkg", "-S", f"*/{match[1]}").splitlines()}
                self.assertTrue(owners & set(self.needs("touchmark")), f"{match[1]}: {owners}")

    def test_what_is_built_with_needs_what_its_headers_include(self):
        needs = self.field("libtouchmark-dev", "Depends")
        self.assertIn("libeigen3-dev", needs)
        self.assertIn("libassimp-dev", needs)
        self.assertIn("libdraco-dev", needs)
        self.assertIn("libpugixml-dev", needs)
        self.assertIn(f"{self.c_package} (= {self.version}-1)", needs)

    def test_the_shared_library_is_found_once_it_is_installed(self):
        control = self.folder / "control"
        run("dpkg-deb", "-e", self.files[self.c_package], control)
        self.assertEqual((control / "triggers").read_text(encoding="utf-8"), "activate-noawait ldconfig\n")
        self.assertEqual((control / "shlibs").read_text(encoding="utf-8").strip(),
                         f"libtouchmark_c {self.minor} {self.c_package} (>= {self.version}-1)")

    def test_the_program_finds_its_workers_by_the_link_in_bin(self):
        out = self.folder / "out"
        run(self.usr / "bin" / "touchmark", "bench", "--quick", "--no-cold", "--mesh", "icosphere:1", "--trajectory", "slide",
            "--steps", "50", "--detector", "grid-group", "--detector", "bullet", "--out", out)
        run(self.usr / "bin" / "touchmark-plot", out, "--only", "errors")
        run(self.usr / "bin" / "touchmark-report", "--help")
        self.assertTrue((out / "plots" / "errors.png").exists())

    def test_the_module_for_python_is_for_the_python_it_was_built_with_and_answers(self):
        minor = sys.version_info.minor
        self.assertEqual(self.field("python3-touchmark", "Depends").split(", ")[:2],
                         [f"python3 (>= 3.{minor})", f"python3 (<< 3.{minor + 1})"])
        code = "import doctest, touchmark; assert doctest.testmod(touchmark).attempted > 3; print(touchmark.__version__)"
        packages = self.usr / "lib" / "python3" / "dist-packages"
        self.assertEqual(run(sys.executable, "-B", "-c", code, env={**os.environ, "PYTHONPATH": str(packages)}).strip(), self.version)

    def test_find_package_finds_what_was_unpacked(self):
        source = self.folder / "consumer"
        source.mkdir()
        shutil.copy(HERE / "CMakeLists.txt", source)
        code = re.search(r"```cpp\n(.*?)```", (ROOT / "README.md").read_text(encoding="utf-8"), re.S)[1]
        (source / "example.cpp").write_text(code, encoding="utf-8")
        run("cmake", "-S", source, "-B", source / "build", f"-DCMAKE_PREFIX_PATH={self.usr}", f"-DVERSION={self.version}")
        run("cmake", "--build", source / "build")
        run(source / "build" / "example")
        self.assertIn(str(self.usr), (source / "build" / "CMakeCache.txt").read_text(encoding="utf-8"))


if __name__ == "__main__":
    unittest.main(verbosity=2)
