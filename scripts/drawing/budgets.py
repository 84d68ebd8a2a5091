"""Time against certified error of `nearest` within a budget of looks: a line a detector, a mark a budget."""
import re

from . import detectors
from .layout import canvas, duration, label, log_axis, name_panel, trajectories_of, what_was_asked
from .results import NothingToDraw, positive, shortened
from .time_error import scientific

BUDGET = re.compile(r":budget=(\d+)$")
COLUMNS = [("bracket_max", "widest bracket", "-", "full"), ("bracket_p50", "median bracket", ":", "none")]


def has_budgets(rows):
    return any(BUDGET.search(row.name) for row in rows)


def draw_budgets(plt, rows, source):
    """A bracket of no width is at the panel's foot: there the answer is the exact contact."""
    rows = [row for row in rows if row.done and row.ns_per_query > 0]
    bounded = [row for row in rows if BUDGET.search(row.name)]
    shown = positive(getattr(row, column) for row in bounded for column, *_ in COLUMNS)
    if not shown:
        raise NothingToDraw("no row with a budget has times and brackets")
    foot, names = min(shown) / 10, detectors.in_order(row.detector for row in bounded)
    times = [row.ns_per_query for row in rows if row.name in names or row in bounded]
    trajectories = trajectories_of(bounded)
    figure, panels = canvas(plt, len(trajectories), 5.6, 4.2, left=1.0, bottom=1.45)
    for axes, trajectory in zip(panels, trajectories):
        for k, name in enumerate(names):
            mine = [row for row in rows if row.detector == name and row.trajectory == trajectory]
            draw_detector(axes, name, -12 if k % 2 else 5, mine, foot)
        log_axis(axes.xaxis, min(*times, 100) / 1.2, max(times) * 1.5, duration)
        log_axis(axes.yaxis, foot / 1.5, 1.5, lambda size: "exact" if size < 3 * foot else scientific(size))
        axes.axhspan(foot / 1.5, foot * 1.5, color="0.93", zorder=0)
        name_panel(axes, shortened(trajectory))
    legend = [plt.Line2D([], [], label=name, linestyle="", **detectors.mark(name)) for name in names] + [
        plt.Line2D([], [], label=f"{what}, of the diagonal", linestyle=style, color="0.2") for _, what, style, _ in COLUMNS]
    label(figure, "Nearest within a budget: time against certified error",
          what_was_asked(bounded) + "; numbers: looks at boxes and triangles", source,
          "mean time of a query (log scale)", legend)
    return figure


def draw_detector(axes, name, above, rows, foot):
    """By budget; the form without one is last, and exact."""
    whole = [row for row in rows if row.name == name]
    rows = sorted((row for row in rows if BUDGET.search(row.name)), key=lambda row: int(BUDGET.search(row.name)[1]))
    for column, _, style, fill in COLUMNS:
        sizes = [max(getattr(row, column), foot) for row in rows] + [foot] * len(whole)
        axes.plot([row.ns_per_query for row in rows + whole], sizes, clip_on=False, linewidth=1.2, linestyle=style,
                  **(detectors.mark(name, 6) | {"fillstyle": fill}))
    for row in rows:
        axes.annotate(BUDGET.search(row.name)[1], (row.ns_per_query, max(row.bracket_max, foot)), fontsize=8,
                      xytext=(0, above), textcoords="offset points", ha="center", color=detectors.colour(name))
