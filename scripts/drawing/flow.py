"""Choi & Sung's Fig. 1, the flow of the comparison: the stages of touchmark paper, each with what it made."""
import pathlib

from .charts import number, read
from .pictures import METHODS

HEIGHT, WIDTH = 0.62, 2.15  # of a box, in inches


def min_to_max(values, written="{:,.0f}"):
    low, high = written.format(min(values)), written.format(max(values))
    return low if low == high else f"{low} to {high}"


def box(axes, x, y, title, lines, width=WIDTH, dark=False):
    from matplotlib.patches import Rectangle
    height = HEIGHT + 0.17 * (len(lines) - 1)
    axes.add_patch(Rectangle((x - width / 2, y - height / 2), width, height, facecolor="0.85" if dark else "white",
                             edgecolor="black", linewidth=0.9))
    axes.text(x, y + height / 2 - 0.17, title, ha="center", va="center", fontsize=10, fontweight="bold")
    for k, line in enumerate(lines):
        axes.text(x, y + height / 2 - 0.39 - 0.17 * k, line, ha="center", va="center", fontsize=8.5)
    return x, y + height / 2, y - height / 2


def arrow(axes, upper, lower):
    axes.annotate("", (lower[0], lower[1]), (upper[0], upper[2]),
                  arrowprops={"arrowstyle": "-|>", "color": "black", "linewidth": 0.9, "shrinkA": 0, "shrinkB": 0})


def draw_flow(plt, directory, table):
    rows, top = list(table.rows.values()), table.levels - 1
    column = lambda name, level, clustered: [table.value(method, level, clustered, name) for method, _ in METHODS]
    original = table.rows["original", 0, False]
    figure, axes = plt.subplots(figsize=(9.4, 6.6))
    axes.set_xlim(0, 9.4)
    axes.set_ylim(0, 6.2)
    axes.axis("off")
    mesh = box(axes, 4.7, 5.8, "Bunny mesh", [f"{int(original['triangles']):,} triangles"])
    spots = [0.95 + 1.875 * k for k in range(len(METHODS))]
    methods = [box(axes, x, 4.75, name, [f"{table.value(method, top, False, 'triangles'):,.0f} triangles",
                                         f"at level {top}"], 1.7, True)
               for x, (method, name) in zip(spots, METHODS)]
    graphical = box(axes, 2.0, 3.35, "Graphical test", [
        "creases " + min_to_max(column("crease_deg", top, False), "{:.1f}") + "°",
        "volume " + min_to_max(column("relative_volume", top, False), "{:.3f}")], 2.6)
    single = box(axes, 5.15, 3.35, "Spheres, a triangle each",
                 [f"level {top}: " + min_to_max(column("spheres", top, False)), "Figs 4, 6, 9"], 2.5)
    clustered = box(axes, 8.0, 3.35, "Spheres, clustered", [
        f"level {top}: " + min_to_max(column("spheres", top, True)), "Figs 5, 9"], 2.5)
    detection = box(axes, 6.6, 2.0, "Two-level detection", [
        "every sphere, then the triangles of those met",
        "tests a query, level {}: {} and {}".format(top, min_to_max(column("tests_per_query", top, False)),
                                                    min_to_max(column("tests_per_query", top, True)))], 3.9)
    for method in methods:
        arrow(axes, mesh, method)
        for test in (graphical, single, clustered):
            axes.plot([method[0], test[0]], [method[2], test[1]], color="0.75", linewidth=0.7, zorder=0)
    arrow(axes, single, (detection[0] - 0.8, detection[1]))
    arrow(axes, clustered, (detection[0] + 0.8, detection[1]))
    scores = read(pathlib.Path(directory) / "table2.csv")
    named = {method: name.split(" ", 1)[1] for method, name in METHODS}
    ranked = sorted(scores, key=lambda row: -number(row, "total"))
    lines = ["five criteria, 0 to 5 each, their sum"]
    if ranked:
        lines.append(", ".join(f"{named[row['method']]} {number(row, 'total'):.1f}" for row in ranked))
    evaluation = box(axes, 4.7, 0.6, "Evaluation (Table 2)", lines, 6.2)
    arrow(axes, graphical, (3.2, evaluation[1]))
    arrow(axes, detection, (6.2, evaluation[1]))
    axes.set_title(f"Choi & Sung 2017, Fig. 1: the flow of the comparison, {len(rows)} rows of Table 1", fontsize=12,
                   fontweight="bold", loc="left")
    figure.tight_layout()
    return figure
