"""Time against the mesh's size, mean and 99.9 %: rows of several meshes, of one run or of several."""
import math
import statistics

from . import detectors
from .layout import (MEAN_AND_P999, P999_MISSING, canvas, count, duration, label, legend_height, log_axis, name_panel,
                     p999_remark, telling_words, trajectories_of, what_was_asked)
from .results import NothingToDraw, positive, shortened, unique

DEADLINE_NS = 1e6
DEADLINE_LINE = {"linestyle": (0, (6, 3)), "linewidth": 0.9}


def families(meshes):
    """icosphere:4 and icosphere:6 are two sizes of one thing; meshes that stand alone are taken together."""
    kinds = {mesh.partition(":")[0] for mesh in meshes if ":" in mesh}
    bare = {mesh: mesh.partition(":")[0].partition("@")[0] for mesh in meshes}
    return {mesh: kind if kind in kinds else "" for mesh, kind in bare.items()}


def pictures(runs):
    """(words for the file's name, rows, source) of each picture. Times of different machines never share one."""
    rows_by_key = {}
    family = families({row.mesh for run in runs for row in run.rows})
    for run in sorted(runs, key=lambda run: run.moment):
        for row in run.rows:
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
    legend = [plt.Line2D([], [], label=shortened(name), **detectors.mark(name), **detectors.line(name)) for name in names]
    legend.append(plt.Line2D([], [], color="black", label="1 ms: a 1 kHz tick is over", **DEADLINE_LINE))
    figure, panels = canvas(plt, 2 * len(trajectories), 4.0, 3.0, left=0.85, gap=(0.5, 0.6), columns=2,
                            bottom=0.5 + legend_height(legend, 9.3))
    times = positive(getattr(row, column) for row in rows if row.name in names for column, _ in MEAN_AND_P999)
    spans = sizes(rows)
    for k, axes in enumerate(panels):
        trajectory, (column, what) = trajectories[k // 2], MEAN_AND_P999[k % 2]
        name_panel(axes, f"{shortened(trajectory, 30)}: {what}")
        drawn = [draw_sizes(axes, name, [row for row in rows if row.name == name and row.trajectory == trajectory], column)
                 for name in names]
        if not any(drawn):
            axes.text(0.5, 0.5, P999_MISSING, transform=axes.transAxes, ha="center", fontsize=9, style="italic", color="0.3")
        axes.axhline(DEADLINE_NS, color="black", **DEADLINE_LINE)
        log_axis(axes.xaxis, spans[0] / 1.5, spans[-1] * 1.5, count)
        log_axis(axes.yaxis, min(times) / 2, max(times + [DEADLINE_NS]) * 2, duration)
    label(figure, "Time of a query against the mesh's size: down is better", what_was_asked(rows), source,
          "triangles (log scale); upwards: time for one query, its mean and what 99.9 % of the steps take at most (log scale)",
          legend, p999_remark(rows))
    return figure


def draw_sizes(axes, name, rows, column):
    """A mark a size, and whether there is any. The line breaks at a size whose rows lack this time."""
    medians = []
    for size in sizes(rows):
        values = positive(getattr(row, column) for row in rows if row.triangles == size)
        medians.append(statistics.median(values) if values else math.nan)
    axes.plot(sizes(rows), medians, **detectors.mark(name), **detectors.line(name))
    return any(map(math.isfinite, medians))
