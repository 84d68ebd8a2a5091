"""Runs touchmark-regression and reads what it leaves."""
import csv
import pathlib
import re
import shutil
import subprocess
import tempfile

import numpy

from regression.failure import NoResources

COUNTERS = ("cells", "spheres", "boxes", "triangles")
PLUGINS = ("base", "control", "head")


def run(command):
    return subprocess.Popen(command, stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)


def wait_for(process, what):
    _, errors = process.communicate()
    if process.returncode != 0:
        last = (errors.strip() or f"status {process.returncode}").splitlines()[-1]
        raise NoResources(f"{what}: {last}")


def together(commands, what):
    """Runs them at the same time: for what the other's load does not change."""
    processes = [run(command) for command in commands]
    try:
        for process in processes:
            wait_for(process, what)
    finally:
        for process in processes:
            if process.poll() is None:
                process.kill()
                process.wait()


def read_answers(path):
    with open(path, newline="", encoding="utf-8") as file:
        rows = {}
        for row in csv.DictReader(file):
            name = row.pop("case")
            row["needs_file"] = row["needs_file"] == "1"
            row.update((counter, int(row[counter])) for counter in COUNTERS if row[counter])
            rows[name] = row
        return rows


def answers(driver, plugins):
    """One dictionary a plug-in: case to work counters and checksums."""
    with tempfile.TemporaryDirectory() as folder:
        outs = [pathlib.Path(folder) / f"{i}.csv" for i in range(len(plugins))]
        together([[driver, "answers", "--plugin", plugin, "--out", out] for plugin, out in zip(plugins, outs)],
                 "the answers could not be had")
        return [read_answers(out) for out in outs]


def read_dump(path):
    """The case that a callgrind dump is named after, and its instructions; or None."""
    case = total = None
    with open(path, encoding="utf-8", errors="replace") as file:
        for line in file:
            found = re.match(r"desc: Trigger: Client Request: (.*)", line)
            case = found[1].strip() if found else case
            found = re.match(r"(?:summary|totals): (\d+)", line)
            total = int(found[1]) if found else total
    return (case, total) if case and total else None


def instructions(driver, plugins):
    """One dictionary a plug-in: case to instructions of one replay."""
    if shutil.which("valgrind") is None:
        raise NoResources("valgrind is missing, which counts instructions: run scripts/setup develop")
    with tempfile.TemporaryDirectory() as folder:
        outs = [pathlib.Path(folder) / str(i) for i in range(len(plugins))]
        for out in outs:
            out.mkdir()
        together([["valgrind", "--tool=callgrind", "--instr-atstart=no", f"--callgrind-out-file={out}/dump", driver,
                   "instructions", "--plugin", plugin]
                  for plugin, out in zip(plugins, outs)], "the instructions could not be counted")
        return [dict(filter(None, map(read_dump, sorted(out.iterdir())))) for out in outs]


def read_times(path):
    """Case to sittings x rounds x (base, control, head), nanoseconds."""
    rows = {}
    with open(path, newline="", encoding="utf-8") as file:
        for row in csv.DictReader(file):
            sittings = rows.setdefault(row["case"], {})
            sittings.setdefault(row["sitting"], []).append([float(row[f"{plugin}_ns"]) for plugin in PLUGINS])
    return {case: numpy.array(list(sittings.values())) for case, sittings in rows.items()}


def times(driver, plugins, out, seed, cases=()):
    """plugins: base, control, head. The rounds stay in the file `out`."""
    command = [driver, "times", "--out", out, "--seed", str(seed)]
    for name, plugin in zip(PLUGINS, plugins):
        command += [f"--{name}", plugin]
    for case in cases:
        command += ["--case", case]
    together([command], "the times could not be taken")
    return read_times(out)
