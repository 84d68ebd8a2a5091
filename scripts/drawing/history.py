"""A detector over recordings: its time as a ratio to a reference detector in the same run, a panel a detector."""
import math

from . import detectors
from .layout import (canvas, label, log_axis, name_panel, telling_words, times, trajectories_of, trajectory_legend,
                     trajectory_mark, what_was_asked)
from .results import NothingToDraw, Unusable, shortened, unique

CERTAIN = 1.96  # standard errors: 95 %
# Nobody's work here changes these; the first that every recording holds.
REFERENCES = ["embree", "aabb-tree", "bullet", "fcl", "brute-force"]


def pictures(runs, reference):
    """(words for the file's name, runs ascending in time, rows a run, reference) of each scene and machine."""
    found = {}
    for run in sorted(runs, key=lambda run: run.moment):
        for scene in unique(row.scene for row in run.rows):
            found.setdefault((run.machine,) + scene, []).append(run)
    found = {key: series for key, series in found.items() if len(series) > 1}
    words = telling_words(found)
    for key, series in found.items():
        rows = [[row for row in run.rows if row.scene == key[1:]] for run in series]
        yield words[key], series, rows, chosen_reference(rows, reference)


def chosen_reference(rows, wanted):
    everywhere = set.intersection(*({row.name for row in some if row.ns_per_query > 0} for some in rows))
    if wanted and wanted not in everywhere:
        raise Unusable(f"--reference {shortened(wanted)}: not timed in every recording")
    return wanted or next((name for name in REFERENCES if name in everywhere), None)


def ratio(row, reference):
    """Over the reference in the same run, on the same trajectory, and the relative standard error of that."""
    below = reference.get(row.trajectory)
    if below is None or not row.ns_per_query > 0:
        return None
    return row.ns_per_query / below.ns_per_query, math.hypot(relative_error(row), relative_error(below))


def relative_error(row):
    """Standard error: from the interval, or of a median of n repetitions with this median deviation, were they normal; 0
    where it is not known."""
    if row.low > 0 and row.high > 0:
        return math.log(row.high / row.low) / (2 * CERTAIN)
    if not (row.ns_per_query_mad >= 0 and row.repetitions > 1):
        return 0.0
    return 1.253 * 1.483 * row.ns_per_query_mad / math.sqrt(row.repetitions) / row.ns_per_query


def draw_history(plt, series, rows, reference):
    if reference is None:
        raise NothingToDraw("the recordings share no detector to compare with; --reference names one")
    every = [row for some in rows for row in some]
    trajectories = trajectories_of(every)
    points = {}  # by detector and trajectory: (recording, ratio, error)
    for k, some in enumerate(rows):
        below = {row.trajectory: row for row in some if row.name == reference and row.ns_per_query > 0}
        for row in some:
            of_reference = ratio(row, below)
            if of_reference and row.name != reference:
                points.setdefault(row.name, {}).setdefault(row.trajectory, []).append((k, *of_reference))
    names = [name for name in detectors.in_order(points) if any(len(line) > 1 for line in points[name].values())]
    if not names:
        raise NothingToDraw(f"no detector beside {reference} was timed in two recordings")
    columns = min(3, len(names))
    figure, panels = canvas(plt, len(names), 3.7, 1.75, left=1.0, bottom=1.95, gap=(0.7, 0.42), share_y=False,
                            columns=columns)
    for axes, name in zip(panels, names):
        draw_panel(axes, points[name], trajectories, detectors.colour(name))
        name_panel(axes, name)
        name_recordings(axes, series)
    for axes in panels[max(0, len(names) - columns):]:
        axes.tick_params(axis="x", labelbottom=True)
    legend = trajectory_legend(plt, trajectories, linewidth=1)
    label(figure, f"Time of a query over that of {reference} in the same run, by recording: down is better",
          what_was_asked(every), f"{len(series)} recordings, {series[-1].machine}; bars: about 95 %, from the spread of"
          " repetitions within each run", "recording, oldest first; upwards: ratio (log scale)", legend)
    return figure


def draw_panel(axes, lines, trajectories, colour):
    """Bars of trajectories stand beside each other."""
    among = [trajectory for trajectory in trajectories if trajectory in lines]
    ends = []
    for k, trajectory in enumerate(among):
        at, values, errors = zip(*lines[trajectory])
        low = [value * math.exp(-CERTAIN * error) for value, error in zip(values, errors)]
        high = [value * math.exp(CERTAIN * error) for value, error in zip(values, errors)]
        beside = 0.4 * ((k + 0.5) / len(among) - 0.5)
        bars = [value - end for value, end in zip(values, low)], [end - value for value, end in zip(values, high)]
        axes.errorbar([x + beside for x in at], values, bars,
                      linewidth=1, elinewidth=0.8, capsize=1.5, **trajectory_mark(trajectory, trajectories, colour, 5))
        ends += low + high
    room = max(1.1, (max(ends) / min(ends)) ** 0.08)
    log_axis(axes.yaxis, min(ends) / room, max(ends) * room, times)
    axes.axhline(1, color="black", linestyle="--", linewidth=0.8, zorder=0)
    axes.tick_params(labelsize=8)


def name_recordings(axes, series):
    step = -(-len(series) // 12)
    shown = [k for k in range(len(series)) if (len(series) - 1 - k) % step == 0]
    axes.set_xlim(-0.4, len(series) - 0.6)
    axes.set_xticks(shown, [shortened(series[k].name, 22) for k in shown], rotation=35, ha="right",
                    rotation_mode="anchor", fontsize=8)
    axes.grid(axis="x", color="0.92", linewidth=0.6)
