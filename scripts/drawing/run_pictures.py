"""One scene of one run: latency, update rate, errors. A line a detector, those that have no numbers with the reason."""
import collections
import math
import statistics

from . import detectors
from .layout import (canvas, duration, label, log_axis, name_axis, name_panel, note, percent, rate,
                     room_for, spread, tinted, trajectories_of, trajectory_legend, trajectory_mark, what_was_asked)
from .results import NothingToDraw, finite, positive, shortened

PERCENTILES = [  # column, label, marker, how much of the colour: told apart by shape, so that grey print will do
    ("ns_p50", "median", "|", 1.0),
    ("ns_per_query", "mean", "x", 1.0),
    ("ns_p90", "90 %", ".", 1.0),
    ("ns_p99", "99 %", "o", 0.0),
    ("ns_p999", "99.9 %", "D", 1.0),
    ("ns_max", "maximum", ">", 1.0),
]
COLD = [
    ("ns_p50", "median, warm", "|", 1.0),
    ("cold_l2_ns_p50", "median, second-level cache emptied", "o", 0.0),
    ("cold_ns_p50", "median, all caches emptied", "D", 1.0),
    ("cold_ns_p99", "99 %, all caches emptied", "x", 1.0),
]
Kind = collections.namedtuple("Kind", "columns label hatch shade")
ERRORS = [
    Kind(["missed"], "missed contacts", "////", "0.35"),
    Kind(["false_contacts"], "false contacts", "....", "0.75"),
    Kind(["wrong_triangle"], "wrong triangle", "xxxx", "0.95"),
    Kind(["beyond_tolerance"], "distance off by more than 1e-6 of the diagonal", "", "0.1"),
    Kind(["rounding"], "distance off by rounding, less than that", "\\\\\\\\", "1.0"),
    Kind(["beyond_bound"], "distance worse than declared", "oo", "0.6"),
    Kind(["wrong_point", "wrong_normal", "malformed"], "wrong point or normal, no number", "---", "0.85"),
    Kind(["unresolved"], "unresolved (within the declared accuracy)", "", "1.0"),
]
DEADLINE_NS = 1e6  # 1 kHz, what a haptic loop is held to


def percentile_panels(plt, rows, percentiles, ends):
    """The figure, a panel a trajectory, and the legend of the marks. ends: times that the axes must hold."""
    names, trajectories = detectors.in_order(row.name for row in rows), trajectories_of(rows)
    figure, panels = canvas(plt, len(trajectories), 3.1, 0.27 * len(names), left=room_for(names))
    for axes, trajectory in zip(panels, trajectories):
        for row in (row for row in rows if row.trajectory == trajectory):
            draw_percentiles(axes, names.index(row.name), row, percentiles)
        name_panel(axes, shortened(trajectory, 40))
        log_axis(axes.xaxis, min(ends) / 2, max(ends) * 3, duration)
        name_axis(axes, names)
    return figure, panels, [plt.Line2D([], [], linewidth=1, label=which, **percentile_mark(marker, "0.2", strength))
                            for _, which, marker, strength in percentiles]


def draw_latency(plt, rows, source):
    times = positive(getattr(row, column) for row in rows for column, *_ in PERCENTILES)
    if not times:
        raise NothingToDraw("no row has times")
    clock = positive(row.clock_cost_ns for row in rows)
    ends = times + [DEADLINE_NS] + clock
    figure, panels, legend = percentile_panels(plt, rows, PERCENTILES, ends)
    for axes in panels:
        axes.axvline(DEADLINE_NS, color="black", linestyle="--", linewidth=1)
        if clock:
            axes.axvline(statistics.median(clock), color="black", linestyle=":", linewidth=1)
    legend.append(plt.Line2D([], [], color="black", linestyle="--", linewidth=1, label="1 ms: a 1 kHz tick is over"))
    if clock:
        legend.append(plt.Line2D([], [], color="black", linestyle=":", linewidth=1,
                                 label=f"{duration(statistics.median(clock))}: the clock, part of every time"))
    label(figure, "Latency of one query: left is better", what_was_asked(rows), source, "time for one query (log scale)",
          legend)
    return figure


def has_cold(rows):
    return any(row.cold_ns_p50 > 0 for row in rows)


def draw_cold(plt, rows, source):
    if not has_cold(rows):
        raise NothingToDraw("no row has times with emptied caches: touchmark bench --cold")
    times = positive(getattr(row, column) for row in rows for column, *_ in COLD)
    figure, _, legend = percentile_panels(plt, rows, COLD, times)
    label(figure, "Queries with emptied caches: left is better", what_was_asked(rows), source,
          "time for one query, the clock's own included (log scale)", legend)
    return figure


def percentile_mark(marker, colour, strength):
    return {"marker": marker, "color": colour, "markersize": 11 if marker == "|" else 5,
            "markeredgewidth": 2 if marker == "|" else 1, "markerfacecolor": tinted(colour, strength)}


def draw_percentiles(axes, y, row, percentiles):
    colour = detectors.colour(row.name)
    points = [(getattr(row, column), marker, strength) for column, _, marker, strength in percentiles]
    points = [point for point in points if math.isfinite(point[0]) and point[0] > 0]
    if not points:
        note(axes, y, shortened(row.status) or "no times")
        return
    axes.plot([points[0][0], points[-1][0]], [y, y], color=colour, alpha=0.5, linewidth=1.2, zorder=1)
    for time, marker, strength in points:
        axes.plot(time, y, linestyle="", zorder=2, **percentile_mark(marker, colour, strength))


def draw_update_rate(plt, rows, source):
    rates = positive(row.update_rate_hz for row in rows)
    if not rates:
        raise NothingToDraw("no row has an update rate")
    names, trajectories = detectors.in_order(row.name for row in rows), trajectories_of(rows)
    slowest = positive(1e9 / row.ns_p999 for row in rows if row.ns_p999 > 0)
    low, high = min(rates + slowest + [1000]) / 3, max(rates + [1000]) * 3
    timed, levels = {}, {}  # marks that would meet stand below each other
    for name in names:
        timed[name] = sorted((row for row in rows if row.name == name and row.update_rate_hz > 0),
                             key=lambda row: row.update_rate_hz)
        levels[name] = spread([row.update_rate_hz for row in timed[name]], math.log(high / low), 0.014)
    height = max(0.33, 0.1 * (2 + max(map(max, filter(None, levels.values())))))  # inches
    figure, (axes,) = canvas(plt, 1, 7.5, height * len(names), left=room_for(names))
    for y, name in enumerate(names):
        for row, level in zip(timed[name], levels[name]):
            line = y + 0.09 / height * (level - max(levels[name]) / 2)
            mark = trajectory_mark(row.trajectory, trajectories, detectors.colour(name), 6.5)
            axes.plot(row.update_rate_hz, line, linestyle="", **mark)
            if row.ns_p999 > 0:
                axes.plot(1e9 / row.ns_p999, line, linestyle="", **{**mark, "markersize": 3.5})
        if not timed[name]:
            note(axes, y, shortened(next(row.status for row in rows if row.name == name)) or "no times")
    deadline = axes.axvline(1000, color="black", linestyle="--", linewidth=1, label="1 kHz: what haptics asks for")
    log_axis(axes.xaxis, low, high, rate)
    name_axis(axes, names)
    legend = trajectory_legend(plt, trajectories, linestyle="")
    legend.append(plt.Line2D([], [], linestyle="", marker="o", markersize=3.5, color="0.2",
                             label="small: at the pace of the slowest 0.1 %"))
    label(figure, "Update rate: right is better", what_was_asked(rows), source, "queries answered in a second (log scale)",
          legend + [deadline])
    return figure


def errors_of(row, kind):
    """A bound that is worse than exact is told of only where the file does not tell the tolerance and rounding apart."""
    if kind.columns == ["beyond_bound"] and row.guarantee != "exact" and math.isfinite(row.beyond_tolerance):
        return 0
    return sum(finite(getattr(row, column) for column in kind.columns))


def failures(rows, name):
    """"crashed in slide, tap; unsupported in edge", or nothing."""
    statuses = {}
    for row in rows:
        if row.name == name and not row.done:
            statuses.setdefault(shortened(row.status) or "no status", []).append(row.trajectory)
    return "; ".join(f"{status} in {', '.join(where)}" for status, where in statuses.items())


def claims_exactness(rows, name):
    return all(row.guarantee == "exact" for row in rows if row.name == name and row.done)


def draw_errors(plt, rows, source):
    names = detectors.in_order(row.name for row in rows)
    wrong = {name: {kind.label: sum(errors_of(row, kind) for row in rows if row.name == name) for kind in ERRORS}
             for name in names}
    lines = max(sum(number > 0 for number in wrong[name].values()) + bool(failures(rows, name)) for name in names)
    lines = max(3, lines)
    figure, (share_axes, size_axes) = canvas(plt, 2, 5.5, 0.13 * lines * len(names), left=room_for(names), share_x=False,
                                             gap=(0.3, 0.55))
    draw_error_shares(share_axes, rows, names, wrong, lines)
    draw_error_sizes(size_axes, rows, names)
    legend = [plt.Rectangle((0, 0), 1, 1, facecolor=kind.shade, edgecolor="black", hatch=kind.hatch, linewidth=0.6,
                            label=kind.label) for kind in ERRORS if any(wrong[name][kind.label] for name in names)]
    label(figure, "Errors against the exact oracle: left is better", what_was_asked(rows), source,
          "all trajectories together", legend + size_axes.get_legend_handles_labels()[0])
    return figure


def draw_error_shares(axes, rows, names, wrong, lines):
    """Bars for the kinds that occur, so that a clean row stays clean; notes for the rest, on lines of their own. Shares,
    as slow contestants are judged on fewer steps."""
    steps = {name: sum(finite(row.steps for row in rows if row.name == name and row.done)) for name in names}
    shares = [number / steps[name] for name in names if steps[name] for number in wrong[name].values() if number]
    low, most = min(shares, default=0.01) / 3, max(shares, default=1.0)
    for y, name in enumerate(names):
        kinds = [kind for kind in ERRORS if wrong[name][kind.label] and steps[name]]
        clean = "no error" if claims_exactness(rows, name) else "none beyond what it declares"
        clean = "" if kinds or not steps[name] else clean
        remark = "; ".join(filter(None, [clean, failures(rows, name)]))
        used = len(kinds) + bool(remark)
        at = [y + (k - (used - 1) / 2) * 0.94 / lines for k in range(used)]
        for kind, line in zip(kinds, at):
            number = wrong[name][kind.label]
            share = number / steps[name]
            axes.barh(line, share, 0.94 / lines, color=kind.shade, edgecolor="black", hatch=kind.hatch, linewidth=0.6,
                      zorder=2)
            axes.annotate(f"{percent(share)} ({int(number):,} of {int(steps[name]):,})", (share, line), (4, 0),
                          textcoords="offset points", va="center", fontsize=8)
        if remark:
            note(axes, at[-1], remark)
    room = (most / low) ** 0.6  # for what is written beside the longest bar
    log_axis(axes.xaxis, low, most * room, lambda share: percent(share) if share <= 1 else "")
    name_axis(axes, names)
    name_panel(axes, "answers that are off: share of the steps (log scale)")


def draw_error_sizes(axes, rows, names):
    """The largest distance error of each, beside the probe's radius."""
    sizes = {name: max(finite(row.max_distance_error for row in rows if row.name == name), default=math.nan)
             for name in names}
    shown = positive(sizes.values())
    radius = rows[0].radius
    if radius > 0 and math.isfinite(radius):
        axes.axvline(radius, color="black", linestyle="--", linewidth=1, label=f"the probe's radius, {radius:.3g}")
        shown.append(radius)
    low, high = min(shown, default=1) / 10, max(shown, default=1) * 30
    log_axis(axes.xaxis, low, high, lambda size: f"{size:.0e}".replace("e-0", "e-"))
    for y, name in enumerate(names):
        if sizes[name] > 0:
            axes.plot(sizes[name], y, "D", color=detectors.colour(name), markersize=6)
            # beside the mark, on the side with room: above it the radius' line would cross the number
            right = sizes[name] > radius or math.log(sizes[name] / low) < 0.6 * math.log(high / low)
            axes.annotate(f"{sizes[name]:.2g}", (sizes[name], y), (8 if right else -8, 0), textcoords="offset points",
                          ha="left" if right else "right", va="center", fontsize=8)
        else:
            note(axes, y, "0" if sizes[name] == 0 else "no distances judged")
    name_axis(axes, names)
    name_panel(axes, "largest distance error (mesh units, log scale)")
