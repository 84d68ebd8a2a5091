"""results/expected: the answers and work that every machine must find, and slow-downs that were accepted."""
import json
import os

from regression.failure import BadInput, NoResources
from regression.judge import Accepted

FIELDS = ("inputs", "cells", "spheres", "boxes", "triangles", "answers", "details")


def read(path):
    try:
        with open(path, encoding="utf-8") as file:
            return json.load(file)
    except FileNotFoundError:
        return None
    except (OSError, ValueError) as error:
        raise BadInput(f"{path}: {error}") from None


def write(path, record):
    """A line for each case, so that a change shows which."""
    lines = [f"  {json.dumps(name)}: {json.dumps(case)}" for name, case in sorted(record["cases"].items())]
    head = {key: value for key, value in record.items() if key != "cases"}
    text = json.dumps(head, indent=1)[:-2] + ',\n "cases": {\n' + ",\n".join(lines) + "\n }\n}\n"
    write_text(path, text)


def write_text(path, text):
    temporary = path.with_name(f"{path.name}.part-{os.getpid()}")
    try:
        path.parent.mkdir(parents=True, exist_ok=True)
        temporary.write_text(text, encoding="utf-8")
        temporary.replace(path)
    except OSError as error:
        temporary.unlink(missing_ok=True)
        raise NoResources(f"cannot write {path}: {error.strerror}") from None


def read_answers(path):
    record = read(path)
    if record is None:
        raise BadInput(f"{path} is missing: scripts/regress --update-expected --reason '...' writes it")
    if record.get("schema") != 1 or not isinstance(record.get("cases"), dict):
        raise BadInput(f"{path} is no expectation of schema 1")
    return record["cases"]


def update_answers(path, measured, reason):
    """Returns the names of cases that changed. What could not be measured here keeps its expectation."""
    old = (read(path) or {"cases": {}})["cases"]
    new = {}
    for name, case in measured.items():
        if not case["note"]:
            new[name] = {field: case[field] for field in FIELDS}
        elif name in old:
            new[name] = old[name]
    write(path, {"schema": 1, "reason": reason, "cases": new})
    return sorted(name for name in new.keys() | old.keys() if new.get(name) != old.get(name))


def read_accepted(path, core_of_base):
    """Case to Accepted, for a comparison with this base; nothing once the base has moved on."""
    record = read(path)
    if record is None or record.get("base") != core_of_base:
        return {}
    return {name: Accepted(max(1.0, case["instructions"]), max(1.0, case["time"]))
            for name, case in record["cases"].items()}


def write_accepted(path, core_of_base, reason, cases):
    """cases: name to (ratio of instructions, ratio of times)."""
    write(path, {"schema": 1, "base": core_of_base, "reason": reason,
                 "cases": {name: {"instructions": round(ratios[0], 4), "time": round(ratios[1], 4)}
                           for name, ratios in cases.items()}})
