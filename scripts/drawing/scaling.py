"""How contestants grow with the mesh: what touchmark scale measured, and the power laws it fitted."""
import math

from . import detectors
from .layout import canvas, count, duration, label, log_axis, name_panel, telling_words, what_was_asked
from .results import NothingToDraw, number, positive, read_records, rows_of, shortened, unique

MS = 1e6  # in nanoseconds
COLUMNS = ["detector", "options", "trajectory", "quantity", "points", "exponent", "exponent_low", "exponent_high", "factor",
           "family", "query", "least_triangles", "most_triangles"]


def memory(size):
    for unit, one in (("GB", 1e9), ("MB", 1e6), ("kB", 1e3)):
        if size >= 0.9999 * one:
            return f"{size / one:.3g} {unit}"
    return f"{size:.3g} B"


PANELS = [  # column, title, unit, how it is written
    ("build_ms", "Time to build", MS, duration),
    ("ns_per_query", "Time of a query, mean of a loop", 1, duration),
    ("first_answer_ms", "Time to the first answer, building included", MS, duration),
    ("ns_p50", "Median of the steps", 1, duration),
    ("bytes", "Memory, by its own count", 1, memory),
    ("ns_p999", "99.9 % of the steps take at most this", 1, duration),
]
ENOUGH_STEPS = 1000  # for one in a thousand to mean something


class Fit:
    def __init__(self, record, line):
        self.name = record["detector"] + (":" + record["options"] if record["options"] else "")
        self.family, self.trajectory, self.query = record["family"], record["trajectory"], record["query"]
        self.quantity = record["quantity"]
        for column in ("exponent", "exponent_low", "exponent_high", "factor", "least_triangles", "most_triangles"):
            setattr(self, column, number(record[column], column, line))

    def at(self, triangles):
        return self.factor * triangles ** self.exponent

    def text(self):
        if math.isnan(self.exponent_low):
            return f"{self.exponent:.2f}"
        return f"{self.exponent:.2f} ± {(self.exponent_high - self.exponent_low) / 2:.2f}"


def family_of(mesh):
    return mesh.partition(":")[0] if ":" in mesh else ""


def pictures(runs):
    """(words for the file's name, rows, fits, source) of each family of meshes, trajectory and query."""
    found = {}
    for run in runs:
        path = run.path.with_name("scaling.csv")
        if not path.exists():
            continue
        for fit in rows_or_none(path):
            found.setdefault((fit.family, fit.trajectory, fit.query, run), []).append(fit)
    words = telling_words(found)
    for key, fits in found.items():
        family, trajectory, query, run = key
        rows = [row for row in run.rows if row.done and family_of(row.mesh) == family and row.trajectory == trajectory and
                row.query == query]
        yield [run.name if word is run else word for word in words[key]], rows, fits, run.source


def rows_or_none(path):
    """A run that was stopped early has a header only."""
    return rows_of(path, COLUMNS, Fit) if any(True for _ in read_records(path, COLUMNS)) else []


def draw_scaling(plt, rows, fits, source):
    shown = [panel for panel in PANELS if any(fit.quantity == panel[0] for fit in fits)]
    names = detectors.in_order(fit.name for fit in fits)
    if not shown or not rows:
        raise NothingToDraw("nothing was measured on two sizes")
    beside = 1.7  # inches for the exponents
    figure, panels = canvas(plt, len(shown), 3.7, max(2.4, 0.2 * (len(names) + 1)), right=beside, gap=(beside + 0.75, 0.6),
                            columns=2 if len(shown) > 1 else 1, share_y=False, bottom=1.05 + 0.2 * (len(names) // 4))
    spans = sorted(unique(row.triangles for row in rows))
    for axes, (quantity, title, unit, written) in zip(panels, shown):
        draw_panel(plt, axes, [fit for fit in fits if fit.quantity == quantity], rows, quantity, unit)
        values = [unit * value for value in positive(getattr(row, quantity) for row in rows if usable(row, quantity))]
        name_panel(axes, title)
        log_axis(axes.xaxis, spans[0] / 1.5, spans[-1] * 1.5, count)
        log_axis(axes.yaxis, min(values) / 2, max(values) * 2, written)
    asked = f"{what_was_asked(rows)}, {shortened(rows[0].trajectory)}"
    label(figure, "Growth with the mesh: down is better, flat is best", asked, source,
          "triangles (log scale); beside each panel: the exponent of quantity = factor × triangles^exponent, the line, "
          "with its 95 % interval",
          [plt.Line2D([], [], label=shortened(name), **detectors.mark(name, 6), **detectors.line(name)) for name in names])
    return figure


def usable(row, quantity):
    return row.steps >= ENOUGH_STEPS or quantity != "ns_p999"


def draw_panel(plt, axes, fits, rows, quantity, unit):
    handles = []
    for name in detectors.in_order(fit.name for fit in fits):
        fit = next(fit for fit in fits if fit.name == name)
        points = sorted((row.triangles, unit * getattr(row, quantity)) for row in rows
                        if row.name == name and usable(row, quantity) and getattr(row, quantity) > 0)
        ends = [fit.least_triangles, fit.most_triangles]
        axes.plot([x for x, _ in points], [y for _, y in points], **detectors.mark(name, 6), linestyle="", zorder=3)
        axes.plot(ends, [unit * fit.at(end) for end in ends], color=detectors.colour(name), **detectors.line(name))
        handles.append(plt.Line2D([], [], label=fit.text(), **detectors.mark(name, 6),
                                  **detectors.line(name)))
    axes.legend(handles=handles, loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0, fontsize=8, frameon=False,
                handlelength=2.6, labelspacing=0.5)
