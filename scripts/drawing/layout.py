"""What all pictures share: a title, room for names and legends, axes with units, and files that appear when complete."""
import math
import os
import re
import warnings

from . import detectors
from .results import shortened, unique

TRAJECTORIES = {"slide": "o", "slide:speed=0.4%": "p", "approach": "s", "hover": "D", "jump": "^", "tap": "v", "edge": "P", "cross": "X", "hand": "*"}
FILLS = {"o": 0.0, "p": 1.0, "s": 0.5, "D": 1.0, "^": 0.0, "v": 0.5, "P": 1.0, "X": 0.0}  # how much of the colour
OTHER_MARKERS = "*hd<>"
NARROWEST = 7.5  # inches: what a title and a legend need
GRID = {"color": "0.85", "linewidth": 0.6}


def duration(ns):
    for unit, size in (("s", 1e9), ("ms", 1e6), ("µs", 1e3)):
        if ns >= 0.9999 * size:
            return f"{ns / size:.3g} {unit}"
    return f"{ns:.3g} ns"


def rate(hz):
    for unit, size in (("GHz", 1e9), ("MHz", 1e6), ("kHz", 1e3)):
        if hz >= 0.9999 * size:
            return f"{hz / size:.3g} {unit}"
    return f"{hz:.3g} Hz"


def count(value):
    return f"{value:,.0f}"


def percent(share):
    """Two digits, without an exponent."""
    return plain(float(f"{100 * share:.2g}")) + " %"


def plain(value):
    """Without an exponent, however small."""
    return f"{value:,.0f}" if value >= 100 else f"{value:.10f}".rstrip("0").rstrip(".") if value < 1e-4 else f"{value:g}"


def log_axis(axis, low, high, written):
    """Logarithmic from low to high; labelled at 1, 2, 5 where a decade has room for them, evenly within less than one."""
    from matplotlib import ticker
    axes = axis.axes
    getattr(axes, f"set_{axis.axis_name}scale")("log")
    getattr(axes, f"set_{axis.axis_name}lim")(low, high)
    decades = math.log10(high / low)
    axis.set_minor_locator(ticker.LogLocator(10, subs=range(2, 10) if decades < 8 else (), numticks=30))
    if decades < 0.75:
        axis.set_major_locator(ticker.MaxNLocator(5, steps=(1, 2, 2.5, 5, 10)))
        axis.set_minor_locator(ticker.NullLocator())
    else:
        axis.set_major_locator(ticker.LogLocator(10, subs=(1, 2, 5) if decades < 2.2 else (1,), numticks=9))
    axis.set_major_formatter(lambda value, _: written(value))
    axis.set_minor_formatter(ticker.NullFormatter())
    axes.grid(axis=axis.axis_name, **GRID)
    axes.set_axisbelow(True)


def trajectory_mark(trajectory, among, colour, size=7):
    """Shape and filling by trajectory, the same in every picture; `among`: all that are drawn."""
    others = sorted(set(among) - set(TRAJECTORIES))
    shape = TRAJECTORIES.get(trajectory) or OTHER_MARKERS[others.index(trajectory) % len(OTHER_MARKERS)]
    return {"marker": shape, "color": colour, "markeredgecolor": colour, "markersize": size,
            "markerfacecolor": tinted(colour, FILLS.get(shape, 1.0))}


def trajectory_legend(plt, trajectories, **line):
    return [plt.Line2D([], [], label=shortened(trajectory, 30), **trajectory_mark(trajectory, trajectories, "#333333"), **line)
            for trajectory in trajectories]


def tinted(colour, strength):
    from matplotlib import colors
    return tuple(1 - strength * (1 - channel) for channel in colors.to_rgb(colour))


def trajectories_of(rows):
    """Each once: the known ones in their fixed order, then the others as they come."""
    seen = unique(row.trajectory for row in rows)
    return [known for known in TRAJECTORIES if known in seen] + [other for other in seen if other not in TRAJECTORIES]


def what_was_asked(rows):
    """The line under a title that makes a picture readable alone."""
    meshes = unique((row.mesh, row.triangles) for row in rows)
    mesh, triangles = meshes[0]
    parts = [shortened(mesh)]
    if math.isfinite(triangles):
        parts[0] += f" ({int(triangles):,} triangles)"
    if len(meshes) > 1:
        all_of_them = ", ".join(shortened(mesh) for mesh, _ in meshes)
        parts[0] = all_of_them if len(all_of_them) < 60 else \
            f"{len(meshes)} meshes, {shortened(meshes[0][0])} to {shortened(meshes[-1][0])}"
    parts.append(f"query: {rows[0].query}")
    radii = sorted(unique(row.radius for row in rows if math.isfinite(row.radius)))
    if radii:
        span = f"{radii[0]:.4g}" if len(radii) == 1 else f"{radii[0]:.4g} to {radii[-1]:.4g}"
        parts.append(f"probe radius {span} mesh units")
    steps = unique(int(row.steps) for row in rows if math.isfinite(row.steps))
    if steps:
        parts.append(("" if len(steps) == 1 else "up to ") + f"{max(steps):,} steps a trajectory")
    return ", ".join(parts)


def name_axis(axes, names):
    axes.set_yticks(range(len(names)), [shortened(name) for name in names])
    axes.set_ylim(len(names) - 0.5, -0.5)
    for y in range(0, len(names), 2):
        axes.axhspan(y - 0.5, y + 0.5, color="0.96", zorder=0)


def note(axes, y, text):
    """In place of a mark, for a contestant that has none here."""
    axes.annotate(text, (0.02, y), xycoords=("axes fraction", "data"), va="center", fontsize=8, style="italic",
                  color="0.3", annotation_clip=False)


def canvas(plt, panels, panel_width, panel_height, left=0.9, right=0.25, bottom=1.05, gap=(0.15, 0.55), columns=None,
           share_x=True, share_y=True, heights=None, top=1.25):
    """A figure with room for the title above `panels` panels and a legend below or to the right. All in inches; `heights`:
    of each line of panels, where they differ."""
    columns = columns or min(panels, 2 if panels in (2, 4) else 3)
    lines = -(-panels // columns)
    width = left + columns * panel_width + (columns - 1) * gap[0] + right
    panel_width += max(0.0, NARROWEST - width) / columns
    width = max(width, NARROWEST)
    heights = heights or [panel_height] * lines
    height = top + sum(heights) + (lines - 1) * gap[1] + bottom
    figure, axes = plt.subplots(lines, columns, sharex=share_x, sharey=share_y, squeeze=False, figsize=(width, height),
                                gridspec_kw={"height_ratios": heights})
    figure.subplots_adjust(left=left / width, right=1 - right / width, top=1 - top / height, bottom=bottom / height,
                           hspace=gap[1] * lines / sum(heights), wspace=gap[0] / panel_width)
    shown = list(axes.flat)
    for spare in shown[panels:]:
        spare.set_visible(False)
    for lowest in shown[max(0, panels - columns):panels]:
        lowest.tick_params(labelbottom=True)
    for panel in shown:
        panel.tick_params(labelsize=9)
    return figure, shown[:panels]


class Matrix:
    """A figure of coloured cells, a line a name, a column a family."""

    CELL_WIDTH, CELL_HEIGHT = 0.56, 0.27  # inches

    def __init__(self, plt, names, families):
        self.plt, self.names, self.families, self.used = plt, names, families, set()
        left, right, top, bottom = room_for(names) + 0.1, 0.3, 2.2, 1.1
        width = max(left + self.CELL_WIDTH * len(families) + right, 11.0)
        height = top + self.CELL_HEIGHT * len(names) + bottom
        self.figure, self.axes = plt.subplots(figsize=(width, height))
        self.figure.subplots_adjust(left=left / width, right=(left + self.CELL_WIDTH * len(families)) / width,
                                    top=1 - top / height, bottom=bottom / height)

    def fill(self, name, family, colour, text, ink, weight="normal"):
        x, y = self.families.index(family), self.names.index(name)
        self.used.add(colour)
        self.axes.add_patch(self.plt.Rectangle((x - 0.5, y - 0.5), 1, 1, facecolor=colour, edgecolor="white", linewidth=1.2))
        self.axes.text(x, y, text, ha="center", va="center", fontsize=8, color=ink, fontweight=weight)

    def finish(self, title, asked, source, meanings):
        """meanings: (colour, text) in the legend's order; those of colours that no cell has are left out."""
        axes = self.axes
        axes.set_xlim(-0.5, len(self.families) - 0.5)
        axes.set_ylim(len(self.names) - 0.5, -0.5)
        axes.set_xticks(range(len(self.families)), self.families, rotation=50, ha="left", fontsize=9)
        axes.xaxis.tick_top()
        axes.set_yticks(range(len(self.names)), [shortened(name) for name in self.names], fontsize=9)
        axes.tick_params(length=0)
        for spine in axes.spines.values():
            spine.set_visible(False)
        legend = [self.plt.Rectangle((0, 0), 1, 1, facecolor=colour, edgecolor="0.5", linewidth=0.6, label=meaning)
                  for colour, meaning in meanings if colour in self.used]
        label(self.figure, title, asked, source, "", legend)
        return self.figure


def room_for(names):
    """Inches that the longest of these names takes beside an axis."""
    return 0.3 + 0.085 * min(48, max(map(len, names)))


def label(figure, title, asked, source, axis="", legend=(), more=""):
    """Title above, the axis' meaning and the legend below, all at fixed distances from the border."""
    width, inch = figure.get_figwidth(), 1 / figure.get_figheight()
    for down, text, size, weight in ((0.18, title, 13, "bold"), (0.46, asked, 9, "normal"), (0.63, source, 9, "normal"),
                                     (0.80, more, 9, "normal")):
        needed = len(text) * size * (0.0086 if weight == "bold" else 0.0075)  # inches
        figure.text(0.1 / width, 1 - down * inch, text, fontsize=size * min(1.0, (width - 0.3) / max(needed, 1.0)),
                    fontweight=weight, va="top")
    panels = figure.subplotpars
    columns = entries_per_line([handle.get_label() for handle in legend], width - 0.4)
    figure.text((panels.left + panels.right) / 2, legend_height(legend, width) * inch, axis, fontsize=9, ha="center",
                va="center")
    if legend:
        figure.legend(handles=legend, loc="lower center", bbox_to_anchor=(0.5, 0.0), fontsize=9, frameon=False,
                      ncols=columns)


def legend_height(legend, width):
    """Inches from the lower border to the axis' meaning above a legend in a figure of at least this width."""
    lines = -(-len(legend) // entries_per_line([handle.get_label() for handle in legend], width - 0.4))
    return max(0.62, 0.3 + 0.2 * lines)


def entries_per_line(labels, width):
    """As many as fit; a legend is filled column by column, the first ones with one more where it does not come out even."""
    for columns in range(len(labels), 1, -1):
        lines, longer = divmod(len(labels), columns)
        starts = [k * lines + min(k, longer) for k in range(columns + 1)]
        widest = [max(map(len, labels[start:end])) for start, end in zip(starts, starts[1:])]
        if sum(0.75 + 0.068 * most for most in widest) <= width:
            return columns
    return 1


def name_panel(axes, text):
    axes.set_title(shortened(text, 64), fontsize=10, loc="left", fontweight="bold")


def detector_legend(plt, figure, axes, names, lines=True, extra=()):
    """To the right of these axes, in the fixed order."""
    handles = [plt.Line2D([], [], label=shortened(name), **detectors.mark(name),
                          **(detectors.line(name) if lines else {"linestyle": ""})) for name in detectors.in_order(names)]
    axes.legend(handles=handles + list(extra), loc="upper left", bbox_to_anchor=(1.02, 1.0), borderaxespad=0, fontsize=9,
                frameon=False, handlelength=3 if lines else 1.5, labelspacing=0.55)


def spread(times, span, near=0.035):
    """A level for each of the ascending times, so that no two on one level lie closer than `near` of the span."""
    last = []
    levels = []
    for time in times:
        position = math.log(time) / span
        level = next((k for k, other in enumerate(last) if position - other > near), len(last))
        last[level:level + 1] = [position]
        levels.append(level)
    return levels


def telling_words(keys):
    """By key, a tuple: those of its parts that tell it from the others, the later ones only where the earlier do not."""
    keys = unique(keys)
    telling = [k for k in range(len(keys[0]) if keys else 0)
               if len({key[:k + 1] for key in keys}) > len({key[:k] for key in keys})]
    return {key: [key[k] for k in telling if key[k] != ""] for key in keys}


def in_file_name(words):
    words = [f"{word:.6g}" if isinstance(word, float) else str(word) for word in words]
    return "".join("-" + re.sub(r"[^A-Za-z0-9.]+", "_", word) for word in words)


def whole(figure):
    """The figure's box in inches, and as much more as its texts need: no label is cut off at the border."""
    from matplotlib import transforms
    size = transforms.Bbox.from_bounds(0, 0, *figure.get_size_inches())
    needed = figure.get_tightbbox(figure.canvas.get_renderer())
    return transforms.Bbox.union([size, needed.padded(0.04)])


def save(figure, stem):
    """Under its final name only when complete; the same bytes for the same numbers."""
    box = whole(figure)
    for kind, metadata in (("png", {"Software": None}), ("svg", {"Date": None, "Creator": None})):
        part = stem.with_name(f".{stem.name}.{kind}.part")
        figure.savefig(part, format=kind, dpi=110, metadata=metadata, bbox_inches=box)
        os.replace(part, stem.with_name(f"{stem.name}.{kind}"))


def load_pyplot():
    import matplotlib  # late: a garbled file is told at once
    matplotlib.use("agg")
    matplotlib.rcParams.update({"svg.hashsalt": "touchmark", "font.family": "DejaVu Sans", "hatch.linewidth": 0.6})
    matplotlib.rcParams["text.parse_math"] = False  # a name may hold a dollar
    warnings.filterwarnings("ignore", "Glyph .* missing")  # and letters that the font has not
    from matplotlib import pyplot
    return pyplot
