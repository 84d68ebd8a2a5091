"""What the page needs of steps.bin: curves at 8 bits a time, and all about the steps that are noted."""
import math
from typing import NamedTuple

import numpy

from .packing import coarser, log_levels
from .steps_file import steps_of, times_of

KINDS_OF_CHARGES = ["missed", "false contact", "wrong triangle", "wrong distance", "wrong point", "wrong normal",
                    "malformed", "wrong side"]


class Detail(NamedTuple):
    """How much the page says of steps that are not noted."""

    levels: int  # of a time, on a log scale
    bits: int  # of a coordinate, of the box of the trajectory
    visits: bool = True  # what queries looked at


ANSWER = 8  # numbers: distance, point, normal, fraction


def replay_of(file, packer, detail):
    """The page's JSON about one steps.bin; its arrays go to the packer. """
    mesh, near = file.mesh, file.mesh["near"]
    drawn = mesh["drawn"]
    return {
        "mesh": {"name": mesh["name"], "triangles": mesh["triangles"], "diagonal": mesh["diagonal"], "low": mesh["low"],
                 "high": mesh["high"], "drawnTriangles": drawn["triangles"], "drawnLow": drawn["low"],
                 "drawnHigh": drawn["high"],
                 "vertices": [packer.add(file.block(axis)) for axis in drawn["vertices"]],
                 "corners": packer.add(file.block(drawn["corners"])),
                 "nearIds": packer.add(file.block(near["ids"])), "nearCorners": packer.add(file.block(near["corners"])),
                 "nearVertices": packer.add(file.block(near["vertices"]))},
        "traces": [trace_of(file, trace, packer, detail) for trace in file.traces],
    }


def trace_of(file, trace, packer, detail):
    low, high = trace["low"], trace["high"]
    truth, noted = trace["truth"], trace["noted"]
    distance = file.block(truth["distance"])
    state = file.block(truth["state"])
    known = numpy.isfinite(distance) & (state & 1 > 0)
    largest = float(distance[known].max()) if known.any() else 0.0
    shares = numpy.where(known, numpy.nan_to_num(distance, posinf=0) / (largest or 1), 0)
    noted_steps = file.block(noted["steps"])
    position = [coarser(file.block(axis), detail.bits) for axis in trace["position"]]
    point = [coarser(file.block(axis), detail.bits) for axis in truth["point"]]
    usual = usual_answers(file, trace)
    return {
        "trajectory": trace["trajectory"], "query": trace["query"], "steps": trace["steps"], "radius": trace["radius"],
        "reach": trace["reach"], "low": low, "high": high,
        "position": [packer.add(axis) for axis in position],
        # From the probe's centre, near which it is, modulo 65536.
        "point": [packer.add(axis - center) for axis, center in zip(point, position)],
        "state": packer.add(state), "triangle": packer.add(file.block(truth["triangle"])),
        "largestDistance": largest, "distance": packer.add(coarser(numpy.rint(shares * 65534).astype(numpy.uint16), detail.bits)),
        "noted": {"steps": packer.add(noted_steps), "probes": packer.add(file.block(noted["probes"])),
                  "truthDistance": packer.add(distance[noted_steps]),
                  "counts": packer.add(file.block(noted["around_counts"])), "around": packer.add(file.block(noted["around"])),
                  "answers": packer.add(usual.reshape(-1))},
        "contestants": [contestant_of(file, row, packer, detail.levels, state, usual) for row in trace["contestants"]],
    }


def usual_answers(file, trace):
    """The bits of what most contestants answered to each noted step: what right ones have in common."""
    asked = [numpy.flatnonzero(file.block(row["noted"]["asked"])) for row in trace["contestants"]]
    answers = [answers_of(file, row) for row in trace["contestants"]]
    usual = numpy.zeros((len(file.block(trace["noted"]["steps"])), ANSWER), numpy.uint64)
    for place in range(len(usual)):
        given = [rows[numpy.searchsorted(places, place)].tobytes() for places, rows in zip(asked, answers) if place in places]
        if given:
            usual[place] = numpy.frombuffer(max(given, key=given.count), numpy.uint64)
    return usual


def answers_of(file, row):
    """A row of bits for each noted step that it was asked."""
    return file.block(row["noted"]["answers"]).view(numpy.uint64).reshape(-1, ANSWER)


def contestant_of(file, row, packer, levels, state, usual):
    steps = steps_of(row["ranges"])
    times, work = times_of(file, row["ns"]), file.block(row["work"]).astype(float)
    coded, low, high = log_levels(times, levels)
    coded_work, low_work, high_work = log_levels(work, levels)
    found, charged = file.block(row["found"]), file.block(row["charged"])
    noted = row["noted"]
    asked = file.block(noted["asked"])
    return {
        "name": row["detector"] + (":" + row["options"] if row["options"] else ""), "repeat": row["repeat"],
        "ranges": row["ranges"], "levels": levels,
        "ns": packer.add(coded), "lowNs": low, "highNs": high,
        "work": packer.add(coded_work), "lowWork": low_work, "highWork": high_work,
        # Against the truth, so that right answers are zeros.
        "differs": packer.add(found ^ (state[steps] >> 1)), "charged": packer.add(charged),
        "wrong": int((charged > 0).sum()),
        "asked": packer.add(asked), "notedNs": packer.add(file.block(noted["ns"]).astype(numpy.float32)),
        # The bits in which they differ from the usual ones.
        "answers": packer.add((answers_of(file, row) ^ usual[asked > 0]).reshape(-1)),
    }


def resolution(levels, replay):
    """By how much a curve's time can be off, at worst, in per cent."""
    widest = max((math.log(row["highNs"] / row["lowNs"]) for trace in replay["traces"] for row in trace["contestants"]),
                 default=0)
    return 100 * (math.exp(widest / (levels - 1) / 2) - 1)
