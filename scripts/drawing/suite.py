"""suite.csv as one picture: scenes by properties of their cells, and in each the worst ratio of the fastest rival's time to
that of the best of ours. Darker is worse, and a frame and bold type say where we lose."""
import math

from .layout import label, room_for
from .results import NothingToDraw, Record, rows_of, shortened, unique

TEXTS = ["mesh", "trajectory", "query", "reach", "caches", "ours", "status"]
RATIOS = ["exact_ratio", "any_ratio", "exact_tail_ratio", "any_tail_ratio"]
COLUMNS = TEXTS + RATIOS
CELL_WIDTH, CELL_HEIGHT = 0.4, 0.2  # inches
GAP = 0.35  # columns between two groups
BEST, DARKEST = 8.0, 0.25  # the ratios where the colours end
SHOWN = {"exact_ratio": "mean, against exact rivals", "any_ratio": "mean, against all rivals",
         "exact_tail_ratio": "slowest queries, against exact rivals", "any_tail_ratio": "slowest queries, against all rivals"}


class Row(Record):
    """One row of suite.csv."""

    def __init__(self, record, line):
        super().__init__(record, line, TEXTS, RATIOS)
        self.shape, _, self.speed = self.trajectory.partition(":speed=")
        for column in RATIOS:
            if record.get(column.replace("_ratio", "_counts")) == "0":  # of the stress, or too short to be compared
                setattr(self, column, math.nan)

    def properties(self):
        """(group, value) of each column of the picture that this cell is in."""
        return [("all", "worst"), *([(self.shape, self.speed)] if self.speed else [("other", self.shape)]),
                ("query", self.query), ("reach", self.reach), ("caches", self.caches)]


def read(path):
    return rows_of(path, COLUMNS, Row)


ORDER = ["all", "slide", "approach", "hover", "other", "query", "reach", "caches"]


def percent_of(value):
    return math.inf if value == "inf" else float(value[:-1]) if value.endswith("%") else 0.0


def columns_of(rows):
    found = unique(pair for row in rows for pair in row.properties())
    known = [pair for group in ORDER for pair in sorted((p for p in found if p[0] == group), key=lambda p: (percent_of(p[1]), p[1]))]
    return known + [pair for pair in found if pair[0] not in ORDER]


def worst(rows, column):
    """The least ratio, or NaN where nothing was measured."""
    return min((getattr(row, column) for row in rows if not math.isnan(getattr(row, column))), default=math.nan)


def shade(ratio):
    """0 for the darkest to 1 for white, by the logarithm."""
    low, high = math.log(DARKEST), math.log(BEST)
    return (min(max(math.log(ratio), low), high) - low) / (high - low)


def written(ratio):
    return f"{ratio:.2f}" if ratio < 1 else f"{ratio:.1f}" if ratio < 10 else f"{ratio:.0f}"


def draw_suite(plt, rows, column, source):
    from matplotlib import colormaps
    rows = [row for row in rows if row.ours == "best"]
    if not any(getattr(row, column) > 0 for row in rows):
        raise NothingToDraw("no cell was measured")
    colours = colormaps["cividis"]
    meshes, columns = unique(row.mesh for row in rows), columns_of(rows)
    meshes.sort(key=lambda mesh: (worst([row for row in rows if row.mesh == mesh], column) or math.inf, mesh))
    places, groups, x = [], [], 0.0
    for i, (group, _) in enumerate(columns):
        if i and group != columns[i - 1][0]:
            x += GAP
        if not i or group != columns[i - 1][0]:
            groups.append((group, x))
        places.append(x)
        x += 1
    left = room_for(meshes)
    width, height = left + CELL_WIDTH * x + 0.3, 1.75 + CELL_HEIGHT * len(meshes) + 0.75
    figure, axes = plt.subplots(figsize=(width, height))
    figure.subplots_adjust(left=left / width, right=1 - 0.3 / width, top=1 - 1.75 / height, bottom=0.75 / height)
    axes.set_xlim(-0.1, x + 0.1)
    axes.set_ylim(len(meshes), -0.05)
    for line, mesh in enumerate(meshes):
        for place, pair in zip(places, columns):
            draw_cell(plt, axes, place, line, [row for row in rows if row.mesh == mesh and pair in row.properties()], column,
                      colours)
    axes.set_yticks([line + 0.5 for line in range(len(meshes))], [shortened(mesh, 28) for mesh in meshes], fontsize=8)
    axes.set_xticks([place + 0.5 for place in places], [value for _, value in columns], fontsize=8, rotation=60, ha="left")
    axes.xaxis.tick_top()
    axes.tick_params(length=0, pad=2)
    for group, start in groups:
        axes.annotate(group, (start, 0), xycoords=("data", "axes fraction"), xytext=(0, -12), textcoords="offset points",
                      fontsize=8, fontweight="bold", annotation_clip=False)
    for spine in axes.spines.values():
        spine.set_visible(False)
    legend = [plt.Rectangle((0, 0), 1, 1, facecolor=colours(shade(ratio)), label=f"{ratio:g}") for ratio in (0.25, 0.5, 1, 2, 4, 8)]
    legend += [plt.Rectangle((0, 0), 1, 1, facecolor="white", edgecolor="black", linewidth=1.6, label="framed: a rival is ahead"),
               plt.Rectangle((0, 0), 1, 1, facecolor="white", edgecolor="0.8", hatch="///", label="not measured, or in no score")]
    measured = sum(1 for row in rows if getattr(row, column) > 0)
    label(figure, "The suite: fastest rival's time over ours, worst cell of each property",
          f"{SHOWN[column]}; {len(meshes)} scenes, {measured} of {len(rows)} cells; above 1 the best of ours is ahead", source,
          "", legend, "columns: speed of each motion in percent of the diagonal a tick, query, reach, caches")
    return figure


def draw_cell(plt, axes, x, y, rows, column, colours):
    ratio = worst(rows, column)
    if math.isnan(ratio):
        axes.add_patch(plt.Rectangle((x, y), 0.96, 0.94, facecolor="white", edgecolor="0.8", hatch="///", linewidth=0))
        return
    lost = ratio < 1
    axes.add_patch(plt.Rectangle((x + 0.02, y + 0.02), 0.92, 0.9, facecolor=colours(shade(ratio)),
                                 edgecolor="black" if lost else "none", linewidth=1.6 if lost else 0))
    axes.text(x + 0.48, y + 0.5, written(ratio), fontsize=7, ha="center", va="center", fontweight="bold" if lost else "normal",
              color="white" if shade(ratio) < 0.55 else "black")
