"""stress.csv as one picture: contestants by families, and in each cell what went wrong there, told by colour and sign."""
import collections
import math

from . import detectors
from .layout import label, room_for
from .results import NothingToDraw, number, rows_of, shortened, unique

TEXTS = ["detector", "options", "family", "query", "status"]
COUNTS = ["probes", "missed", "false_contacts", "wrong_triangle", "beyond_bound", "wrong_point", "wrong_normal",
          "malformed", "crashes", "timeouts", "refusals", "adversarial"]
COLUMNS = TEXTS + COUNTS
Kind = collections.namedtuple("Kind", "name colour ink meaning")
KINDS = [  # the worst first
    Kind("crashed", "#1a1a1a", "white", "C  crashed"),
    Kind("timeout", "#4d4d4d", "white", "T  did not come back"),
    Kind("wrong", "#c0392b", "white", "12%  contacts missed or made up, or answers that are no numbers"),
    Kind("inexact", "#f3c14b", "black", "~12%  contact told rightly; triangle, distance, point or normal off by more than declared"),
    Kind("refused", "#c9cdd2", "black", "R  refused the mesh"),
    Kind("unsupported", "#ffffff", "black", "–  does not answer such queries"),
    Kind("ok", "#dcefdc", "#2e6b2e", "✓  no error beyond what is declared"),
]
SIGNS = {"crashed": "C", "timeout": "T", "refused": "R", "unsupported": "–", "ok": "✓"}
CELL_WIDTH, CELL_HEIGHT = 0.56, 0.27  # inches


class Row:
    """One row of stress.csv."""

    def __init__(self, record, line):
        for column in TEXTS:
            setattr(self, column, record.get(column) or "")
        for column in COUNTS:
            value = number(record.get(column), column, line)
            setattr(self, column, 0 if math.isnan(value) else value)
        self.name = self.detector + (":" + self.options if self.options else "")


def read(path):
    return rows_of(path, COLUMNS, Row)


def rank(status):
    names = [kind.name for kind in KINDS]
    return names.index(status) if status in names else names.index("crashed")


def kind_and_text(rows):
    """Of one contestant in one family, all its queries together."""
    asked = [row for row in rows if row.status != "unsupported"]  # the other queries count
    kind = min((KINDS[rank(row.status)] for row in asked or rows), key=KINDS.index)
    if kind.name == "wrong":
        return kind, share(sum(row.missed + row.false_contacts + row.malformed for row in rows), rows)
    if kind.name == "inexact":
        off = sum(row.wrong_triangle + max(row.beyond_bound, row.wrong_point, row.wrong_normal) for row in rows)
        return kind, "~" + share(off, rows)
    return kind, SIGNS[kind.name]


def share(wrong, rows):
    """What part of the answers, in at most five characters: families and contestants have different numbers of them."""
    answers = sum(row.probes for row in rows)
    percent = 100 * min(1, wrong / answers) if answers else 100
    return "<0.1%" if percent < 0.095 else f"{percent:.1f}%" if percent < 9.95 else f"{percent:.0f}%"


def draw_stress(plt, rows, source):
    if not rows:
        raise NothingToDraw("no row")
    names, families = detectors.in_order(row.name for row in rows), unique(row.family for row in rows)
    cells = collections.defaultdict(list)
    for row in rows:
        cells[row.name, row.family].append(row)
    left, right, top, bottom = room_for(names) + 0.1, 0.3, 2.2, 1.1
    width = max(left + CELL_WIDTH * len(families) + right, 11.0)
    height = top + CELL_HEIGHT * len(names) + bottom
    figure, axes = plt.subplots(figsize=(width, height))
    figure.subplots_adjust(left=left / width, right=(left + CELL_WIDTH * len(families)) / width, top=1 - top / height,
                           bottom=bottom / height)
    used = set()
    for y, name in enumerate(names):
        for x, family in enumerate(families):
            if cells[name, family]:
                kind, text = kind_and_text(cells[name, family])
                used.add(kind)
                axes.add_patch(plt.Rectangle((x - 0.5, y - 0.5), 1, 1, facecolor=kind.colour, edgecolor="white",
                                             linewidth=1.2))
                axes.text(x, y, text, ha="center", va="center", fontsize=8, color=kind.ink,
                          fontweight="bold" if kind.name in ("wrong", "crashed", "timeout") else "normal")
    axes.set_xlim(-0.5, len(families) - 0.5)
    axes.set_ylim(len(names) - 0.5, -0.5)
    axes.set_xticks(range(len(families)), families, rotation=50, ha="left", fontsize=9)
    axes.xaxis.tick_top()
    axes.set_yticks(range(len(names)), [shortened(name) for name in names], fontsize=9)
    axes.tick_params(length=0)
    for spine in axes.spines.values():
        spine.set_visible(False)
    answers = sum(row.probes for row in rows)
    hard = sum(row.probes for row in rows if row.adversarial)
    legend = [plt.Rectangle((0, 0), 1, 1, facecolor=kind.colour, edgecolor="0.5", linewidth=0.6, label=kind.meaning)
              for kind in KINDS if kind in used]
    label(figure, "Stress: what share of the answers was wrong, by contestant and family",
          f"queries: {', '.join(unique(row.query for row in rows))}; {answers:,.0f} answers against the exact oracle, "
          f"{hard:,.0f} of them at the edge of contact", source, "", legend)
    return figure
