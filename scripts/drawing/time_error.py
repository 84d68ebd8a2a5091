"""Time against error, a mark a detector: to the left and down is better. Who does not err has a row below."""
import math
import textwrap

from . import detectors
from .layout import (canvas, detector_legend, duration, label, log_axis, name_axis, name_panel, percent, trajectories_of,
                     what_was_asked)
from .results import NothingToDraw, finite, geometric_mean, shortened

TIMES = [("ns_p50", "median of the steps"), ("ns_p999", "99.9 % of the steps take at most this")]
ROUNDING = 1e-15  # of the box's diagonal: what double precision leaves of a right answer
PANEL_HEIGHT, ROW_HEIGHT = 3.6, 0.22  # inches


class Error:
    """A kind of error of all detectors: `values` by name, of which those up to `floor` are none; `most`: there can be.
    `stored`: the same by the scene as the detector's library stores it, where that is another one."""

    def __init__(self, title, clean, values, floor, written, most=math.inf, stored=None):
        self.title, self.clean, self.floor, self.written, self.most = title, clean, floor, written, most
        self.values = {name: value for name, value in values.items() if math.isfinite(value)}
        self.stored = {name: value for name, value in (stored or {}).items() if math.isfinite(value)}
        self.erring = [name for name, value in self.values.items() if value > floor]
        self.shown = [value for name in self.erring
                      for value in (self.values[name], self.stored.get(name, math.nan)) if value > floor]


def draw_time_error(plt, rows, source):
    rows = [row for row in rows if ":budget=" not in row.name]  # budgets.py draws them
    trajectories = trajectories_of(rows)
    by_name = {name: [row for row in rows if row.name == name and row.done] for name in
               detectors.in_order(row.name for row in rows)}
    complete = [name for name, mine in by_name.items() if len({row.trajectory for row in mine}) == len(trajectories)
                and all(row.ns_p50 > 0 for row in mine)]
    judged = [error for error in kinds_of_error(rows, by_name, complete) if error.values]
    errors = [error for error in judged if error.shown]
    if not judged:
        raise NothingToDraw("no detector has times and errors on every trajectory")
    if not errors:
        raise NothingToDraw("nobody errs: " + "; ".join(error.clean for error in judged))
    erring = [name for name in complete if any(name in error.erring for error in errors)]
    clean = [name for name in complete if name not in erring and any(name in error.values for error in judged)]
    heights = [PANEL_HEIGHT] * len(errors) + [ROW_HEIGHT * len(clean)] * bool(clean)
    heights[0] = max(heights[0], 0.21 * len(erring))
    figure, panels = canvas(plt, 2 * len(heights), 4.0, PANEL_HEIGHT, right=room_for_legend(complete), columns=2,
                            share_x="col", share_y="row", left=1.0, bottom=1.2, gap=(0.2, 0.5), heights=heights)
    for k, (column, what) in enumerate(TIMES):
        times = {name: geometric_mean([getattr(row, column) for row in by_name[name]]) for name in complete
                 if all(getattr(row, column) > 0 for row in by_name[name])}
        if not times:
            continue  # all of fewer than 1,000 steps
        for error, axes in zip(errors, panels[k::2]):
            draw_panel(axes, error, times)
            name_panel(axes, "" if k else error.title)
        if clean:
            draw_clean(panels[-2 + k], clean, times)
            name_panel(panels[-2 + k], "" if k else "Without such errors")
        for axes in panels[k::2]:
            log_axis(axes.xaxis, min(times.values()) / 2, max(times.values()) * 2, duration)
        panels[-2 + k].set_xlabel(f"{what} (log scale)", fontsize=9)
    detector_legend(plt, figure, panels[1], erring, lines=False)
    asked = what_was_asked(rows) + ("; times: geometric mean over " if len(trajectories) > 1 else "; ")
    asked += ", ".join(map(shortened, trajectories))
    label(figure, "Time against error: left and down is better", asked, source)
    say_below(figure, remarks_on(errors, judged, by_name, complete))
    return figure


def remarks_on(errors, judged, by_name, complete):
    yield from (error.clean for error in judged if not error.shown)
    yield from (f"rounding: at most {ROUNDING:g} of the diagonal" for error in errors if error.floor)
    if len(errors) > 1:
        yield "who has a mark in one panel only has no error of the other kind"
    stored = [value > error.floor for error in errors for name, value in error.stored.items() if name in error.erring]
    if stored:
        yield ("bar under a mark: by the scene as that library stores it, in single precision"
               + ("" if all(stored) else "; at the panel's foot: no error by that scene"))
    left_out = [shortened(name) for name in by_name if name not in complete]
    if left_out:
        yield "not everywhere answered, so not shown: " + ", ".join(left_out)


def say_below(figure, remarks):
    """Lines at the foot, none longer than the picture is wide."""
    lines = textwrap.wrap("; ".join(remarks), int((figure.get_figwidth() - 0.3) / 0.068), break_long_words=False)
    figure.text(0.1 / figure.get_figwidth(), 0.5 / figure.get_figheight(), "\n".join(lines), fontsize=9, va="top")


def room_for_legend(names):
    return 0.75 + 0.078 * min(48, max(map(len, names)))


def kinds_of_error(rows, by_name, complete):
    contacts, distances, stored_contacts, stored_distances = {}, {}, {}, {}
    relative = all(math.isfinite(row.max_distance_error_of_diagonal) for row in rows
                   if row.done and math.isfinite(row.max_distance_error))
    column = "max_distance_error_of_diagonal" if relative else "max_distance_error"
    for name in complete:
        mine = by_name[name]
        judged, steps = finite(row.missed + row.false_contacts for row in mine), sum(finite(row.steps for row in mine))
        contacts[name] = sum(judged) / steps if judged and steps else math.nan
        distances[name] = max(finite(getattr(row, column) for row in mine), default=math.nan)
        judged = finite(row.stored_missed + row.stored_false_contacts for row in mine)
        stored_contacts[name] = sum(judged) / steps if judged and steps else math.nan
        if relative:
            stored_distances[name] = max(finite(row.stored_max_distance_error_of_diagonal for row in mine), default=math.nan)
    yield Error("Missed and false contacts, share of the steps (log scale)", "no contact was missed or falsely told",
                contacts, 0, percent, 1.3, stored_contacts)
    unit = "share of the box's diagonal" if relative else "mesh units"
    yield Error(f"Largest distance error, {unit} (log scale)", "distances differ by rounding at most", distances,
                ROUNDING if relative else 0, scientific, stored=stored_distances)


def scientific(size):
    return f"{size:.0e}".replace("e-0", "e-")


def draw_panel(axes, error, times):
    """Those that err, on a log scale."""
    from matplotlib import ticker
    most = max(error.shown)
    low, high = min(error.shown) / 3, max(min(3 * most, error.most), 1.1 * most)
    log_axis(axes.yaxis, low, high, error.written)
    axes.yaxis.set_minor_locator(ticker.NullLocator())
    for name in error.erring:
        if name not in times:
            continue
        value = error.values[name]
        put(axes, name, times[name], value)
        if name in error.stored:
            put_stored(axes, name, times[name], value, max(error.stored[name], low))


def draw_clean(axes, names, times):
    """A row each, with its name to the right of both panels."""
    for y, name in enumerate(names):
        if name in times:
            put(axes, name, times[name], y)
    name_axis(axes, names)
    axes.tick_params(axis="y", left=False, labelleft=False, labelright=axes.get_subplotspec().is_last_col())


def put_stored(axes, name, time, value, stored):
    """Below the mark, tied to it: what is left of the error by the scene that is stored."""
    axes.plot([time, time], [stored, value], color=detectors.colour(name), linewidth=0.8, linestyle=":", zorder=2)
    axes.plot(time, stored, marker="_", color=detectors.colour(name), markersize=11, markeredgewidth=2, zorder=3,
              clip_on=False)


def put(axes, name, time, value):
    axes.plot(time, value, linestyle="", zorder=3, clip_on=False, **detectors.mark(name, 8))
