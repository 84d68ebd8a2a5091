#!/usr/bin/python3
"""Installs the library into a temporary prefix, and builds against it what users would: README's example in both ways,
a plug-in, each header alone, and programs with flags that the library does not have.

usage: install_test.py BUILD_DIRECTORY
"""
import concurrent.futures
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

#include <touchmark/brute_force.h>
#include <touchmark/grid_group.h>
#include <touchmark/mesh_io.h>
#include <touchmark/sphere_cluster.h>

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

# A vector product of what a query answers, with no header but the detector's.
TORQUE = """#include <touchmark/aabb_tree.h>
touchmark::Vec3 torque(const touchmark::Contact& contact, const touchmark::Vec3& lever) {
  return lever.cross(contact.normal);
}
"""

INCLUDE = re.compile(r'^#include "(touchmark/[^"]+)"', re.M)
COMPILERS = [compiler for compiler in ("g++", "clang++") if shutil.which(compiler)]
C_COMPILERS = [compiler for compiler in ("gcc", "clang") if shutil.which(compiler)]
C99 = ["-std=c99", "-Wall", "-Wextra", "-Wpedantic", "-Wundef", "-Werror"]
IN_C = ["touchmark/contestant.h", "touchmark/touchmark.h"]
EIGEN = ["-isystem", "/usr/include/eigen3"]
FUSED = ["-mfma", "-ffp-contract=fast"]  # as GCC has it with -march=native on most processors

# Inline functions that a program compiles with its own flags and in which a product and a sum may be fused. Half of a
# number is exact. The queries only compare a displacement with what their detector knows to be free, or to be in contact,
# which leaves 2^-40 and more of it for rounding.
# Templates that only pass these queries on have the same comparisons in them.
FUSED_WITHOUT_HARM = re.compile(r"(auto |bool |void |std::optional<[\w:]+> )?"
                                r"touchmark::((Aabb::center|"
                                r"queries::is_(clear|clear_at_once|touching)|WideBvh::is_beyond_box|ManySessions<.*>::ask|"
                                r"(GridGroup|SphereCluster|AutoDetector|Signed<.*>|CertifiedField<.*>)::(touches|nearest|first_hit|contacts|is_clear|sampler))\(|"
                                r"AutoDetector::ask<|nearest_many<)")


def run(*command, **options):
    done = subprocess.run(command, capture_output=True, text=True, check=False, **options)
    if done.returncode != 0:
        raise AssertionError(f"{command}\n{done.stdout}{done.stderr}")
    return done.stdout


def first_error(compiler, *flags, code, language="c++"):
    """The first line of what the compiler finds wrong; nothing where it is content."""
    done = subprocess.run([compiler, *flags, *EIGEN, "-x", language, "-", "-o", "/dev/null"], input=code,
                          capture_output=True, text=True, check=False)
    errors = [line for line in done.stderr.splitlines() if "error" in line]
    return errors[0] if done.returncode != 0 else None


def in_parallel(function, arguments):
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        return list(pool.map(lambda argument: function(*argument), arguments))


def weak_of_the_standard_library(symbol):
    """Is it a template of the standard library or of GCC's, which every C++ library shows?"""
    return re.match(r"_Z(Z?NK?St|T[ISV])", symbol) is not None


def has_fused_instructions():
    cpuinfo = pathlib.Path("/proc/cpuinfo")
    return cpuinfo.exists() and re.search(r"^flags.*\bfma\b", cpuinfo.read_text(encoding="utf-8"), re.M) is not None


def fused_functions(assembly):
    """The functions in which the compiler has fused a product and a sum. Of its own listing: to take an object file of
    thousands of sections apart takes objdump a minute."""
    found = set()
    function = ""
    for line in assembly.splitlines():
        if label := re.match(r"([A-Za-z_][\w.$]*):", line):
            function = label[1]
        elif re.match(r"\tvfn?m(add|sub)", line):
            found.add(function)
    return set(run("c++filt", input="\n".join(sorted(found))).splitlines())


def weak_symbols(file):
    lines = run("nm", "-C", "--defined-only", file).splitlines()
    return {line.split(" ", 2)[2] for line in lines if re.match(r"[0-9a-f]+ [WVu] ", line)}


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
        cls.include = cls.prefix / "include"
        cache = (BUILD / "CMakeCache.txt").read_text(encoding="utf-8")
        version = re.search(r"CMAKE_PROJECT_VERSION:STATIC=(.*)", cache)
        cls.package = [f"-DCMAKE_PREFIX_PATH={cls.prefix}", f"-DVERSION={version[1]}"]
        cls.source = directory / "consumer"
        cls.source.mkdir()
        shutil.copy(HERE / "CMakeLists.txt", cls.source)
        code, cls.promised = readme_example()
        (cls.source / "example.cpp").write_text(code, encoding="utf-8")

    def find(self, pattern):
        return next(self.prefix.rglob(pattern))

    def test_the_readme_example_builds_with_find_package(self):
        build = self.source / "build"
        run("cmake", "-S", self.source, "-B", build, *self.package)
        run("cmake", "--build", build)
        self.assertEqual(run(build / "example").rstrip("\n"), self.promised)

    def test_the_readme_example_builds_with_pkg_config(self):
        environment = {**os.environ, "PKG_CONFIG_PATH": str(self.find("touchmark.pc").parent)}
        flags = run("pkg-config", "--cflags", "--libs", "touchmark", env=environment).split()
        program = self.source / "with_pkg_config"
        run("g++", "-std=c++20", self.source / "example.cpp", *flags, "-o", program)
        self.assertEqual(run(program).rstrip("\n"), self.promised)

    def test_the_examples_print_what_the_pages_say(self):
        docs = HERE.parents[1] / "docs"
        pages = "".join((docs / name).read_text(encoding="utf-8") for name in ("library.md", "real-time.md", "c.md"))
        promised = dict(re.findall(r"`(\w+)` prints:\n\n```text\n(.*?)```", pages, re.S))
        self.assertEqual(sorted(promised), sorted(path.stem for path in (docs / "examples").glob("*.c*")))
        build = self.source / "examples"
        run("cmake", "-S", docs / "examples", "-B", build, f"-DCMAKE_PREFIX_PATH={self.prefix}")
        run("cmake", "--build", build)
        for name, output in promised.items():
            self.assertEqual(run(build / name), output, name)

    def test_the_example_in_c_builds_as_c99_without_cmake(self):
        page = (HERE.parents[1] / "docs" / "c.md").read_text(encoding="utf-8")
        promised = re.search(r"`ball_in_c` prints:\n\n```text\n(.*?)```", page, re.S)[1]
        pc = self.find("touchmark-c.pc")
        flags = run("pkg-config", "--cflags", "--libs", "touchmark-c",
                    env={**os.environ, "PKG_CONFIG_PATH": str(pc.parent)}).split()
        for compiler in C_COMPILERS:
            program = self.source / f"ball_with_{compiler}"
            run(compiler, *C99, HERE.parents[1] / "docs" / "examples" / "ball_in_c.c", *flags, "-o", program)
            self.assertEqual(run(program, env={**os.environ, "LD_LIBRARY_PATH": str(pc.parents[1])}), promised)

    def test_a_project_in_c_alone_needs_no_other_language(self):
        source = self.source / "in_c"
        source.mkdir()
        (source / "CMakeLists.txt").write_text(
            "cmake_minimum_required(VERSION 3.25)\nproject(in_c LANGUAGES C)\n"
            "find_package(touchmark REQUIRED COMPONENTS c)\nadd_executable(in_c in_c.c)\n"
            "target_link_libraries(in_c PRIVATE touchmark::c)\n", encoding="utf-8")
        (source / "in_c.c").write_text("#include <touchmark/touchmark.h>\n"
                                       "int main(void) { return touchmark_version()[0] == 0; }\n", encoding="utf-8")
        build = source / "build"
        run("cmake", "-S", source, "-B", build, *self.package[:1])
        run("cmake", "--build", build)
        run(build / "in_c")
        self.assertNotIn("Eigen3_DIR", (build / "CMakeCache.txt").read_text(encoding="utf-8"))

    def test_the_library_for_c_shows_nothing_but_its_functions(self):
        declared = set(re.findall(r"^TOUCHMARK_API [^(]*?(touchmark_\w+)\(",
                                  (self.include / "touchmark" / "touchmark.h").read_text(encoding="utf-8"), re.M))
        symbols = run("nm", "-D", "--defined-only", self.find("libtouchmark_c.so")).splitlines()
        shown = {line.split()[-1] for line in symbols}
        self.assertEqual({name for name in shown if not weak_of_the_standard_library(name)}, declared)
        self.assertGreater(len(declared), 10)

    def test_a_program_that_reads_files_asks_for_what_reads_them(self):
        triangle = (("one.off", "mesh_io", "load_mesh", "OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n"),
                    ("one.raw", "mesh_io_assimp", "load_mesh_with_assimp", "part\n0 0 0 1 0 0 0 1 0\n"))
        for file, library, function, content in triangle:
            source = self.source / library
            source.mkdir()
            shutil.copy(HERE / "CMakeLists.txt", source)
            (source / "example.cpp").write_text(
                f"#include <touchmark/{library}.h>\n"
                f"int main(int, char** a) {{ return touchmark::{function}(a[1]).size() == 1 ? 0 : 1; }}\n", encoding="utf-8")
            (source / file).write_text(content, encoding="utf-8")
            build = source / "build"
            run("cmake", "-S", source, "-B", build, *self.package, f"-DLIBRARY={library}")
            run("cmake", "--build", build)
            run(build / "example", source / file)

    def test_a_plug_in_has_the_library_inside_and_can_be_loaded(self):
        source = self.source / "plugin"
        source.mkdir()
        shutil.copy(HERE / "CMakeLists.txt", source)
        (source / "plugin.cpp").write_text(PLUGIN, encoding="utf-8")
        (source / "one.off").write_text("OFF\n3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", encoding="utf-8")
        build = source / "build"
        run("cmake", "-S", source, "-B", build, *self.package, "-DLIBRARY=mesh_io")
        run("cmake", "--build", build)
        distance_from = ctypes.CDLL(str(build / "plugin.so")).distance_from
        distance_from.restype = ctypes.c_double
        distance_from.argtypes = [ctypes.c_char_p] + 4 * [ctypes.c_double]
        mesh = os.fsencode(source / "one.off")
        self.assertEqual(distance_from(mesh, 0.25, 0.25, 2, 3), 2)
        self.assertEqual(distance_from(mesh, 0.25, 0.25, 2, 1), -1)
        self.assertEqual(distance_from(os.fsencode(source / "none.off"), 0, 0, 0, 1), -3)

    def test_what_choose_prints_compiles(self):
        program = BUILD / "bin" / "touchmark"
        if not program.exists():
            self.skipTest("the program is not built")
        # A second for every query: what other work on the machine takes turns no verdict over.
        mesh = ("--mesh", "icosphere:1", "--rate", "1", "--trajectory", "slide", "--steps", "20")
        motion = self.source / "motion.csv"
        motion.write_text("x,y,z\n" + "".join(f"0,0,{0.01 * i}\n" for i in range(20)), encoding="utf-8")
        bodies = ("--scene", "heap:3", "--rate", "1", "--motion", motion)
        for contestant, query, scene in (
                ("sphere-cluster:prepare=true", "sweep --proxy", mesh), ("grid-group", "sweep --proxy", bodies),
                ("sphere-cluster:prepare=true,clustering=2%,simd=portable", "nearest", mesh),
                ("grid-group:lookup=scan,shape=centered-sphere,cell=0.5,side=on", "nearest", mesh),
                ("grid-group:bytes_per_triangle=200,build=lazy", "touches", mesh),
                ("grid-group:shape=sphere,groups=9", "touches", mesh),
                ("grid-group:lookup=scan,groups=9,prepare=true,threads=2,bytes_per_triangle=300", "sweep", mesh),
                ("sphere-cluster:lookup=scan,clustering=2%,prepare=true,threads=2,simd=portable", "touches", mesh),
                ("aabb-tree:leaf_size=8,certified=false", "sweep", mesh), ("brute-force", "sweep", mesh),
                ("sphere-cluster:clustering=2%", "nearest", bodies), ("grid-group:cell=0.5", "sweep", bodies),
                ("sphere-cluster:lookup=scan", "nearest", bodies), ("grid-group:lookup=scan,cell=0.5", "sweep", bodies),
                ("aabb-tree", "touches", bodies)):
            with self.subTest(contestant), tempfile.TemporaryDirectory() as out:
                run(program, "choose", *scene, "--quick", "--share", "1", "--query", *query.split(),
                    "--detector", contestant, "--out", out)
                code = pathlib.Path(out, "choose.cpp").read_text(encoding="utf-8")
                for compiler in COMPILERS:
                    flags = ["-std=c++20", "-Wall", "-Wextra", "-Werror", "-fsyntax-only", f"-I{self.include}"]
                    self.assertIsNone(first_error(compiler, *flags, code=code), code)

    def test_a_new_plug_in_needs_the_installed_package_alone(self):
        program = BUILD / "bin" / "touchmark"
        if not program.exists():
            self.skipTest("the program is not built")
        mine = self.source / "mine"
        run(program, "new-plugin", mine)
        build = mine / "build"
        run("cmake", "-S", mine, "-B", build, "-DCMAKE_BUILD_TYPE=Release", f"-DCMAKE_PREFIX_PATH={self.prefix}",
            "-DCMAKE_CXX_FLAGS=-Wall -Wextra -Wpedantic -Werror")
        run("cmake", "--build", build)
        self.assertNotIn(str(HERE.parents[1]), (build / "CMakeCache.txt").read_text(encoding="utf-8"))
        out = run(program, "verify", "--mesh", "torus:20x20", "--trajectory", "slide", "--plugin", build / "libmine.so")
        row = next(line for line in out.splitlines() if line.startswith("mine"))
        self.assertIn("4000 answers judged exactly", out)
        self.assertTrue(row.endswith("as claimed"), out)

    def headers(self, pattern):
        return sorted(path.relative_to(self.include).as_posix() for path in self.include.glob(pattern))

    def public_headers(self):
        return self.headers("touchmark/*.h")

    def cpp_headers(self):
        return [header for header in self.public_headers() if header not in IN_C]

    def test_nothing_but_touchmark_is_in_the_include_directory(self):
        self.assertEqual([path.name for path in self.include.iterdir()], ["touchmark"])
        self.assertEqual(self.headers("**/*"), sorted(self.headers("**/*.h") + [
            path.relative_to(self.include).as_posix() for path in self.include.rglob("*") if path.is_dir()]))
        for name in ["aabb_tree", "brute_force", "detector", "grid_group", "mesh_io", "mesh_update", "probe",
                     "published_grid_group", "published_sphere_cluster", "signed_detector", "sphere_cluster", "subdivision", "touchmark", "triangle_mesh"]:
            self.assertIn(f"touchmark/{name}.h", self.public_headers())

    def test_every_installed_header_is_reached_from_a_public_one(self):
        reached = set()
        waiting = self.public_headers()
        while waiting:
            header = waiting.pop()
            if header in reached:
                continue
            reached.add(header)
            text = (self.include / header).read_text(encoding="utf-8")
            self.assertNotIn('#include "core/', text, header)
            waiting += INCLUDE.findall(text)
        self.assertEqual(sorted(reached), self.headers("**/*.h"))

    def test_each_public_header_compiles_alone_and_all_of_them_with_any_compiler(self):
        def compile_headers(compiler, *headers):
            code = "".join(f"#include <{header}>\n" for header in headers)
            return headers, first_error(compiler, "-fsyntax-only", "-std=c++20", "-Wall", "-Wextra", "-Werror", "-I",
                                        str(self.include), code=code)
        headers = self.public_headers()
        cases = [(compiler, *headers) for compiler in COMPILERS] + [(COMPILERS[0], header) for header in headers]
        for names, error in in_parallel(compile_headers, cases):
            self.assertIsNone(error, names)

    def test_headers_of_c_compile_alone_as_c(self):
        for header in IN_C:
            for compiler in C_COMPILERS:
                self.assertIsNone(first_error(compiler, *C99, "-fsyntax-only", "-I", str(self.include), language="c",
                                              code=f"#include <{header}>\n"), (compiler, header))

    def test_vectors_have_their_products(self):
        self.assertIsNone(first_error("g++", "-fsyntax-only", "-std=c++20", "-I", str(self.include), code=TORQUE))

    def test_flags_that_do_not_suit_are_refused_in_the_first_line(self):
        def refuse(compiler, header, flags, message):
            return header, flags, message, first_error(compiler, *flags, "-I", str(self.include),
                                                       code=f"#include <{header}>\n")
        fast = "touchmark needs IEEE 754 arithmetic"
        cases = [("g++", header, ["-fsyntax-only", "-fmax-errors=1", "-std=c++17"], "touchmark needs C++20")
                 for header in self.cpp_headers()]
        for compiler in COMPILERS:  # to preprocess is quicker and will do here
            cases.append((compiler, "touchmark/probe.h", ["-E", "-std=c++17"], "touchmark needs C++20"))
            cases += [(compiler, header, ["-E", "-std=c++20", "-ffast-math"], fast) for header in self.cpp_headers()]
        cases += [("g++", "touchmark/probe.h", ["-E", "-std=c++20", flag], fast)
                  for flag in ("-Ofast", "-ffinite-math-only", "-funsafe-math-optimizations")]
        for header, flags, message, error in in_parallel(refuse, cases):
            self.assertIn(message, error or "no error", (header, flags))

    def compile_answers(self, compiler, name, *flags):
        """tests/install/answers.cpp with these flags."""
        made = self.source / name
        run(compiler, "-std=c++20", *flags, "-I", self.include, *EIGEN, HERE / "answers.cpp", "-o", made)
        return made

    def build_answers(self, compiler, name, *flags):
        made = self.compile_answers(compiler, f"{name}.o", *flags, "-c")
        run(compiler, made, self.find("libtouchmark_core.*"), "-o", self.source / name)
        return self.source / name

    @unittest.skipUnless(has_fused_instructions(), "this processor does not fuse products and sums")
    def test_answers_do_not_depend_on_the_flags_of_the_program(self):
        builds = [("g++", "plain", "-O2", "-ffp-contract=off"), ("g++", "fused", "-O3", *FUSED),
                  ("g++", "small", "-Os", *FUSED)]
        builds += [("clang++", "clang", "-O2", *FUSED)] if "clang++" in COMPILERS else []
        answers = [run(program) for program in in_parallel(self.build_answers, builds)]
        self.assertGreater(len(answers[0].splitlines()), 10)
        for other in answers[1:]:
            self.assertEqual(other, answers[0])

    @unittest.skipUnless(os.uname().machine == "x86_64", "reads x86-64 instructions")
    def test_no_inline_function_rounds_as_the_program_was_compiled(self):
        kept = self.compile_answers("g++", "kept.s", "-O2", "-fkeep-inline-functions", *FUSED, "-S")
        called = self.compile_answers("g++", "called.o", "-O1", "-fno-inline", *FUSED, "-c")
        fused = {function for function in fused_functions(kept.read_text(encoding="utf-8")) & weak_symbols(called)
                 if not FUSED_WITHOUT_HARM.match(function)}
        self.assertTrue(fused)  # those of Eigen
        self.assertEqual({function for function in fused if "touchmark::" in function}, set())
        # The linker may take either copy of a weak function: the library's own must not be replaced by these.
        self.assertEqual(fused & weak_symbols(self.find("libtouchmark_core.a")), set())

    def test_headers_and_libraries_hold_nothing_of_the_program_or_the_rivals(self):
        paths = {path.relative_to(self.prefix) for path in self.prefix.rglob("*") if path.is_file()}
        names = {path.name for path in paths if "touchmark" not in path.parts or path.parts[0] == "include"}
        self.assertFalse({name for name in names if "bench" in name or "fcl" in name or "bullet" in name})
        self.assertIn("libtouchmark_core.a", names)


if __name__ == "__main__":
    unittest.main()
