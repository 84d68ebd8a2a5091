#!/usr/bin/python3
"""Draws the pictures of docs/algorithms/ from what the program answers.

From scripts/:  python3 -m drawing.algorithms --program ../build/release/bin/touchmark --coarse bunny-902.ply \\
                    --results ../results/MACHINE/RUN/results.csv --out ../docs/pictures
"""
import argparse
import csv
import json
import pathlib
import subprocess
import tempfile

import numpy

from . import detectors, layout, raster

INK, PALE = "#202020", "0.8"
METHODS = {"butterfly": "#b0508c", "catmull-clark-linear": "#555555", "mid-point": "#3f97d0", "loop": "#c04a00",
           "ls3": "#008060"}


class Program:
    """The touchmark program, with a folder for what goes in and out."""

    def __init__(self, path, folder):
        self.path, self.folder = pathlib.Path(path).resolve(), folder

    def run(self, *arguments):
        return subprocess.run([self.path, *map(str, arguments)], cwd=self.folder, check=True, stdout=subprocess.PIPE,
                              stderr=subprocess.PIPE).stdout

    def motion(self, points):
        path = self.folder / "points.csv"
        numpy.savetxt(path, points, delimiter=",", header="x,y,z", comments="")
        return path

    def query(self, mesh, points, detector="sphere-cluster"):
        """A row for each point of a motion."""
        answers = self.folder / "answers.csv"
        self.run("query", "--mesh", mesh, "--trajectory", self.motion(points), "--detector", detector, "--reach", "inf",
                 "--steps", len(points), "--csv", answers)
        with open(answers, encoding="utf-8", newline="") as file:
            return list(csv.DictReader(file))

    def visits(self, mesh, points, detector):
        """What a query looked at in each point of a motion: docs/reference/visited-json.md."""
        return json.loads(self.run("query", "--mesh", mesh, "--trajectory", self.motion(points), "--detector", detector,
                                   "--steps", len(points), "--visits", ",".join(map(str, range(len(points))))))

    def mesh(self, mesh, method="mid-point", levels=0):
        """Triangles (n, 3, 3) of a mesh after `levels` subdivisions."""
        self.run("mesh", "subdivide", "--mesh", mesh, "--method", method, "--levels", levels, "--output", "out.off")
        return raster.corners_in(self.folder / "out.off")


def write_off(path, triangles):
    positions, corners = numpy.unique(triangles.reshape(-1, 3), axis=0, return_inverse=True)
    lines = [f"OFF\n{len(positions)} {len(triangles)} 0"]
    lines += [" ".join(map(repr, map(float, p))) for p in positions]
    lines += ["3 " + " ".join(map(str, t)) for t in corners.reshape(-1, 3)]
    path.write_text("\n".join(lines) + "\n", encoding="utf-8")


def section(triangles, axis, at):
    """The segments in which the plane through `at` across the axis cuts the triangles, in the other two axes."""
    rest = [k for k in range(3) if k != axis]
    segments = []
    over = triangles[:, :, axis] - at
    for t, h in zip(triangles[(over.min(axis=1) < 0) & (over.max(axis=1) > 0)],
                    over[(over.min(axis=1) < 0) & (over.max(axis=1) > 0)]):
        ends = [t[i] + (t[j] - t[i]) * h[i] / (h[i] - h[j]) for i, j in ((0, 1), (1, 2), (2, 0)) if h[i] * h[j] < 0]
        if len(ends) == 2:
            segments.append([ends[0][rest], ends[1][rest]])
    return segments


def draw_lines(axes, segments, **look):
    from matplotlib import collections
    axes.add_collection(collections.LineCollection(segments, **{"colors": INK, "linewidths": 1, **look}))


def plain_axes(axes, title, low, high):
    axes.set_title(title, fontsize=10)
    axes.set_xlim(low[0], high[0])
    axes.set_ylim(low[1], high[1])
    axes.set_aspect("equal")
    axes.set_xticks([])
    axes.set_yticks([])


def plane_points(low, high, pixels, axis, at):
    """A square lattice of points in the plane, row by row from below."""
    x, y = numpy.meshgrid(numpy.linspace(low[0], high[0], pixels), numpy.linspace(low[1], high[1], pixels))
    return numpy.insert(numpy.stack([x.ravel(), y.ravel()], axis=1), axis, at, axis=1)


def draw_grid_group(plt, program, mesh):
    program.run("paper", "park-jang-2018", "--mesh", mesh, "--quick", "--out", "groups")
    read = lambda name: numpy.loadtxt(program.folder / "groups/pictures" / name, delimiter=",", skiprows=1, ndmin=2)
    boxes, hip, triangles = read("cube-groups.csv"), read("hip.csv")[0], read("original-mesh.csv").reshape(-1, 3, 3)
    outline = numpy.array(section(triangles, 2, hip[2]))
    from matplotlib import collections
    figure, panels = plt.subplots(1, 3, figsize=(10.3, 4.3))

    def rectangles(axes, drawn, colour, **look):
        for box in drawn:
            if box[2] <= hip[2] <= box[5]:
                axes.add_patch(plt.Rectangle(box[:2], box[3] - box[0], box[4] - box[1],
                                             **{"facecolor": "none", "edgecolor": colour, "linewidth": 0.8, **look}))

    rectangles(panels[0], boxes, "#c04a00", facecolor="#c04a0020")
    draw_lines(panels[0], outline)
    panels[0].plot(*hip[:2], "o", color="#0060a8")
    ends, room = outline.reshape(-1, 2), 0.05
    plain_axes(panels[0], f"As published: the cuboids that this plane\ncuts, of {len(boxes)} groups. Every query tests\n"
               "the HIP (dot) against all.", ends.min(axis=0) - room, ends.max(axis=0) + room)

    # Each step is far from the last, so that a query finds its cell.
    hips = numpy.random.default_rng(3).permutation(numpy.insert(outline.mean(axis=1), 2, hip[2], axis=1))
    found = {0: [], 1: []}
    for step in program.visits(mesh, hips, "grid-group"):
        if "cells" not in step or "groups" not in step:
            continue
        *box, covers, members = step["groups"][0]
        group = numpy.all((triangles >= box[:3]) & (triangles <= box[3:]), axis=(1, 2))
        if group.sum() == members:  # no other triangle lies in the group's box
            found[covers].append((step, triangles[group]))
    titles = {1: "Ours: the group of the HIP's cell answers.\n{} of its {} triangles are measured (dark).",
              0: "Ours: the cell's group does not cover the HIP.\n{2} boxes are asked, {3} entered (solid);\n{0} triangles are measured (dark)."}
    for axes, covers in zip(panels[1:], titles):
        step, group = max(found[covers], key=lambda one: len(one[0]["triangles"]))
        cell, at, measured = step["cells"][0], hips[step["step"]][:2], triangles[step["triangles"]]
        edge, side = cell[3] - cell[0], 3.6 * (cell[3] - cell[0])
        low, high = at - side / 2, at + side / 2
        for number in range(-4, 5):
            axes.axvline(cell[0] + number * edge, color=PALE, linewidth=0.8, zorder=0)
            axes.axhline(cell[1] + number * edge, color=PALE, linewidth=0.8, zorder=0)
        rectangles(axes, [cell], "#c04a00", facecolor="#c04a0020", linewidth=1.5)
        for drawn, face in ((group, "#0060a830"), (measured, "#0060a8")):
            axes.add_collection(collections.PolyCollection(drawn[:, :, :2], facecolors=face, edgecolors="#0060a8",
                                                           linewidths=0.6))
        asked = step.get("boxes", [])
        entered = [box for box in asked if box[6]]
        rectangles(axes, [box for box in asked if not box[6]], "#008060", linestyle=":", linewidth=1)
        rectangles(axes, entered, "#008060", linewidth=1.5)
        draw_lines(axes, outline, linewidths=1.5)
        axes.plot(*at, "o", color="#c04a00", markersize=5)
        plain_axes(axes, titles[covers].format(len(measured), len(group), len(asked), len(entered)), low, high)
    return figure


def draw_sphere_cluster(plt, program, coarse):
    program.run("paper", "choi-sung-2017", "--mesh", coarse, "--quick", "--out", "spheres")
    folder = program.folder / "spheres/pictures"
    turned = [2, 1, 0]  # seen from the side
    spheres = numpy.loadtxt(folder / "original-0-clustered.csv", delimiter=",", skiprows=1)[:, [*turned, 3]]
    triangles = numpy.loadtxt(folder / "original-0-mesh.csv", delimiter=",", skiprows=1).reshape(-1, 3, 3)[:, :, turned]
    corners = triangles.reshape(-1, 3)
    at = float(numpy.median(corners[:, 2])) + 0.02
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 5.2))
    outline = section(triangles, 2, at)
    ends = numpy.array(outline).reshape(-1, 2)
    for x, y, z, radius in spheres[numpy.abs(spheres[:, 2] - at) < spheres[:, 3]]:
        left.add_patch(plt.Circle((x, y), numpy.sqrt(radius**2 - (z - at)**2), facecolor="#0060a818", edgecolor="#0060a8",
                                  linewidth=0.6))
    draw_lines(left, outline)
    room = 0.12
    low, high = ends.min(axis=0) - (room, 2.5 * room), ends.max(axis=0) + room
    plain_axes(left, f"As published: the spheres that this\nplane cuts, of {len(spheres)}. Every query tests all.", low, high)

    radius = 0.005 * numpy.linalg.norm(numpy.ptp(corners, axis=0))
    start, end = numpy.array([ends[:, 0].min() - 0.9, ends[:, 1].max() * 0.75]), ends[numpy.argmax(ends[:, 1])]
    steps = numpy.linspace(0, 1, 400)[:, None]
    path = (1 - steps) * start + steps * end + numpy.stack([numpy.zeros(400), 0.25 * numpy.sin(3 * numpy.pi * steps[:, 0])], axis=1)
    answers = program.query(coarse, numpy.insert(path, 2, at, axis=1)[:, turned])
    distance = numpy.array([float(answer["distance"]) for answer in answers])
    touching = numpy.array([answer["touching"] == "1" for answer in answers])
    known, searches = 0, []
    for step, place in enumerate(path):
        if searches and numpy.linalg.norm(place - path[known]) < distance[known] - radius:
            continue
        known = step
        searches.append(step)
    for step in searches:
        if distance[step] > radius:
            right.add_patch(plt.Circle(path[step], distance[step] - radius, facecolor="#00806012", edgecolor="#008060", linewidth=0.8))
    draw_lines(right, outline)
    right.plot(*path.T, color="#c04a00", linewidth=1)
    right.plot(*path[searches].T, ".", color="#c04a00", markersize=5)
    free = int((~touching).sum())
    plain_axes(right, f"Ours: a probe comes near in {len(path)} ticks. Within a circle nothing\ncan be touched: "
               f"of {free} ticks in free space {sum(not touching[s] for s in searches)} (dots) search.",
               numpy.minimum(path.min(axis=0), ends.min(axis=0)) - room, numpy.maximum(path.max(axis=0), ends.max(axis=0)) + room)
    return figure


def draw_work(plt, results):
    """What a query looks at, as recorded: boxes, spheres, groups and triangles."""
    shown = {("aabb-tree", ""): "aabb-tree", ("grid-group", ""): "grid-group", ("sphere-cluster", ""): "sphere-cluster",
             ("grid-group", "lookup=scan"): "grid-group as published",
             ("sphere-cluster", "lookup=scan"): "sphere-cluster as published", ("brute-force", ""): "brute-force"}
    with open(results, encoding="utf-8", newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["query"] == "nearest" and (row["detector"], row["options"]) in shown]
    trajectories = list(dict.fromkeys(row["trajectory"] for row in rows))
    figure, axes = plt.subplots(figsize=(9, 4.2))
    width = 0.8 / len(shown)
    for number, ((detector, options), name) in enumerate(shown.items()):
        found = {row["trajectory"]: max(float(row["work_mean"]), 0.01) for row in rows
                 if (row["detector"], row["options"]) == (detector, options)}
        colour = detectors.KINDS.get(name, detectors.KINDS[detector])[0]
        places = [place + (number - len(shown) / 2 + 0.5) * width for place, t in enumerate(trajectories) if t in found]
        axes.bar(places, [found[t] for t in trajectories if t in found], width, label=name, color=colour, edgecolor=colour,
                 fill="published" not in name, hatch="//" if "published" in name else None)
    axes.set_yscale("log")
    axes.set_ylim(0.01, 3e6)
    powers = range(-2, 7)
    axes.set_yticks([10.0**power for power in powers], [layout.plain(10.0**power) for power in powers])
    axes.set_xticks(range(len(trajectories)), trajectories)
    axes.set_ylabel("boxes, spheres, groups and triangles\na query looks at (mean)")
    axes.set_title(f"{rows[0]['mesh']}, {int(rows[0]['triangles']):,} triangles, nearest within 0.5 %: on hover ours hardly "
                   "look at all", fontsize=10)
    axes.legend(ncols=3, fontsize=8, loc="upper center")
    axes.grid(axis="y", color="0.9", linewidth=0.6)
    axes.set_axisbelow(True)
    return figure


def draw_sign(plt, program):
    ball = program.mesh("icosphere:4")
    holed = ball[ball.mean(axis=1)[:, 1] < 0.8]
    write_off(program.folder / "holed.off", holed)
    colours = {"outside": (1, 1, 1), "inside": (0.75, 0.85, 0.95), "undecided": (0.98, 0.85, 0.72), "on_surface": (0.2, 0.2, 0.2)}
    figure, panels = plt.subplots(1, 2, figsize=(10, 5.2))
    pixels, low, high = 220, numpy.array([-1.5, -1.5]), numpy.array([1.5, 1.5])
    for axes, mesh, triangles, title in ((panels[0], "icosphere:4", ball, "A closed mesh: decided everywhere"),
                                         (panels[1], "holed.off", holed, "The same with a hole: undecided (orange) where\nthe hole is nearest, or the winding number is unclear")):
        answers = program.query(mesh, plane_points(low, high, pixels, 2, 0.01), detector="sphere-cluster:side=on")
        image = numpy.array([colours[answer["side"]] for answer in answers]).reshape(pixels, pixels, 3)
        axes.imshow(image, origin="lower", extent=(low[0], high[0], low[1], high[1]), interpolation="nearest")
        draw_lines(axes, section(triangles, 2, 0.01), linewidths=1.5)
        plain_axes(axes, title, low, high)
    return figure


def draw_subdivision(plt, program):
    figure, (left, right) = plt.subplots(1, 2, figsize=(11, 5.2))
    coarse = program.mesh("icosphere:0")
    for axes in (left, right):
        draw_lines(axes, section(coarse, 2, 0.01), colors="0.6", linewidths=4, label="the icosahedron")
    for method, colour in METHODS.items():
        fine = program.mesh("icosphere:0", method, 4)
        dashed = "--" if method == "mid-point" else "-"
        for axes in (left, right):
            draw_lines(axes, section(fine, 2, 0.01), colors=colour, linewidths=1.4, linestyles=dashed,
                       label=f"{method}, {len(fine):,} triangles")
    angle = numpy.linspace(0, 2 * numpy.pi, 400)
    for axes in (left, right):
        axes.plot(numpy.cos(angle), numpy.sin(angle), ":", color=INK, linewidth=1, label="the sphere through its corners")
    plain_axes(left, "An icosahedron and its fourth level, cut by a plane", (-1.1, -1.1), (1.1, 1.1))
    left.legend(fontsize=8, loc="center")
    plain_axes(right, "Part of it, closer", (0.55, 0.25), (1.05, 0.75))
    return figure


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--program", required=True, type=pathlib.Path)
    parser.add_argument("--mesh", default="bunny", help="the mesh whose groups are shown")
    parser.add_argument("--coarse", required=True, type=pathlib.Path, help="a coarse mesh file, whose spheres can be told apart")
    parser.add_argument("--results", required=True, type=pathlib.Path, help="the results.csv of a recorded comparison")
    parser.add_argument("--out", required=True, type=pathlib.Path)
    parser.add_argument("--only", nargs="*", help="names of pictures")
    arguments = parser.parse_args()
    plt = layout.load_pyplot()
    with tempfile.TemporaryDirectory() as folder:
        program = Program(arguments.program, pathlib.Path(folder))
        pictures = {"grid_group": lambda: draw_grid_group(plt, program, arguments.mesh),
                    "sphere_cluster": lambda: draw_sphere_cluster(plt, program, arguments.coarse.resolve()),
                    "work": lambda: draw_work(plt, arguments.results),
                    "sign": lambda: draw_sign(plt, program),
                    "subdivision": lambda: draw_subdivision(plt, program)}
        arguments.out.mkdir(parents=True, exist_ok=True)
        for name, picture in pictures.items():
            if arguments.only and name not in arguments.only:
                continue
            figure = picture()
            figure.tight_layout()
            figure.savefig(arguments.out / f"{name}.png", dpi=110, bbox_inches="tight")
            plt.close(figure)


if __name__ == "__main__":
    main()
