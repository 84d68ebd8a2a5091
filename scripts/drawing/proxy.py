"""proxy.csv as one picture, methods by families with crossings per million ticks; and stab.csv as another, one stab through
each method, seen from the side."""
import csv
import math

from .layout import Matrix, label
from .results import NothingToDraw, Record, number, rows_of, shortened, unique

TEXTS = ["method", "options", "family", "probe"]
COUNTS = ["ticks", "crossings", "pops", "violations"]
COLUMNS = TEXTS + COUNTS
CLEAN, TOO_NEAR, CROSSED, POPPED = "#dcefdc", "#eef3d2", "#f3c14b", "#c0392b"
MEANINGS = [(CLEAN, "✓  neither crossed nor too near"), (TOO_NEAR, "<r  never crossed, but nearer than the radius"),
            (CROSSED, "touched or crossed the surface, within rounding"), (POPPED, "came out at the other side")]
SURFACE = "surface"
PANELS_A_ROW = 3


class Row(Record):
    """One row of proxy.csv."""

    def __init__(self, record, line):
        super().__init__(record, line, TEXTS, counts=COUNTS)
        self.name = self.method + (":" + self.options if self.options else "")
        self.line = f"{self.name}, {self.probe}"


def read(path):
    return rows_of(path, COLUMNS, Row)


def per_million(count, ticks):
    """At most four characters."""
    value = 1e6 * count / ticks
    return f"{value:.0f}" if value < 1000 else f"{value / 1000:.2g}k" if value < 99_500 else f"{value / 1000:.0f}k"


def colour_and_text(row):
    if row.crossings:
        return POPPED if row.pops else CROSSED, per_million(row.crossings, row.ticks)
    return (TOO_NEAR, "<r") if row.violations else (CLEAN, "✓")


def draw_proxy(plt, rows, source):
    rows = [row for row in rows if row.ticks]
    if not rows:
        raise NothingToDraw("no row")
    names, families = unique(row.line for row in rows), unique(row.family for row in rows)
    matrix = Matrix(plt, names, families)
    for row in rows:
        colour, text = colour_and_text(row)
        matrix.fill(row.line, row.family, colour, text, "white" if colour == POPPED else "black")
    ticks = sum(row.ticks for row in rows)
    return matrix.finish("Proxies: how often did they cross the surface, per million ticks?",
                         f"{ticks:,.0f} ticks, each way replayed by the exact oracle; k: thousand; ball and bare point apart",
                         source, MEANINGS)


def read_stab(path):
    """(outline, {method: (goals, ways)}), all as lists of (x, z)."""
    outline, methods = [], {}
    with open(path, encoding="utf-8", newline="") as file:
        for line, record in enumerate(csv.DictReader(file), 2):
            at = tuple(number(record.get(column), column, line) for column in ("proxy_x", "proxy_z"))
            if record["method"] == SURFACE:
                outline.append(at)
                continue
            goals, way = methods.setdefault(record["method"], ([], []))
            goals.append(tuple(number(record.get(column), column, line) for column in ("goal_x", "goal_z")))
            way.append(at)
    return outline, methods


def draw_stab(plt, stab, source):
    outline, methods = stab
    if not methods:
        raise NothingToDraw("no method")
    rows = math.ceil(len(methods) / PANELS_A_ROW)
    figure, axes = plt.subplots(rows, PANELS_A_ROW, figsize=(11, 1.6 + 2.6 * rows), squeeze=False)
    figure.subplots_adjust(left=0.03, right=0.97, top=1 - 1.0 / (1.6 + 2.6 * rows), bottom=0.6 / (1.6 + 2.6 * rows),
                           hspace=0.15, wspace=0.05)
    for panel in axes.flat[len(methods):]:
        panel.set_visible(False)
    for panel, (method, (goals, way)) in zip(axes.flat, methods.items()):
        panel.fill(*zip(*outline), facecolor="0.88", edgecolor="0.3", linewidth=1)
        panel.plot(*zip(*goals), color="0.55", linewidth=0.8, marker=".", markersize=2.5, label="device")
        panel.plot(*zip(*way), color="#1f5fa8", linewidth=1.6, marker="o", markersize=3, label="proxy")
        panel.plot(*way[-1], color="#c0392b", marker="o", markersize=7, linestyle="", label="where it ends")
        panel.set_title(shortened(method), fontsize=10)
        panel.set_aspect("equal")
        panel.set_xlim(-0.052, 0.055)
        panel.set_ylim(-0.022, 0.034)
        panel.set_xticks([])
        panel.set_yticks([])
    handles, _ = axes.flat[0].get_legend_handles_labels()
    label(figure, "One stab through each: a groove, and a wall of half a millimetre",
          "a ball of 2 mm (god-object: a point) is pressed in, drawn under the groove and jerked through the wall", source, "",
          handles)
    return figure
