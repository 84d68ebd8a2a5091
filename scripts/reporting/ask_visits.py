"""Asks the program again what our detectors looked at in the slowest and the first wrong steps of a run: visited.json."""
import json
import os
import pathlib
import shlex
import shutil
import subprocess
import sys

import numpy

from drawing.results import Unusable

from .steps_file import Damaged, StepsFile, steps_of
from .visits import name_of

ROOT = pathlib.Path(__file__).resolve().parents[2]
TRACED = ("aabb-tree", "grid-group", "sphere-cluster")
SLOWEST, WRONG = 10, 20


def program():
    """The touchmark to ask, with touchmark-tracer beside it, which is built where it is missing."""
    built = os.environ.get("TOUCHMARK_PROGRAM") or ROOT / "build" / "release" / "bin" / "touchmark"
    builder = ROOT / "scripts" / "build-program"
    found = pathlib.Path(built if builder.is_file() else shutil.which("touchmark") or built).resolve()
    if not found.with_name("touchmark-tracer").is_file() and builder.is_file() and "TOUCHMARK_PROGRAM" not in os.environ:
        subprocess.run([builder, "touchmark-tracer"], stdout=sys.stderr, check=False)
    if not found.with_name("touchmark-tracer").is_file():
        raise Unusable(f"there is no touchmark-tracer beside {found}; scripts/build-program touchmark-tracer builds it")
    return found


def worth_a_look(steps_file, trace, one):
    """Its ten slowest and its first 20 wrong steps, ascending."""
    noted = steps_file.block(trace["noted"]["steps"])[steps_file.block(one["noted"]["asked"]) == 1]
    slowest = noted[numpy.argsort(-steps_file.block(one["noted"]["ns"]), kind="stable")[:SLOWEST]]
    wrong = steps_of(one["ranges"])[steps_file.block(one["charged"]) != 0][:WRONG]
    return sorted({*slowest.tolist(), *wrong.tolist()})


def visits_asked_of(folder):
    """The text of visited.json. Raises Unusable."""
    rows = []
    try:
        steps_file = StepsFile(folder / "steps.bin")
        asked = program()
        for trace in steps_file.traces:
            for one in trace["contestants"]:
                if one["detector"] not in TRACED or "lookup=scan" in one["options"]:
                    continue
                if steps := worth_a_look(steps_file, trace, one):
                    rows.append({"detector": one["detector"], "options": one["options"], "trajectory": trace["trajectory"],
                                 **visits_in(asked, one, steps)})
    except Damaged as error:
        raise Unusable(str(error)) from None
    return json.dumps({"schema": 1, "run_id": steps_file.run_id, "rows": rows}) + "\n"


def visits_in(asked, one, steps):
    """Of one row: the steps, or why they are not known."""
    words = shlex.split(one["repeat"])  # touchmark query ... --step
    done = subprocess.run([asked, *words[1:-1], "--visits", ",".join(map(str, steps))], capture_output=True, text=True, check=False)
    if done.returncode == 0:
        return {"steps": json.loads(done.stdout)}
    why = (done.stderr.strip().splitlines() or [f"status {done.returncode}"])[-1]
    print(f"report: what {name_of(one)} looked at is not known: {why}", file=sys.stderr)
    return {"why_not": why, "steps": []}
