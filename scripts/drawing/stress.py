"""stress.csv as one picture: contestants by families, and in each cell what went wrong there, told by colour and sign."""
import collections

from . import detectors
from .layout import Matrix
from .results import NothingToDraw, Record, rows_of, unique

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


class Row(Record):
    """One row of stress.csv."""

    def __init__(self, record, line):
        super().__init__(record, line, TEXTS, counts=COUNTS)
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
    matrix = Matrix(plt, names, families)
    for name in names:
        for family in families:
            if cells[name, family]:
                kind, text = kind_and_text(cells[name, family])
                matrix.fill(name, family, kind.colour, text, kind.ink,
                            "bold" if kind.name in ("wrong", "crashed", "timeout") else "normal")
    answers = sum(row.probes for row in rows)
    hard = sum(row.probes for row in rows if row.adversarial)
    return matrix.finish("Stress: what share of the answers was wrong, by contestant and family",
                         f"queries: {', '.join(unique(row.query for row in rows))}; {answers:,.0f} answers against the exact "
                         f"oracle, {hard:,.0f} of them at the edge of contact", source,
                         [(kind.colour, kind.meaning) for kind in KINDS])
