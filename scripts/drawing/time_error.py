"""Time against error, a mark a detector: to the left and down is better."""
import math

from . import detectors
from .layout import canvas, detector_legend, duration, label, log_axis, name_panel, spread, trajectories_of, what_was_asked
from .results import NothingToDraw, finite, geometric_mean, shortened

TIMES = [("ns_p50", "median of the steps"), ("ns_p999", "99.9 % of the steps take at most this")]
ROUNDING = 1e-15  # of the box's diagonal: what double precision leaves of a right answer
BAND = 0.16  # of a panel's height: where those are that are not wrong at all


class Error:
    """A kind of error of all detectors: `values` by name, those up to `floor` go to the band at the foot; `most`: there
    can be. `stored`: the same by the scene as the detector's library stores it, where that is another one."""

    def __init__(self, title, clean, values, floor, written, most=math.inf, stored=None):
        self.title, self.clean, self.floor, self.written, self.most = title, clean, floor, written, most
        self.values = {name: value for name, value in values.items() if math.isfinite(value)}
        self.stored = {name: value for name, value in (stored or {}).items() if math.isfinite(value)}
        self.shown = [value for value in [*self.values.values(), *self.stored.values()] if value > floor]


def draw_time_error(plt, rows, source):
    trajectories = trajectories_of(rows)
    by_name = {name: [row for row in rows if row.name == name and row.done] for name in
               detectors.in_order(row.name for row in rows)}
    complete = [name for name, mine in by_name.items() if len({row.trajectory for row in mine}) == len(trajectories)
                and all(row.ns_p50 > 0 and row.ns_p999 > 0 for row in mine)]
    judged = [error for error in kinds_of_error(rows, by_name, complete) if error.values]
    errors = [error for error in judged if error.shown]
    if not judged:
        raise NothingToDraw("no detector has times and errors on every trajectory")
    if not errors:
        raise NothingToDraw("nobody errs: " + "; ".join(error.clean for error in judged))
    height = max(3.9, 0.21 * len(complete) / len(errors))
    figure, panels = canvas(plt, 2 * len(errors), 4.6, height, right=room_for_legend(complete), columns=2, share_x="col",
                            share_y="row", left=1.0, bottom=1.2, gap=(0.2, 0.6))
    for k, error in enumerate(errors):
        for (column, what), axes in zip(TIMES, panels[2 * k:2 * k + 2]):
            times = {name: geometric_mean([getattr(row, column) for row in by_name[name]]) for name in complete}
            draw_panel(axes, error, times)
            name_panel(axes, error.title if column == "ns_p50" else "")
            log_axis(axes.xaxis, min(times.values()) / 2, max(times.values()) * 2, duration)
            if k == len(errors) - 1:
                axes.set_xlabel(f"{what} (log scale)", fontsize=9)
    detector_legend(plt, figure, panels[1], complete, lines=False)
    asked = what_was_asked(rows) + ("; times: geometric mean over " if len(trajectories) > 1 else "; ")
    asked += ", ".join(map(shortened, trajectories))
    remarks = [error.clean for error in judged if not error.shown]
    remarks += [f"rounding: at most {ROUNDING:g} of the diagonal" for error in errors if error.floor]
    if any(error.stored for error in errors):
        remarks.append("bar under a mark: by the scene as that library stores it, in single precision")
    left_out = [shortened(name) for name in by_name if name not in complete]
    if left_out:
        remarks.append("not everywhere answered, so not shown: " + ", ".join(left_out))
    label(figure, "Time against error: left and down is better", asked, source)
    figure.text(0.1 / figure.get_figwidth(), 0.3 / figure.get_figheight(), "; ".join(remarks), fontsize=9)
    return figure


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
                ROUNDING if relative else 0, lambda size: f"{size:.0e}".replace("e-0", "e-"), stored=stored_distances)


def percent(share):
    return f"{100 * share:.3g} %"


def draw_panel(axes, error, times):
    """Errors on a log scale above a band for those that have none; in it, height means nothing but keeps marks apart."""
    from matplotlib import ticker
    most = max(error.shown)
    low, high = min(error.shown) / 3, max(min(3 * most, error.most), 1.1 * most)
    foot = low / (high / low) ** (BAND / (1 - BAND))
    log_axis(axes.yaxis, foot, high, error.written)
    axes.yaxis.set_minor_locator(ticker.NullLocator())  # none in the band
    axes.axhspan(foot, low, color="0.94", zorder=0)
    axes.axhline(low, color="0.6", linewidth=0.8, zorder=0)
    ticks = [tick for tick in axes.get_yticks() if low <= tick <= high]
    middle = math.sqrt(foot * low)
    axes.set_yticks([middle] + ticks, ["none" if error.floor == 0 else "rounding"] + [error.written(t) for t in ticks],
                    fontsize=9)
    clean = sorted((name for name in error.values if error.values[name] <= error.floor), key=times.get)
    levels = spread([times[name] for name in clean], math.log(4 * max(times.values()) / min(times.values())))
    rows = max(levels, default=0) + 1
    for name, level in zip(clean, levels):
        put(axes, name, times[name], foot * (low / foot) ** ((level + 0.5) / rows if rows > 1 else 0.5))
    for name, value in error.values.items():
        if value > error.floor:
            put(axes, name, times[name], value)
            if name in error.stored:
                put_stored(axes, name, times[name], value, max(error.stored[name], middle))


def put_stored(axes, name, time, value, stored):
    """Below the mark, tied to it: what is left of the error by the scene that is stored."""
    axes.plot([time, time], [stored, value], color=detectors.colour(name), linewidth=0.8, linestyle=":", zorder=2)
    axes.plot(time, stored, marker="_", color=detectors.colour(name), markersize=11, markeredgewidth=2, zorder=3,
              clip_on=False)


def put(axes, name, time, value):
    axes.plot(time, value, linestyle="", zorder=3, clip_on=False, **detectors.mark(name, 8))
