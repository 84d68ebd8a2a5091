"""What the page needs of steps.bin: curves at 8 bits a time, and all about the steps that are noted."""
import math

import numpy

from .packing import log_levels, on_grid
from .steps_file import steps_of, times_of

KINDS_OF_CHARGES = ["missed", "false contact", "wrong triangle", "wrong distance", "wrong point", "wrong normal",
                    "malformed", "wrong side"]


def replay_of(file, packer, levels):
    """The page's JSON about one steps.bin; its arrays go to the packer. `levels`: how many a curve's time has."""
    mesh, near = file.mesh, file.mesh["near"]
    drawn = mesh["drawn"]
    return {
        "mesh": {"name": mesh["name"], "triangles": mesh["triangles"], "diagonal": mesh["diagonal"], "low": mesh["low"],
                 "high": mesh["high"], "drawnTriangles": drawn["triangles"], "drawnLow": drawn["low"],
                 "drawnHigh": drawn["high"],
                 "vertices": [packer.add(file.block(axis), True) for axis in drawn["vertices"]],
                 "corners": packer.add(file.block(drawn["corners"]), True),
                 "nearIds": packer.add(file.block(near["ids"])), "nearCorners": packer.add(file.block(near["corners"])),
                 "nearVertices": packer.add(file.block(near["vertices"]))},
        "traces": [trace_of(file, trace, packer, levels) for trace in file.traces],
    }


def trace_of(file, trace, packer, levels):
    low, high = trace["low"], trace["high"]
    truth, noted = trace["truth"], trace["noted"]
    distance = file.block(truth["distance"])
    state = file.block(truth["state"])
    known = numpy.isfinite(distance) & (state & 1 > 0)
    largest = float(distance[known].max()) if known.any() else 0.0
    shares = numpy.where(known, numpy.nan_to_num(distance, posinf=0) / (largest or 1), 0)
    noted_steps = file.block(noted["steps"])
    return {
        "trajectory": trace["trajectory"], "query": trace["query"], "steps": trace["steps"], "radius": trace["radius"],
        "reach": trace["reach"], "low": low, "high": high,
        "position": [packer.add(file.block(axis), True) for axis in trace["position"]],
        "point": [packer.add(axis, True) for axis in on_grid(file.places(truth["point"], low, high), low, high)],
        "state": packer.add(state), "triangle": packer.add(file.block(truth["triangle"]), True),
        "largestDistance": largest, "distance": packer.add(numpy.rint(shares * 65535).astype(numpy.uint16), True),
        "noted": {"steps": packer.add(noted_steps), "probes": packer.add(file.block(noted["probes"])),
                  "truthDistance": packer.add(distance[noted_steps]),
                  "counts": packer.add(file.block(noted["around_counts"])), "around": packer.add(file.block(noted["around"]), True)},
        "contestants": [contestant_of(file, row, packer, levels, state) for row in trace["contestants"]],
    }


def contestant_of(file, row, packer, levels, state):
    steps = steps_of(row["ranges"])
    times, work = times_of(file, row["ns"]), file.block(row["work"]).astype(float)
    coded, low, high = log_levels(times, levels)
    coded_work, low_work, high_work = log_levels(work, levels)
    found, charged = file.block(row["found"]), file.block(row["charged"])
    noted = row["noted"]
    return {
        "name": row["detector"] + (":" + row["options"] if row["options"] else ""), "repeat": row["repeat"],
        "ranges": row["ranges"], "levels": levels,
        "ns": packer.add(coded), "lowNs": low, "highNs": high,
        "work": packer.add(coded_work), "lowWork": low_work, "highWork": high_work,
        # Against the truth, so that right answers are zeros.
        "differs": packer.add(found ^ (state[steps] >> 1)), "charged": packer.add(charged),
        "wrong": int((charged > 0).sum()),
        "asked": packer.add(file.block(noted["asked"])), "notedNs": packer.add(file.block(noted["ns"])),
        "answers": packer.add(file.block(noted["answers"])),
    }


def resolution(levels, replay):
    """By how much a curve's time can be off, at worst, in per cent."""
    widest = max((math.log(row["highNs"] / row["lowNs"]) for trace in replay["traces"] for row in trace["contestants"]),
                 default=0)
    return 100 * (math.exp(widest / (levels - 1) / 2) - 1)
