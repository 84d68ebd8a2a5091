"""A made-up recording with steps.bin, written as docs/reference/steps-bin.md says and not as scripts/reporting reads it."""
import csv
import json
import math
import pathlib
import random
import struct
import zlib

SIZES = {"u8": 1, "u16": 2, "u32": 4, "u64": 8, "f64": 8}
RUN_ID = "20261124T000000Z-0000"


class Blocks:
    """The blocks of a file, one behind the other."""

    def __init__(self):
        self.content = b""

    def add(self, items, kind, delta=False):
        size = SIZES[kind]
        numbers = [struct.unpack("<Q", struct.pack("<d", item))[0] if kind == "f64" else int(item) for item in items]
        if delta:
            numbers = [(now - before) % (1 << 8 * size) for before, now in zip([0] + numbers, numbers)]
        planes = b"".join(bytes(number >> (8 * plane) & 0xff for number in numbers) for plane in range(size))
        packed = zlib.compress(planes)
        about = {"offset": len(self.content), "bytes": len(packed), "items": len(numbers), "type": kind, "delta": delta}
        self.content += packed
        return about

    def place(self, points, low, high):
        return [self.add([round(65534 * (point[axis] - low[axis]) / (high[axis] - low[axis])) for point in points], "u16", True)
                for axis in range(3)]


def sphere(rings=12):
    """(vertices, triangles) of a ball of radius 1."""
    vertices = [(math.sin(math.pi * i / rings) * math.cos(math.pi * k / rings), math.sin(math.pi * i / rings) * math.sin(math.pi * k / rings),
                 math.cos(math.pi * i / rings)) for i in range(rings + 1) for k in range(2 * rings)]
    corner = lambda i, k: i * 2 * rings + k % (2 * rings)  # noqa: E731
    triangles = [three for i in range(rings) for k in range(2 * rings)
                 for three in ((corner(i, k), corner(i + 1, k), corner(i + 1, k + 1)), (corner(i, k), corner(i + 1, k + 1), corner(i, k + 1)))]
    return vertices, triangles


class Contestant:
    """Times and answers at each step: right, but for those of `wrong`, which miss the contact."""

    def __init__(self, name, typical_ns, steps, seed, wrong=()):
        draw = random.Random(seed)
        self.detector, _, self.options = name.partition(":")
        self.ns = [typical_ns * math.exp(draw.gauss(0, 0.3)) for _ in range(steps)]
        self.ns[steps // 3] = 20 * typical_ns  # the slowest
        self.wrong = set(wrong)
        self.work = [draw.randrange(10, 200) for _ in range(steps)]

    def slowest(self, count):
        return sorted(range(len(self.ns)), key=lambda step: -self.ns[step])[:count]


def write(folder, contestants, steps, trajectory="slide", mesh="ball"):
    """Leaves results.csv, run.json and steps.bin."""
    folder = pathlib.Path(folder)
    low, high, radius = [-1.1] * 3, [1.1] * 3, 0.05
    angles = [2 * math.pi * step / steps for step in range(steps)]
    points = [(math.cos(angle), math.sin(angle), 0.0) for angle in angles]
    centers = [tuple(1.02 * x for x in point) for point in points]
    vertices, triangles = sphere()
    noted = sorted({step for one in contestants for step in one.slowest(10)} | {step for one in contestants for step in sorted(one.wrong)[:20]})
    blocks = Blocks()
    distances = [1.02 - 1.0] * steps
    trace = {
        "trajectory": trajectory, "query": "nearest", "steps": steps, "radius": radius, "reach": radius, "low": low, "high": high,
        "position": blocks.place(centers, low, high),
        "truth": {"state": blocks.add([3] * steps, "u8"), "triangle": blocks.add([step % len(triangles) for step in range(steps)], "u32", True),
                  "distance": blocks.add(distances, "f64"), "point": blocks.place(points, low, high)},
        "noted": {"steps": blocks.add(noted, "u32", True),
                  "probes": blocks.add([x for step in noted for x in (*centers[step], radius, radius)], "f64"),
                  "around_counts": blocks.add([2] * len(noted), "u32"), "around": blocks.add([0, 1] * len(noted), "u32", True)},
        "contestants": [contestant(blocks, one, noted, steps, distances, points) for one in contestants],
    }
    header = {"schema": 1, "run_id": RUN_ID, "traces": [trace], "mesh": {
        "name": mesh, "triangles": len(triangles), "diagonal": 2 * math.sqrt(3), "low": [-1] * 3, "high": [1] * 3,
        "drawn": {"triangles": len(triangles), "low": low, "high": high, "vertices": blocks.place(vertices, low, high),
                  "corners": blocks.add([corner for three in triangles for corner in three], "u32", True)},
        "near": {"ids": blocks.add([0, 1], "u32"), "corners": blocks.add([0, 1, 2, 0, 2, 3], "u32"),
                 "vertices": blocks.add([0.9, 0, 0, 1, 0.1, 0, 1, 0, 0.1, 0.9, 0, 0.1], "f64")}}}
    text = json.dumps(header).encode()
    (folder / "steps.bin").write_bytes(b"TMSTEPS\n" + struct.pack("<II", 1, len(text)) + text + blocks.content)
    write_results(folder, contestants, steps, trajectory, mesh, len(triangles), radius)


def contestant(blocks, one, noted, steps, distances, points):
    least, most = min(one.ns), max(one.ns)
    levels = [round(65535 * math.log(ns / least) / math.log(most / least)) for ns in one.ns]
    bits = struct.unpack("<Q", struct.pack("<d", distances[0]))[0]
    found = [step not in one.wrong for step in range(steps)]
    answers = [x for step in noted for x in ((distances[step], *points[step], *points[step], 0.0) if found[step] else (0.0,) * 8)]
    return {
        "detector": one.detector, "options": one.options,
        "repeat": f"touchmark query --mesh ball --trajectory slide --detector {one.detector} --steps {steps} --seed 1 --step ",
        "ranges": [[0, steps]], "ns": {"low_ns": least, "high_ns": most, "levels": blocks.add(levels, "u16")},
        "found": blocks.add(found, "u8"), "triangle": blocks.add([0] * steps, "u32"),
        "distance": blocks.add([0 if it else bits * 0 for it in found], "u64"), "work": blocks.add(one.work, "u32"),
        "charged": blocks.add([0 if it else 1 for it in found], "u8"),
        "noted": {"asked": blocks.add([1] * len(noted), "u8"), "ns": blocks.add([one.ns[step] for step in noted], "f64"),
                  "answers": blocks.add(answers, "f64")}}


def write_results(folder, contestants, steps, trajectory, mesh, triangles, radius):
    columns = ["schema", "run_id", "detector", "options", "mesh", "triangles", "trajectory", "query", "steps", "radius", "reach", "guarantee",
               "missed", "false_contacts", "wrong_triangle", "unresolved", "status", "ns_per_query", "ns_p50", "ns_p90", "ns_p99", "ns_p999",
               "ns_max", "max_distance_error", "max_distance_error_of_diagonal", "bytes", "judged", "beyond_bound", "wrong_point", "wrong_normal",
               "malformed", "update_rate_hz"]
    with open(folder / "results.csv", "w", newline="", encoding="utf-8") as file:
        writer = csv.DictWriter(file, columns)
        writer.writeheader()
        for one in contestants:
            ns = sorted(one.ns)
            at = lambda share: ns[max(0, math.ceil(share * steps) - 1)]  # noqa: E731,B023
            writer.writerow({"schema": 1, "run_id": RUN_ID, "detector": one.detector, "options": one.options, "mesh": mesh,
                             "triangles": triangles, "trajectory": trajectory, "query": "nearest", "steps": steps, "radius": radius, "reach": radius,
                             "guarantee": "approximate" if one.wrong else "exact", "missed": len(one.wrong), "false_contacts": 0, "wrong_triangle": 0,
                             "unresolved": 0, "status": "ok", "ns_per_query": f"{sum(ns) / steps:.6g}", "ns_p50": f"{at(0.5):.6g}",
                             "ns_p90": f"{at(0.9):.6g}", "ns_p99": f"{at(0.99):.6g}", "ns_p999": f"{at(0.999):.6g}", "ns_max": f"{ns[-1]:.6g}",
                             "max_distance_error": 3e-17, "max_distance_error_of_diagonal": 1e-17, "bytes": 1e6, "judged": steps,
                             "beyond_bound": 0, "wrong_point": 0, "wrong_normal": 0, "malformed": 0, "update_rate_hz": 1e6})
    about = {"schema": 1, "run_id": RUN_ID, "cpu": "made up", "cores": 2, "commit": "0" * 12, "command_line": ["bench", "--mesh", "ball"],
             "steadiness": [{"mesh": "ball", "trajectory": trajectory, "query": "nearest", "disturbed_share": 0.01, "conclusive": True}]}
    (folder / "run.json").write_text(json.dumps(about), encoding="utf-8")
