"""Time against the mesh's size: rows of several meshes, of one run or of several."""
import math
import statistics

from . import detectors, groups
from .layout import (canvas, count, detector_legend, duration, label, log_axis, name_panel, telling_words, trajectories_of,
                     what_was_asked)
from .results import NothingToDraw, positive, shortened, unique
from .time_error import room_for_legend

DEADLINE_NS = 1e6


def families(meshes):
    """icosphere:4 and icosphere:6 are two sizes of one thing; meshes that stand alone are taken together."""
    kinds = {mesh.partition(":")[0] for mesh in meshes if ":" in mesh}
    bare = {mesh: mesh.partition(":")[0].partition("@")[0] for mesh in meshes}
    return {mesh: kind if kind in kinds else "" for mesh, kind in bare.items()}


def pictures(runs):
    """(words for the file's name, rows, source) of each picture. Times of different machines never share one; runs over
    the number of groups have a picture of their own."""
    rows_by_key = {}
    family = families({row.mesh for run in runs for row in run.rows})
    for run in sorted(runs, key=lambda run: run.moment):
        for row in groups.others(run.rows):
            if row.ns_per_query > 0 and 0 < row.triangles < math.inf:
                rows_by_key.setdefault((run.machine, row.query, family[row.mesh]), []).append((run, row))
    found = {}
    for key, measured in rows_by_key.items():
        for radius_key, subset in by_radius(measured).items():
            if len(sizes([row for _, row in subset])) > 1:
                found[key + radius_key] = subset
    words = telling_words(found)
    for key, measured in found.items():
        used = unique(run.source for run, _ in measured)
        source = used[0] if len(used) == 1 else f"{len(used)} runs, {measured[-1][0].machine}"
        yield words[key], latest(measured), source


def by_radius(measured):
    """One radius a mesh is usual (a share of its size, so others for other meshes); else a picture a radius."""
    radii = {}
    for _, row in measured:
        radii.setdefault(row.mesh, set()).add(row.radius)
    if all(len(some) == 1 for some in radii.values()):
        return {("",): measured}
    parts = {}
    for run, row in measured:
        parts.setdefault((row.radius,), []).append((run, row))
    return parts


def sizes(rows):
    return sorted(unique(row.triangles for row in rows))


def latest(measured):
    """Of what was measured several times, the latest counts."""
    rows = {}
    for _, row in measured:
        rows[row.name, row.trajectory, row.triangles, row.mesh] = row
    return list(rows.values())


def draw_mesh_size(plt, rows, source):
    trajectories = trajectories_of(rows)
    everyone = detectors.in_order(row.name for row in rows)
    names = [name for name in everyone if any(len(sizes(r for r in rows if r.name == name and r.trajectory == t)) > 1
                                              for t in trajectories)]
    if not names:
        raise NothingToDraw("no detector was timed on meshes of several sizes")
    lines = -(-len(trajectories) // 2)
    height = max(4.3, 0.21 * (len(names) + 1) / lines)
    figure, panels = canvas(plt, len(trajectories), 4.3, height, right=room_for_legend(names), left=0.95, gap=(0.2, 0.6),
                            columns=min(2, len(trajectories)))
    times = positive(row.ns_per_query for row in rows if row.name in names)
    spans = sizes(rows)
    for axes, trajectory in zip(panels, trajectories):
        for name in names:
            mine = {}
            for row in rows:
                if row.name == name and row.trajectory == trajectory:
                    mine.setdefault(row.triangles, []).append(row.ns_per_query)
            axes.plot(sorted(mine), [statistics.median(mine[size]) for size in sorted(mine)], **detectors.mark(name),
                      **detectors.line(name))
        axes.axhline(DEADLINE_NS, color="black", linestyle=(0, (6, 3)), linewidth=0.9)
        name_panel(axes, shortened(trajectory, 40))
        log_axis(axes.xaxis, spans[0] / 1.5, spans[-1] * 1.5, count)
        log_axis(axes.yaxis, min(times) / 2, max(times + [DEADLINE_NS]) * 2, duration)
    deadline = plt.Line2D([], [], color="black", linestyle=(0, (6, 3)), linewidth=0.9, label="1 ms: a 1 kHz tick is over")
    last = panels[min(len(panels), 2) - 1]
    detector_legend(plt, figure, last, names, extra=[deadline])
    label(figure, "Time of a query against the mesh's size: down is better", what_was_asked(rows), source,
          "triangles (log scale); upwards: time for one query, mean of a loop (log scale)")
    return figure
