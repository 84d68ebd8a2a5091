"""visited.json, as docs/reference/visited-json.md describes it: what our detectors looked at in steps worth a look."""
import json

import numpy

NUMBERS = {"cells": 6, "groups": 8, "boxes": 7, "cylinders": 9}  # of each
LEVELS = 65535


class Unreadable(Exception):
    """The file cannot be used; the message is the end of a sentence."""


class Visits:
    """Raises Unreadable."""

    def __init__(self, path):
        try:
            content = json.loads(path.read_text(encoding="utf-8"))
            version = content["schema"]
            if version == 1:
                self.run_id = content["run_id"]
                self.rows = {(name_of(row), row["trajectory"]): [Step(step) for step in row["steps"]] for row in content["rows"]}
        except OSError as error:
            raise Unreadable(f"{path} cannot be read: {error.strerror}") from None
        except (KeyError, TypeError, AttributeError, ValueError):
            raise Unreadable(f"{path} is not as it should be") from None
        if version != 1:
            raise Unreadable(f"{path} is of version {version}; this script reads version 1")


def name_of(row):
    return row["detector"] + (":" + row["options"] if row["options"] else "")


class Step:
    """What one query looked at, a row of numbers each."""

    def __init__(self, step):
        self.step = int(step["step"])
        self.kinds = {}
        for kind, width in NUMBERS.items():
            self.kinds[kind] = numpy.array(step.get(kind, []), float).reshape(-1, width)
            if not numpy.isfinite(self.kinds[kind]).all():
                raise ValueError(kind)
        self.triangles = numpy.array(step.get("triangles", []), numpy.uint32)
        self.left_out = sum(step.get("left_out", {}).values())


def visits_of(visits, packer):
    """The page's JSON about all rows; places have 16 bits a coordinate of a box around all."""
    steps = [step for row in visits.rows.values() for step in row]
    corners = [boxes[:, k:k + 3] for step in steps for kind, boxes in step.kinds.items()
               for k in ((0,) if kind == "cylinders" else (0, 3)) if len(boxes)]
    if not corners:
        return None
    every = numpy.concatenate(corners)
    low, high = every.min(axis=0), every.max(axis=0)
    longest = max([float(step.kinds["cylinders"][:, 6:8].max()) for step in steps if len(step.kinds["cylinders"])] or [1.0])
    return {"low": low.tolist(), "high": high.tolist(), "longest": longest,
            "rows": [row_of(name, trajectory, row, packer, low, high, longest) for (name, trajectory), row in visits.rows.items()]}


def row_of(name, trajectory, steps, packer, low, high, longest):
    together = {kind: numpy.concatenate([step.kinds[kind] for step in steps] or [numpy.zeros((0, width))])
                for kind, width in NUMBERS.items()}
    boxes = {kind: [packer.add(levels(together[kind][:, axis], low[axis % 3], high[axis % 3])) for axis in range(6)]
             for kind in ("cells", "groups", "boxes")}
    rods = together["cylinders"]
    return {
        "name": name, "trajectory": trajectory,
        "steps": packer.add(numpy.array([step.step for step in steps], numpy.uint32)),
        "leftOut": [step.left_out for step in steps],
        "counts": {kind: packer.add(numpy.array([len(step.kinds[kind]) for step in steps], numpy.uint32)) for kind in NUMBERS},
        "places": boxes,
        "entered": {"groups": packer.add(together["groups"][:, 6].astype(numpy.uint8)),
                    "boxes": packer.add(together["boxes"][:, 6].astype(numpy.uint8)),
                    "cylinders": packer.add(rods[:, 8].astype(numpy.uint8))},
        "members": packer.add(together["groups"][:, 7].astype(numpy.uint32)),
        "cylinders": [*(packer.add(levels(rods[:, axis], low[axis], high[axis])) for axis in range(3)),
                      *(packer.add(levels(rods[:, axis], -1, 1)) for axis in range(3, 6)),
                      *(packer.add(levels(rods[:, axis], 0, longest)) for axis in (6, 7))],
        "triangleCounts": packer.add(numpy.array([len(step.triangles) for step in steps], numpy.uint32)),
        "triangles": packer.add(numpy.concatenate([step.triangles for step in steps] or [numpy.zeros(0, numpy.uint32)])),
    }


def levels(values, low, high):
    share = (values - low) / (high - low) if high > low else numpy.zeros(len(values))
    return numpy.rint(LEVELS * numpy.clip(share, 0, 1)).astype(numpy.uint16)
