#!/usr/bin/python3
"""scripts/sweep-slurm on a Slurm of its own: two nodes on this machine, a controller and munge, all with ports and folders of
their own and ended by their process numbers. A task is killed, and a node dies; the sweep loses nothing and counts
nothing twice.

Argument: the program.
"""
import contextlib
import csv
import json
import os
import pathlib
import shutil
import signal
import socket
import subprocess
import sys
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAM = str(pathlib.Path(sys.argv.pop(1)).resolve())
os.environ["PATH"] += ":/usr/sbin"
MISSING = [tool for tool in ("munged", "slurmctld", "slurmd", "sbatch") if not shutil.which(tool)]
ROOT_ONLY = os.geteuid() != 0

CONFIGURATION = """\
ClusterName=trial
SlurmctldHost={host}(127.0.0.1)
SlurmctldPort={ports[0]}
SlurmUser=root
SlurmdUser=root
AuthType=auth/munge
AuthInfo=socket={folder}/munge.socket,cred_expire=5
StateSaveLocation={folder}/state
SlurmdSpoolDir={folder}/spool-%n
SlurmctldPidFile={folder}/slurmctld.pid
SlurmdPidFile={folder}/slurmd-%n.pid
SlurmctldLogFile={folder}/slurmctld.log
SlurmdLogFile={folder}/slurmd-%n.log
ProctrackType=proctrack/linuxproc
TaskPlugin=task/none
SelectType=select/linear
SwitchType=switch/none
MpiDefault=none
ReturnToService=2
SlurmdTimeout=3
SchedulerParameters=sched_interval=1,bf_interval=1,batch_sched_delay=0
KillWait=1
JobAcctGatherType=jobacct_gather/none
AccountingStorageType=accounting_storage/none
NodeName=first NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[1]} CPUs=1 State=UNKNOWN
NodeName=second NodeHostname={host} NodeAddr=127.0.0.1 Port={ports[2]} CPUs=1 State=UNKNOWN
PartitionName=all Nodes=first,second Default=YES MaxTime=INFINITE State=UP
"""

# Notes which process a task is, and holds up its end until it is told to go on.
WRAPPER = """#!/bin/bash
echo $$ >"{folder}/task-$SLURM_ARRAY_TASK_ID.part"
echo "$SLURMD_NODENAME" >"{folder}/node-$SLURM_ARRAY_TASK_ID"
mv "{folder}/task-$SLURM_ARRAY_TASK_ID.part" "{folder}/task-$SLURM_ARRAY_TASK_ID"
while [ ! -e "{folder}/go" ]; do sleep 0.05; done
exec "{program}" "$@"
"""


def free_ports(count):
    with contextlib.ExitStack() as open_ones:
        sockets = [open_ones.enter_context(socket.socket()) for _ in range(count)]
        for one in sockets:
            one.bind(("127.0.0.1", 0))
        return [one.getsockname()[1] for one in sockets]


def parent_of(process):
    return int(pathlib.Path(f"/proc/{process}/stat").read_text(encoding="utf-8").rsplit(")", 1)[1].split()[1])


def name_of(process):
    return pathlib.Path(f"/proc/{process}/comm").read_text(encoding="utf-8").strip()


@unittest.skipIf(MISSING, f"Slurm is not installed, {', '.join(MISSING)} missing: scripts/setup slurm")
@unittest.skipIf(ROOT_ONLY, "a Slurm of its own needs root, since its daemons change to the user of a job")
class Slurm(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.folder = pathlib.Path(temporary.name)
        self.daemons = []
        self.addCleanup(self.end_all)
        (self.folder / "state").mkdir()
        for node in ("first", "second"):
            (self.folder / f"spool-{node}").mkdir()
        key = self.folder / "munge.key"
        key.write_bytes(os.urandom(1024))
        key.chmod(0o600)
        (self.folder / "slurm.conf").write_text(
            CONFIGURATION.format(host=socket.gethostname().split(".")[0], folder=self.folder, ports=free_ports(3)), encoding="utf-8")
        self.environment = {**os.environ, "SLURM_CONF": str(self.folder / "slurm.conf")}
        self.start("munged", "--foreground", "--force", f"--socket={self.folder}/munge.socket", f"--key-file={key}",
                   f"--pid-file={self.folder}/munged.pid", f"--log-file={self.folder}/munged.log",
                   f"--seed-file={self.folder}/munge.seed")
        self.wait_for(lambda: (self.folder / "munge.socket").exists(), "munged")
        self.start("slurmctld", "-D")
        self.nodes = {node: self.start("slurmd", "-D", "-N", node) for node in ("first", "second")}
        self.wait_for(lambda: self.slurm("sinfo", "-h", "-N", "-o", "%T").split() == ["idle", "idle"], "two nodes")

    def start(self, *command):
        log = self.folder / f"{command[0]}-{len(self.daemons)}.out"
        with open(log, "w", encoding="utf-8") as out:
            daemon = subprocess.Popen(command, env=self.environment, stdin=subprocess.DEVNULL, stdout=out, stderr=out)
        self.daemons.append(daemon)
        return daemon

    def end_all(self):
        (self.folder / "go").touch()
        if self.daemons:
            self.slurm("scancel", "--user=root", "--quiet", check=False)
        for daemon in reversed(self.daemons):
            daemon.terminate()
            try:
                daemon.wait(10)
            except subprocess.TimeoutExpired:
                daemon.kill()
                daemon.wait()

    def slurm(self, *command, check=True):
        done = subprocess.run(command, capture_output=True, text=True, env=self.environment, cwd=self.folder, timeout=30,
                              check=False, stdin=subprocess.DEVNULL)
        if check and done.returncode != 0:
            return ""
        return done.stdout

    def touchmark(self, *command):
        done = subprocess.run([PROGRAM, *command], capture_output=True, text=True, cwd=self.folder, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done

    def wait_for(self, is_so, what, seconds=60):
        deadline = time.monotonic() + seconds
        while not is_so():
            if time.monotonic() > deadline:
                logs = "\n".join(f"{path.name}:\n{path.read_text(errors='replace')[-1500:]}" for path in self.folder.glob("*.out"))
                self.fail(f"waited for {what}\n{logs}")
            time.sleep(0.1)

    def submit(self):
        """Two tasks, each held up once it has begun."""
        for path in (*self.folder.glob("task-*"), self.folder / "go"):
            path.unlink(missing_ok=True)
        environment = {**self.environment, "TOUCHMARK": str(self.folder / "wrapper")}
        done = subprocess.run(["sbatch", "--parsable", "--array=1-2", f"--output={self.folder}/said-%a",
                               ROOT / "scripts" / "sweep-slurm", "sweep.json", "jobs"],
                              cwd=self.folder, env=environment, capture_output=True, text=True, check=False)
        self.assertEqual(done.returncode, 0, done.stderr)
        return done.stdout.strip()

    def task(self, number):
        """The process of a task and its node, once it is held up."""
        note = self.folder / f"task-{number}"
        self.wait_for(note.exists, f"task {number}")
        node = (self.folder / f"node-{number}").read_text(encoding="utf-8").strip()
        return int(note.read_text(encoding="utf-8")), node

    def all_done(self):
        self.wait_for(lambda: self.slurm("squeue", "-h", "-o", "%i") == "" and
                      self.slurm("sinfo", "-h", "-o", "%T") != "", "the end of all tasks")

    def finished(self):
        jobs = self.folder / "jobs"
        return {path.stem for path in jobs.glob("*.json")} if jobs.exists() else set()

    def merged(self, out):
        self.touchmark("merge", "jobs", "--manifest", "sweep.json", "--accuracy-only", "--out", out)
        with open(self.folder / out, newline="", encoding="utf-8") as file:
            return list(csv.DictReader(file))

    def test_a_killed_task_and_a_dead_node_lose_nothing_and_count_nothing_twice(self):
        self.touchmark("plan", "--mesh", "cube", "--mesh", "icosphere:1", "--trajectory", "slide", "--trajectory", "jump",
                       "--query", "nearest", "--query", "touches", "--steps", "30", "--detector", "aabb-tree", "--detector",
                       "grid-group", "--effort", "accuracy", "--out", "sweep.json")
        manifest = json.loads((self.folder / "sweep.json").read_text(encoding="utf-8"))
        ids = {job["id"] for scene in manifest["scenes"] for job in scene["jobs"]}
        self.assertEqual(len(ids), 16)
        wrapper = self.folder / "wrapper"
        wrapper.write_text(WRAPPER.format(folder=self.folder, program=PROGRAM), encoding="utf-8")
        wrapper.chmod(0o755)

        # Both nodes work; one task is killed before it has done anything.
        self.submit()
        (killed, node), (_, other) = self.task(1), self.task(2)
        self.assertEqual({node, other}, {"first", "second"})
        os.kill(killed, signal.SIGKILL)
        (self.folder / "go").touch()
        self.all_done()
        done_by_second = self.finished()
        self.assertEqual(len(done_by_second), 8)
        times = {path: path.stat().st_mtime_ns for path in (self.folder / "jobs").glob("*.json")}

        # Submitted again; the node of task 1 dies with all that runs there, and Slurm gives its task to the other one.
        (self.folder / "said-2").unlink()
        self.submit()
        (process, node), (_, other) = self.task(1), self.task(2)
        step = parent_of(process)
        self.assertEqual(name_of(step), "slurmstepd")
        (self.folder / "task-1").unlink()
        for one in (self.nodes[node].pid, step, process):
            os.kill(one, signal.SIGKILL)
        self.nodes[node].wait()
        (self.folder / "go").touch()
        self.wait_for(lambda: "down" in self.slurm("sinfo", "-h", "-n", node, "-o", "%T"), f"the end of {node}")
        self.assertEqual(self.task(1)[1], other)
        self.all_done()
        self.assertIn("0 jobs done, 8 were finished before", (self.folder / "said-2").read_text(encoding="utf-8"))
        self.assertEqual(self.finished(), ids)
        for path, before in times.items():
            self.assertEqual(path.stat().st_mtime_ns, before)

        rows = self.merged("results.csv")
        self.assertEqual(len(rows), len(ids))
        self.assertEqual({row["status"] for row in rows}, {"ok"})
        sources = [row["source"] for row in rows]
        self.assertEqual({source.split(" on ")[0] for source in sources}, {f"jobs/{one}.json" for one in ids})

        # What one run alone would have found.
        shutil.rmtree(self.folder / "jobs")
        self.touchmark("run", "--manifest", "sweep.json", "--out", "jobs")
        for left, right in zip(rows, self.merged("alone.csv")):
            self.assertEqual({**left, "run_id": ""}, {**right, "run_id": ""})


if __name__ == "__main__":
    unittest.main(verbosity=2)
