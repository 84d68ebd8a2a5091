"""Time against the number of groups (Park & Jang's Fig. 7), from times.csv of the paper's experiment."""
import math

from .layout import canvas, count, duration, label, log_axis, name_panel
from .results import NothingToDraw, Unusable, number, rows_of, shortened

MARKS = [(61, "a tenth"), (214, "best"), (783, "rises")]  # groups, as Park & Jang's text has them
FORMS = [("cube", "groups: cubes", "s", "#c04a00", "full", "-"),
         ("sphere", "groups: spheres (smallest)", "o", "#0060a8", "none", "--"),
         ("centered-sphere", "groups: spheres (about the cuboids' centres)", "^", "#507030", "none", ":")]
LEVELS = [("ungrouped", "ungrouped", "black", (0, (6, 3))), ("direct", "exact grid (own cell only)", "black", ":")]
PAPER_COLUMNS = ["mesh", "triangles", "form", "groups", "detection_ms"]
OPERATIONS = ["operations_per_query", "operations_low", "operations_high"]


class Panel:
    """`curves`: (groups, value) ascending by form; `levels`: value by form; `bands`: (groups, low, high) by form."""

    def __init__(self, title):
        self.title, self.curves, self.levels, self.bands = title, {}, {}, {}

    def add(self, form, groups, ns):
        if any(form == level for level, *_ in LEVELS):
            self.levels[form] = ns
        elif any(form == curve for curve, *_ in FORMS):
            self.curves.setdefault(form, []).append((groups, ns))


def from_paper(path):
    """A panel a mesh of times.csv."""
    def record(row, line):
        return (row["mesh"], number(row["triangles"], "triangles", line), row["form"],
                number(row["groups"], "groups", line), 1e6 * number(row["detection_ms"], "detection_ms", line))
    panels = {}
    for mesh, triangles, form, groups, ns in rows_of(path, PAPER_COLUMNS, record):
        if not math.isfinite(triangles):
            raise Unusable(f"{path}: mesh {shortened(mesh)}: no number of triangles")
        if ns > 0:
            panel = panels.setdefault(mesh, Panel(f"{shortened(mesh)}: {int(triangles):,} triangles"))
            panel.add(form, groups, ns)
    return usable(panels.values())


def operations_from_paper(path):
    """The same with operations per query, and where the middle four fifths of the places lie."""
    with open(path, encoding="utf-8") as file:
        if not set(OPERATIONS) <= set(file.readline().strip().split(",")):
            raise NothingToDraw(f"{path} was recorded without operations_per_query")
    def record(row, line):
        return (row["mesh"], number(row["triangles"], "triangles", line), row["form"],
                number(row["groups"], "groups", line), *(number(row[column], column, line) for column in OPERATIONS))
    panels = {}
    for mesh, triangles, form, groups, mean, low, high in rows_of(path, PAPER_COLUMNS + OPERATIONS, record):
        if not mean > 0:
            continue
        panel = panels.setdefault(mesh, Panel(f"{shortened(mesh)}: {int(triangles):,} triangles"))
        panel.add(form, groups, mean)
        if groups >= 1:
            panel.bands.setdefault(form, []).append((groups, low, high))
    return usable(panels.values())


def usable(panels):
    chosen = []
    for panel in panels:
        panel.curves = {form: sorted(point for point in points if point[0] >= 1) for form, points in panel.curves.items()}
        if any(len(points) > 1 for points in panel.curves.values()):
            chosen.append(panel)
    return chosen


def draw_groups(plt, panels, title, asked, source, axis="number of groups (log scale)", unit="time of one query",
                written=duration):
    figure, shown = canvas(plt, len(panels), 5.4, 3.4, left=1.05, share_y=False, gap=(0.9, 0.55),
                           columns=min(2, len(panels)), bottom=1.55)
    groups = [at for panel in panels for points in panel.curves.values() for at, _ in points]
    for axes, panel in zip(shown, panels):
        for form, text, marker, colour, fill, style in FORMS:
            points = panel.curves.get(form, [])
            axes.plot([at for at, _ in points], [ns for _, ns in points], linestyle=style, marker=marker, color=colour,
                      fillstyle=fill, markersize=6, linewidth=1.2)
            band = sorted(panel.bands.get(form, []))
            axes.fill_between([at for at, _, _ in band], [low for _, low, _ in band], [high for _, _, high in band],
                              color=colour, alpha=0.15, linewidth=0)
        for form, _, colour, style in LEVELS:
            if form in panel.levels:
                axes.axhline(panel.levels[form], color=colour, linestyle=style, linewidth=1.3)
        if "ungrouped" in panel.levels:
            axes.axhline(panel.levels["ungrouped"] / 10, color="0.6", linestyle=(0, (6, 3)), linewidth=1)
        for at, what in MARKS:
            axes.axvline(at, color="0.6", linewidth=4, alpha=0.5, zorder=0)
            axes.annotate(f"{at} {what}", (at, 0.98), xycoords=("data", "axes fraction"), rotation=90, fontsize=7.5,
                          ha="right", va="top", color="0.35")
        times = [ns for points in panel.curves.values() for _, ns in points] + list(panel.levels.values())
        log_axis(axes.xaxis, min(groups) / 1.5, max(groups + [MARKS[-1][0]]) * 1.5, count)
        log_axis(axes.yaxis, min(times) / 1.8, max(times) * 1.8, written)
        axes.set_ylabel(unit, fontsize=9)
        name_panel(axes, panel.title)
    legend = [plt.Line2D([], [], linestyle=style, marker=marker, color=colour, fillstyle=fill, markersize=6,
                         linewidth=1.2, label=text) for form, text, marker, colour, fill, style in FORMS
              if any(form in panel.curves for panel in panels)]
    legend += [plt.Line2D([], [], color=colour, linestyle=style, linewidth=1.3, label=text)
               for form, text, colour, style in LEVELS if any(form in panel.levels for panel in panels)]
    legend.append(plt.Line2D([], [], color="0.6", linewidth=4, alpha=0.5,
                             label="the paper's numbers of groups"))
    legend.append(plt.Line2D([], [], color="0.6", linestyle=(0, (6, 3)), linewidth=1, label="a tenth of the ungrouped"))
    if any(panel.bands for panel in panels):
        legend.append(plt.Line2D([], [], color="0.4", linewidth=8, alpha=0.3, label="band: four fifths of the places"))
    label(figure, title, asked, source, axis, legend)
    return figure
