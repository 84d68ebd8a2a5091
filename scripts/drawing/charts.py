"""The papers' charts, from their CSV files: legible in grey, every axis with its unit."""
import csv
import math
import pathlib

from . import groups
from .layout import count, duration, log_axis, plain, rate
from .pictures import METHODS

SHADES = ["0.95", "0.75", "0.45", "0.1"]
HATCHES = ["", "////", "....", ""]
NAMES = {"butterfly": "Butterfly", "catmull-clark-linear": "Catmull-\nClark", "mid-point": "Mid-point", "loop": "Loop",
         "ls3": "LS3", "original": "original"}


def read(path):
    with open(path, newline="", encoding="utf-8") as file:
        return list(csv.DictReader(file))


def number(row, column):
    return float(row[column]) if row.get(column) else math.nan


class Table1:
    """table1.csv by method, level and whether clustered; level 0 stands for every method."""

    def __init__(self, directory):
        self.rows = {}
        for row in read(pathlib.Path(directory) / "table1.csv"):
            self.rows[row["method"], int(row["level"]), float(row["clustering"]) > 0] = row
        self.levels = 1 + max(level for _, level, _ in self.rows)

    def value(self, method, level, clustered, column):
        row = self.rows.get((method if level else "original", level, clustered))
        return number(row, column) if row else math.nan


def distance_text(table):
    """Of the caption: which distance the spheres were clustered within."""
    distances = [float(row["clustering"]) for (_, _, clustered), row in table.rows.items() if clustered]
    return f" (distance {max(distances):.3g} mesh units, the paper's 0.02)" if distances else ""


def short(value):
    """Three digits, without an exponent."""
    if not math.isfinite(value):
        return ""
    return f"{value:,.0f}" if value >= 100 else f"{value:.3g}" if value >= 1e-4 else f"{value:.6f}"


def bars(axes, table, column, clustered, levels, log=False, factor=1.0, base=0.0):
    """A group a method, a bar a level; they show `factor` times the column and stand on `base`."""
    width = 0.86 / len(levels)
    for k, level in enumerate(levels):
        values = [factor * table.value(method, level, clustered, column) for method, _ in METHODS]
        at = [m - 0.43 + (k + 0.5) * width for m in range(len(METHODS))]
        drawn = axes.bar(at, [value - base for value in values], width, bottom=base, color=SHADES[level],
                         hatch=HATCHES[level], edgecolor="black", linewidth=0.6,
                         label="original" if level == 0 else f"level {level}")
        axes.bar_label(drawn, [short(v) for v in values], fontsize=7.5, rotation=90, padding=2)
    axes.set_xticks(range(len(METHODS)), [NAMES[method] for method, _ in METHODS], fontsize=9)
    if log:
        axes.set_yscale("log")
        low, high = axes.get_ylim()
        axes.set_ylim(low, high * (high / low) ** 0.18)
        axes.yaxis.set_major_formatter(lambda value, _: plain(value))
    else:
        axes.margins(y=0.18)
    axes.grid(axis="y", color="0.85", linewidth=0.6)
    axes.set_axisbelow(True)


def draw_plain(plt, table, column, title, unit, clustered=False, from_level=0, base=0.0, log=False):
    figure, axes = plt.subplots(figsize=(7.5, 4.2))
    bars(axes, table, column, clustered, range(from_level, table.levels), log, base=base)
    if base:
        axes.axhline(base, color="black", linewidth=1)
    axes.set_ylabel(unit)
    axes.set_title(title, fontsize=12, fontweight="bold", loc="left")
    axes.legend(ncols=4, fontsize=8, loc="upper center", bbox_to_anchor=(0.5, -0.13), frameon=False)
    figure.tight_layout()
    return figure


def draw_tightness(plt, table):
    """Fig. 6 by the formula as printed, and read without a scale, which gives the printed order from level 2 on."""
    readings = [("relative_tightness", "the formula as printed: lengths", 0.0),
                ("scale_free_tightness", "without a scale: parts of the radius", 1.0)]
    readings = [reading for reading in readings if any(row.get(reading[0]) for row in table.rows.values())]
    figure, panels = plt.subplots(1, len(readings), squeeze=False, figsize=(1.5 + 5.5 * len(readings), 4.3))
    for axes, (column, name, base) in zip(panels[0], readings):
        bars(axes, table, column, False, range(1, table.levels), base=base)
        if base:
            axes.axhline(base, color="black", linewidth=1)
        axes.set_title(name, fontsize=10)
        axes.tick_params(axis="x", labelsize=8)
    panels[0][0].set_ylabel("tightness, original = 1")
    handles, labels = panels[0][0].get_legend_handles_labels()
    figure.legend(handles, labels, ncols=3, fontsize=9, loc="lower center", frameon=False)
    figure.suptitle("Choi & Sung 2017, Fig. 6: tightness of the spheres, less is tighter", fontsize=12, fontweight="bold",
                    x=0.01, ha="left")
    figure.tight_layout(rect=(0, 0.06, 1, 1))
    return figure


def printed_ls3(directory, what):
    """(printed, reproduced) by level, of the report's list."""
    values = {}
    for row in read(pathlib.Path(directory) / "numbers.csv"):
        if row["where"].startswith("Table 3, LS3 level ") and row["what"] == what and row["reproduced"]:
            values[int(row["where"].rsplit(" ", 1)[1])] = (float(row["printed"]), float(row["reproduced"]))
    return values


def draw_pair(plt, directory, table, column, title, unit, printed, log=True, relative=True, factor=1.0):
    """Without and with clustering, and LS3 beside the paper's numbers."""
    figure, (left, middle, right) = plt.subplots(1, 3, figsize=(11.5, 4.8), gridspec_kw={"width_ratios": [5, 5, 3.6]})
    levels = range(table.levels)
    bars(left, table, column, False, levels, log, factor)
    bars(middle, table, column, True, levels, log, factor)
    low = min(axes.get_ylim()[0] for axes in (left, middle))
    high = max(axes.get_ylim()[1] for axes in (left, middle))
    for axes, name in ((left, "without clustering"), (middle, "with clustering")):
        axes.set_ylim(low / 1.3, high)
        axes.set_title(name, fontsize=10)
    left.set_ylabel(unit)
    draw_ls3(right, directory, printed, levels, relative, unit)
    handles, labels = left.get_legend_handles_labels()
    figure.legend(handles, labels, ncols=4, fontsize=9, loc="lower left", bbox_to_anchor=(0.2, 0), frameon=False)
    figure.suptitle(title, fontsize=12, fontweight="bold", x=0.01, ha="left")
    figure.tight_layout(rect=(0, 0.05, 1, 1))
    return figure


def draw_ls3(axes, directory, printed, levels, relative, unit):
    for name, what, line in (("not clustered", printed[0], "-"), ("clustered", printed[1], "--")):
        values = printed_ls3(directory, what)
        if not values:
            continue
        base = [values[0][k] if relative else 1 for k in (0, 1)]
        for k, (who, marker, fill) in enumerate((("paper", "s", "white"), ("here", "o", "black"))):
            axes.plot(list(values), [pair[k] / base[k] for pair in values.values()], line, marker=marker, color="black",
                      markerfacecolor=fill, markersize=6, linewidth=1, label=f"{who}, {name}")
    axes.set_yscale("log")
    log_axis(axes.yaxis, *axes.get_ylim(), plain)
    axes.set_xticks(levels)
    axes.set_xlabel("level")
    axes.set_ylabel("ratio to level 0" if relative else unit)
    axes.set_title("LS3: the paper, and here", fontsize=10)
    axes.legend(fontsize=8.5, frameon=False)


def draw_fast_forms(plt, directory):
    figure, axes = plt.subplots(figsize=(8, 5))
    rows = read(pathlib.Path(directory) / "fast_forms.csv")
    forms = [("scan_update_rate_hz", "published scan", "o", "white"),
             ("clustered_scan_update_rate_hz", "published scan, clustered", "s", "0.7"),
             ("grid_update_rate_hz", "exact grid", "D", "black"), ("tree_update_rate_hz", "exact tree", "^", "white")]
    for column, name, marker, fill in forms:
        axes.plot([number(row, "triangles") for row in rows], [number(row, column) for row in rows], marker, color="black",
                  markerfacecolor=fill, markersize=6, label=name)
    axes.axhline(1000, color="black", linestyle="--", linewidth=0.8, label="1 kHz: a haptic loop")
    for axis, columns, written in ((axes.xaxis, ["triangles"], count), (axes.yaxis, [form[0] for form in forms], rate)):
        shown = [number(row, column) for row in rows for column in columns if number(row, column) > 0]
        log_axis(axis, min(shown + [1000]) / 1.6, max(shown + [1000]) * 1.6, written)
    axes.set_xlabel("triangles, all methods and levels (log scale)")
    axes.set_ylabel("update rate (log scale)")
    axes.set_title("What subdivision costs the scan of Choi & Sung 2017, and exact forms", fontsize=12,
                   fontweight="bold", loc="left")
    axes.legend(fontsize=9, frameon=False, loc="upper left", bbox_to_anchor=(1.0, 1.0))
    figure.tight_layout()
    return figure


def draw_frontier(plt, directory):
    """Time against error: below and to the left is better."""
    figure, axes = plt.subplots(figsize=(9.5, 6))
    rows = [row for row in read(pathlib.Path(directory) / "frontier.csv") if row["detection_ms"]]
    distances = sorted({float(row["clustering"]) for row in rows})
    forms = {"scan": "o", "fast level": "v", "tree": "^", "grid": "D"}
    for form, marker in forms.items():
        for k, distance in enumerate(distances):
            mine = [row for row in rows if row["form"] == form and float(row["clustering"]) == distance]
            shade = "white" if form in ("scan", "fast level") and k == 0 else str(0.85 - 0.7 * k / max(len(distances) - 1, 1))
            axes.plot([1e6 * number(row, "detection_ms") for row in mine], [number(row, "mean_error_percent") for row in mine],
                      marker, color="black", markerfacecolor=shade if form in ("scan", "fast level") else "black",
                      markersize=5 + (form in ("tree", "grid")), markeredgewidth=0.7)
    published = pareto([row for row in rows if row["form"] in ("scan", "fast level")])
    every = pareto(rows)
    for best, style, name in ((published, "--", "frontier as published"), (every, "-", "frontier with the exact fast forms")):
        axes.step([1e6 * number(row, "detection_ms") for row in best], [number(row, "mean_error_percent") for row in best],
                  where="post", color="black", linestyle=style, linewidth=1.2, label=name, zorder=0)
    times = [1e6 * number(row, "detection_ms") for row in rows]
    errors = [number(row, "mean_error_percent") for row in rows if number(row, "mean_error_percent") > 0]
    log_axis(axes.xaxis, min(times) / 1.6, max(times) * 1.6, duration)
    if errors:
        log_axis(axes.yaxis, min(errors) / 1.6, max(errors) * 1.6, lambda percent: f"{plain(percent)} %")
    name_best(axes, published + every)
    axes.set_xlabel("time of one query (log scale)")
    axes.set_ylabel("mean error to the smooth surface, of the diagonal (log scale)")
    legend = axes.get_legend_handles_labels()[0]
    for form, marker in forms.items():
        kind = {"scan": "scan, precise (published)", "fast level": "fast level alone (published)", "tree": "exact tree",
                "grid": "exact grid"}[form]
        legend.append(plt.Line2D([], [], linestyle="", marker=marker, color="black", label=kind,
                                 markerfacecolor="white" if form in ("scan", "fast level") else "black"))
    legend.append(plt.Line2D([], [], linestyle="", marker="o", color="black", markerfacecolor="0.4",
                             label=f"darker: clustered within more, up to {max(distances):.3g} mesh units"))
    axes.legend(handles=legend, fontsize=8.5, loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=3, frameon=False)
    axes.set_title("Choi & Sung 2017: time against error, left and down is better", fontsize=12, fontweight="bold", loc="left")
    figure.tight_layout()
    return figure


def name_best(axes, rows):
    """Method and level beside the mark, above or below it so that no two names meet."""
    placed = {}  # by name and form: where, in pixels
    for row in rows:
        name = NAMES[row["method"]].replace("\n", "") + (f" {row['level']}" if int(row["level"]) else "")
        if row["form"] == "fast level" or (name, row["form"]) in placed:  # those are all in one corner, all as far off
            continue
        spot = 1e6 * number(row, "detection_ms"), number(row, "mean_error_percent")
        x, y = axes.transData.transform(spot)
        crowded = any(abs(x - other_x) < 70 and abs(y - other_y) < 14 for other_x, other_y in placed.values())
        axes.annotate(name, spot, (5, -11 if crowded else 4), textcoords="offset points", fontsize=8)
        placed[name, row["form"]] = x, y


def pareto(rows):
    best, least = [], math.inf
    for row in sorted(rows, key=lambda row: number(row, "detection_ms")):
        if number(row, "mean_error_percent") < least:
            least = number(row, "mean_error_percent")
            best.append(row)
    return best


def draw_groups_against_time(plt, directory):
    """Park & Jang's Fig. 7, a panel a mesh."""
    panels = groups.from_paper(pathlib.Path(directory) / "times.csv")
    if not panels:
        raise ValueError("times.csv has no times of several numbers of groups")
    return groups.draw_groups(plt, panels, "Park & Jang 2018, Fig. 7: time against the number of groups",
                              "query: nearest; down is better", "processor time of one query, as touchmark paper measured it")


def draw_groups_against_operations(plt, directory):
    """The compared curve of Fig. 7: what a query looks at, the same on every machine."""
    panels = groups.operations_from_paper(pathlib.Path(directory) / "times.csv")
    if not panels:
        raise ValueError("times.csv has no counts of several numbers of groups")
    return groups.draw_groups(plt, panels, "Park & Jang 2018, Fig. 7: operations against the number of groups",
                              "query: nearest; down is better; the same on every machine",
                              "arithmetic operations of one query, as touchmark paper counted them",
                              unit="operations of one query", written=count)


def draw_levels(plt, directory):
    """Rate against error over one trajectory: each level alone, the session that switches, and the exact tree."""
    rows = read(pathlib.Path(directory) / "levels.csv")
    figure, axes = plt.subplots(figsize=(9.5, 5.8))
    names = {"spheres": "spheres alone", "triangles": "triangles", **{f"ls3 {n}": f"LS3 {n}" for n in range(1, 6)}}
    for form, marker, fill, label, over in (("alone", "o", "white", "a level alone, as published", 6),
                                            ("tree", "^", "black", "exact tree over the same triangles", -13)):
        mine = [row for row in rows if row["form"] == form]
        axes.plot([number(row, "rate_hz") for row in mine], [number(row, "mean_error_percent") for row in mine], marker,
                  color="black", markerfacecolor=fill, markersize=9, label=label + ": the rate it holds", zorder=3)
        for row in mine:
            axes.annotate(names.get(row["level"], row["level"]), (number(row, "rate_hz"), number(row, "mean_error_percent")),
                          (7, over), textcoords="offset points", fontsize=8.5)
    switched = sorted((row for row in rows if row["form"] == "switched"), key=lambda row: number(row, "wanted_hz"))
    wanted = [number(row, "wanted_hz") for row in switched]
    error = [number(row, "mean_error_percent") for row in switched]
    axes.plot(wanted, error, "-", color="0.45", linewidth=1.4, zorder=1)
    for in_time, shade, label in ((True, "0.45", "switched at run time: wanted rate, 99 of 100 queries in time"),
                                  (False, "white", "switched at run time: wanted rate, not held")):
        shown = [k for k, row in enumerate(switched) if (number(row, "in_time_percent") >= 99) == in_time]
        axes.plot([wanted[k] for k in shown], [error[k] for k in shown], "s", color="0.45", markeredgecolor="black",
                  markeredgewidth=0.7, markerfacecolor=shade, markersize=5.5, label=label, zorder=2)
    axes.axvline(1000, color="black", linestyle="--", linewidth=0.8, label="1 kHz: a haptic loop")
    rates = [number(row, "rate_hz") for row in rows if row["form"] != "switched"] + wanted
    errors = [value for value in (number(row, "mean_error_percent") for row in rows) if value > 0]
    log_axis(axes.xaxis, min(rates + [1000]) / 1.6, max(rates) * 3, rate)
    if errors:
        log_axis(axes.yaxis, min(errors) / 1.6, max(errors) * 1.6, lambda percent: f"{plain(float(f'{percent:.3g}'))} %")
    axes.set_xlabel("update rate (log scale)")
    axes.set_ylabel("mean error of the depth of contact, of the diagonal (log scale)")
    axes.set_title("Choi & Sung 2017, future work: levels of detail switched at run time; right and down is better",
                   fontsize=11.5, fontweight="bold", loc="left")
    axes.legend(fontsize=8.5, loc="upper center", bbox_to_anchor=(0.5, -0.12), ncols=2, frameon=False)
    figure.tight_layout()
    return figure
