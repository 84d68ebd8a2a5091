#!/usr/bin/python3
"""A sweep planned, run in shards by Snakemake and as a Slurm array would, and merged. Argument: the program."""
import csv
import json
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
SNAKEMAKE = shutil.which("snakemake", path="/usr/bin:" + os.environ.get("PATH", ""))


class Sweep(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.directory = pathlib.Path(temporary.name)

    def run_here(self, *command, **variables):
        return subprocess.run(command, cwd=self.directory, capture_output=True, text=True, check=False,
                              stdin=subprocess.DEVNULL,
                              env={**os.environ, "XDG_CACHE_HOME": str(self.directory / "cache"), **variables})

    def plan(self, effort):
        done = self.run_here(PROGRAM, "plan", "--mesh", "cube", "--mesh", "icosphere:1", "--trajectory", "slide",
                             "--trajectory", "jump", "--query", "nearest", "--query", "touches", "--steps", "30",
                             "--detector", "aabb-tree", "--detector", "grid-group", "--effort", effort, "--out", "sweep.json")
        self.assertEqual(done.returncode, 0, done.stderr)
        manifest = json.loads((self.directory / "sweep.json").read_text(encoding="utf-8"))
        return [job["id"] for scene in manifest["scenes"] for job in scene["jobs"]]

    def rows(self, path):
        with open(self.directory / path, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def snakemake(self, *more):
        return self.run_here(SNAKEMAKE, "-s", ROOT / "scripts" / "sweep.smk", "--cores", "2", "--config",
                             "manifest=sweep.json", "out=out", "shards=3", f"program={PROGRAM}", *more)

    @unittest.skipIf(SNAKEMAKE is None, "snakemake is missing (scripts/setup sweeps installs it)")
    def test_snakemake_runs_several_jobs_and_merges_them(self):
        ids = self.plan("accuracy")
        self.assertEqual(len(ids), 16)
        done = self.snakemake()
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertEqual({path.name for path in (self.directory / "out" / "jobs").iterdir()}, {f"{i}.json" for i in ids})
        rows = self.rows("out/results.csv")
        self.assertEqual(len(rows), 16)
        self.assertEqual({row["status"] for row in rows}, {"ok"})
        self.assertEqual({row["missed"] for row in rows}, {"0"})
        self.assertEqual([row["mesh"] for row in rows], ["cube"] * 8 + ["icosphere:1"] * 8)
        self.assertEqual(self.run_here(PROGRAM, "validate", "out/results.csv").returncode, 0)
        again = self.snakemake()
        self.assertEqual(again.returncode, 0, again.stderr)
        self.assertIn("Nothing to be done", again.stderr + again.stdout)

    @unittest.skipIf(SNAKEMAKE is None, "snakemake is missing (scripts/setup sweeps installs it)")
    def test_snakemake_goes_on_after_a_killed_shard(self):
        ids = self.plan("accuracy")
        wrapper = self.directory / "wrapper"
        wrapper.write_text(f'#!/bin/bash\nif [[ "$*" == *2/3* ]] && [ ! -e killed ]; then touch killed; kill -9 $$; fi\n'
                           f'exec "{PROGRAM}" "$@"\n', encoding="utf-8")
        wrapper.chmod(0o755)
        program = f"program={wrapper}"
        killed = self.snakemake(program, "--keep-going")
        self.assertNotEqual(killed.returncode, 0)
        before = {path.name: path.stat().st_mtime_ns for path in (self.directory / "out" / "jobs").iterdir()}
        self.assertTrue(0 < len(before) < len(ids))
        done = self.snakemake(program)
        self.assertEqual(done.returncode, 0, done.stderr)
        after = {path.name: path.stat().st_mtime_ns for path in (self.directory / "out" / "jobs").iterdir()}
        self.assertEqual(set(after), {f"{i}.json" for i in ids})
        self.assertEqual({**after, **before}, after)
        rows = self.rows("out/results.csv")
        self.assertEqual({row["source"].split(" on ")[0] for row in rows}, {f"out/jobs/{i}.json" for i in ids})
        self.assertEqual(len(rows), len(ids))

    @unittest.skipIf(SNAKEMAKE is None, "snakemake is missing (scripts/setup sweeps installs it)")
    def test_snakemake_times_one_shard_after_the_other(self):
        self.plan("quick")
        done = self.snakemake("-n")
        self.assertEqual(done.returncode, 0, done.stderr)
        self.assertIn("threads: 2", done.stdout + done.stderr)

    def test_slurm_tasks_share_the_work(self):
        ids = self.plan("accuracy")
        slurm = ROOT / "scripts" / "sweep-slurm"
        for task in (5, 6):
            done = self.run_here(slurm, "sweep.json", "jobs", TOUCHMARK=PROGRAM, SLURM_ARRAY_TASK_ID=str(task),
                                 SLURM_ARRAY_TASK_MIN="5", SLURM_ARRAY_TASK_COUNT="2")
            self.assertEqual(done.returncode, 0, done.stderr)
            self.assertIn(f"shard {task - 4}/2: 8 jobs done", done.stderr)
        self.assertEqual(len(list((self.directory / "jobs").iterdir())), len(ids))
        self.assertEqual(self.run_here(slurm, "sweep.json", "jobs", TOUCHMARK=PROGRAM).returncode, 2)
        self.assertEqual(self.run_here(slurm, "sweep.json").returncode, 2)


if __name__ == "__main__":
    unittest.main()
