"""A detector over recordings: its mean and 99.9 % as ratios to a reference detector's in the same run, two panels each."""
import math

from . import detectors
from .layout import (MEAN_AND_P999, P999_MISSING, canvas, label, log_axis, name_panel, p999_remark, telling_words, times,
                     trajectories_of, trajectory_legend, trajectory_mark, what_was_asked)
from .results import NothingToDraw, Unusable, finite, shortened, unique

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


def p999_ratio(row, below):
    """Over the reference's row, NaN where either lacks the 99.9 %."""
    return row.ns_p999 / below.ns_p999 if row.ns_p999 > 0 and below.ns_p999 > 0 else math.nan


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
    points = {}  # by detector and trajectory: (recording, ratio, error, ratio of the 99.9 %)
    for k, some in enumerate(rows):
        below = {row.trajectory: row for row in some if row.name == reference and row.ns_per_query > 0}
        for row in some:
            of_reference = ratio(row, below)
            if of_reference and row.name != reference:
                points.setdefault(row.name, {}).setdefault(row.trajectory, []).append(
                    (k, *of_reference, p999_ratio(row, below[row.trajectory])))
    names = [name for name in detectors.in_order(points) if any(len(line) > 1 for line in points[name].values())]
    if not names:
        raise NothingToDraw(f"no detector beside {reference} was timed in two recordings")
    columns = min(4, 2 * len(names))
    figure, panels = canvas(plt, 2 * len(names), 1.95, 1.6, left=0.75, bottom=1.95, gap=(0.7, 0.6), share_y=False,
                            columns=columns, top=1.5)
    for k, name in enumerate(names):
        draw_detector(panels[2 * k:2 * k + 2], name, points[name], trajectories)
    for axes in panels:
        name_recordings(axes, series)
    for axes in panels[max(0, len(panels) - columns):]:
        axes.tick_params(axis="x", labelbottom=True)
    legend = trajectory_legend(plt, trajectories, linewidth=1)
    source = (f"{len(series)} recordings, {series[-1].machine}; bars: about 95 %, from the spread of repetitions within"
              " each run, known for the mean only")
    label(figure, f"Time of a query over that of {reference} in the same run, by recording: down is better",
          what_was_asked(every), source, "recording, oldest first; upwards: ratio of the means, and of what 99.9 % of the steps"
          " take at most (log scale)", legend, p999_remark(every))
    return figure


def draw_detector(pair, name, lines, trajectories):
    means = {trajectory: [(k, value, error) for k, value, error, _ in line] for trajectory, line in lines.items()}
    slowest = {trajectory: [(k, value, 0.0) for k, *_, value in line] for trajectory, line in lines.items()}
    for axes, shown, (_, what) in zip(pair, (means, slowest), MEAN_AND_P999):
        if any(math.isfinite(value) for line in shown.values() for _, value, _ in line):
            draw_panel(axes, shown, trajectories, detectors.colour(name))
        else:
            axes.set_yticks([])
            axes.text(0.5, 0.5, P999_MISSING, transform=axes.transAxes, ha="center", va="center", fontsize=8,
                      style="italic", color="0.3")
        axes.annotate(what, (0, 1), (0, 3), xycoords="axes fraction", textcoords="offset points", fontsize=9)
    name_panel(pair[0], name)
    pair[0].set_title(pair[0].get_title("left"), loc="left", pad=18, fontsize=10, fontweight="bold")


def draw_panel(axes, lines, trajectories, colour):
    """Bars of trajectories stand beside each other; a line breaks where a value is NaN."""
    among = [trajectory for trajectory in trajectories if trajectory in lines]
    ends = []
    for k, trajectory in enumerate(among):
        at, values, errors = zip(*lines[trajectory])
        low = [value * math.exp(-CERTAIN * error) for value, error in zip(values, errors)]
        high = [value * math.exp(CERTAIN * error) for value, error in zip(values, errors)]
        beside = 0.4 * ((k + 0.5) / len(among) - 0.5)
        bars = [value - end for value, end in zip(values, low)], [end - value for value, end in zip(values, high)]
        axes.errorbar([x + beside for x in at], values, bars if any(errors) else None,
                      linewidth=1, elinewidth=0.8, capsize=1.5, **trajectory_mark(trajectory, trajectories, colour, 5))
        ends += finite(low + high)
    room = max(1.1, (max(ends) / min(ends)) ** 0.08)
    log_axis(axes.yaxis, min(ends) / room, max(ends) * room, times)
    axes.axhline(1, color="black", linestyle="--", linewidth=0.8, zorder=0)
    axes.tick_params(labelsize=8)


def name_recordings(axes, series):
    step = -(-len(series) // 8)
    shown = [k for k in range(len(series)) if (len(series) - 1 - k) % step == 0]
    axes.set_xlim(-0.4, len(series) - 0.6)
    axes.set_xticks(shown, [shortened(series[k].name, 22) for k in shown], rotation=35, ha="right",
                    rotation_mode="anchor", fontsize=8)
    axes.grid(axis="x", color="0.92", linewidth=0.6)
