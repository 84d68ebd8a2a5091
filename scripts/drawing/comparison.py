"""A against B: the mean and the 99.9 % of each row of one results file over those of the same row of another, and how
certain the repetitions make the mean."""
import math

from . import detectors
from .history import CERTAIN, p999_ratio, relative_error
from .layout import (canvas, label, log_axis, name_axis, name_panel, note, room_for, telling_words, times,
                     trajectories_of, what_was_asked)
from .results import Unusable, finite, shortened, unique

P999_MARK = {"marker": "D", "markersize": 5, "markerfacecolor": "white", "markeredgewidth": 1.3, "linestyle": ""}


class Ratio:
    """B over A of one row."""

    def __init__(self, a, b, below_a, below_b):
        """below: the reference detector's rows of the same runs, or None. p999 is NaN where a row lacks it."""
        self.value, self.p999 = b.ns_per_query / a.ns_per_query, p999_ratio(b, a)
        parts = [a, b]
        if below_a:
            self.value *= below_a.ns_per_query / below_b.ns_per_query
            self.p999 *= p999_ratio(below_a, below_b)
            parts += [below_a, below_b]
        self.known = all(row.low > 0 or row.ns_per_query_mad >= 0 and row.repetitions > 1 for row in parts)
        error = CERTAIN * math.hypot(*map(relative_error, parts)) if self.known else 0.0
        self.low, self.high = self.value * math.exp(-error), self.value * math.exp(error)
        self.differs = self.known and not self.low <= 1 <= self.high
        self.other_answers = a.answers_checksum and b.answers_checksum and a.steps == b.steps \
            and a.answers_checksum != b.answers_checksum


def by_key(run):
    rows = {}
    for row in run.rows:
        key = row.scene + (row.trajectory, row.name)
        if key in rows:
            raise Unusable(f"{run.name}: two rows of {shortened(row.name)} on {shortened(row.trajectory)}: "
                           "compare single runs")
        rows[key] = row
    return rows


def pictures(a, b, reference):
    """(words for the file's name, rows of A, of B and the ratios by trajectory and name) of each scene."""
    rows_a, rows_b = by_key(a), by_key(b)
    shared = [key for key in rows_a if key in rows_b]
    timed = [key for key in shared if rows_a[key].ns_per_query > 0 and rows_b[key].ns_per_query > 0]
    if not timed:
        raise Unusable("the two share no row with times: same mesh, query, radius, trajectory and detector")
    scenes = unique(key[:3] for key in timed)
    words = telling_words(scenes)
    for scene in scenes:
        ratios = {}
        for key in (key for key in timed if key[:3] == scene):
            below = key[:4] + (reference,)
            if reference and below not in timed:
                raise Unusable(f"--reference {shortened(reference)}: not timed in both on {shortened(key[3])}")
            ratios[key[3:]] = Ratio(rows_a[key], rows_b[key], rows_a[below] if reference else None,
                                    rows_b[below] if reference else None)
        yield (words[scene], [row for row in a.rows if row.scene == scene], [row for row in b.rows if row.scene == scene],
               ratios)


def draw_comparison(plt, a, b, rows_a, rows_b, ratios, reference):
    names, trajectories = detectors.in_order(row.name for row in rows_a + rows_b), trajectories_of(rows_a + rows_b)
    figure, panels = canvas(plt, len(trajectories), 3.2, 0.38 * len(names), left=room_for(names), bottom=1.25,
                            gap=(0.3, 0.55), columns=min(2, len(trajectories)))
    ends = finite(end for ratio in ratios.values() for end in (ratio.low, ratio.high, ratio.p999))
    low, high = min(0.8, min(ends) / 1.1), max(1.25, max(ends) * 1.1)
    for_numbers = 0.8 if any(ratio.other_answers for ratio in ratios.values()) else 0.35
    for axes, trajectory in zip(panels, trajectories):
        log_axis(axes.xaxis, low, high * (high / low) ** for_numbers, times)
        axes.axvline(1, color="black", linewidth=1)
        name_axis(axes, names)
        name_panel(axes, shortened(trajectory, 40))
        for y, name in enumerate(names):
            if name == reference:
                note(axes, y, "the reference")
            elif (trajectory, name) in ratios:
                draw_ratio(axes, y, ratios[trajectory, name], detectors.colour(name))
            else:
                note(axes, y, why_not(rows_a, rows_b, trajectory, name))
    legend = [plt.Line2D([], [], marker="o", color="0.2", markersize=6, linewidth=1.5, label=text,
                         markerfacecolor="0.2" if filled else "white")
              for filled, text in ((True, "mean, differs from 1"), (False, "mean, does not differ or is not known to"))]
    legend.append(plt.Line2D([], [], color="0.2", **P999_MARK,
                             label="what 99.9 % of the steps take at most; its spread is not known"))
    over = f"B over A{', both over ' + reference + ' in the same run' if reference else ''} (log scale)"
    spread = "bars: about 95 %, from the spread of repetitions within each run"
    if not any(ratio.known for ratio in ratios.values()):
        spread = "no bars: the spread of the repetitions is not in the files"
    spread += "; what differs from run to run comes on top"
    label(figure, "Time of a query, B over A: to the left of 1 B is faster", what_was_asked(rows_a),
          f"A: {shortened(a.name)}, B: {shortened(b.name)}", over, legend,
          spread + ("" if reference else "; --reference takes some of it out"))
    return figure


def draw_ratio(axes, y, ratio, colour):
    """The mean, and below it the 99.9 %."""
    mean, p999 = y - 0.22, y + 0.22
    axes.plot([ratio.low, ratio.high], [mean, mean], color=colour, linewidth=1.5, solid_capstyle="butt")
    for end in (ratio.low, ratio.high) if ratio.known else ():
        axes.plot(end, mean, "|", color=colour, markersize=7)
    axes.plot(ratio.value, mean, "o", color=colour, markersize=6, markerfacecolor=colour if ratio.differs else "white")
    write(axes, mean, times(ratio.value) + ("  other answers" if ratio.other_answers else ""))
    if math.isfinite(ratio.p999):
        axes.plot(ratio.p999, p999, color=colour, **P999_MARK)
        write(axes, p999, times(ratio.p999))
    else:
        write(axes, p999, "no 99.9 %", color="0.3", style="italic")


def write(axes, y, text, **style):
    axes.annotate(text, (0.985, y), xycoords=("axes fraction", "data"), ha="right", va="center", fontsize=8, **style)


def why_not(rows_a, rows_b, trajectory, name):
    remarks = []
    for who, rows in (("A", rows_a), ("B", rows_b)):
        row = next((row for row in rows if row.trajectory == trajectory and row.name == name), None)
        if row is None:
            remarks.append(f"not in {who}")
        elif not row.ns_per_query > 0:
            remarks.append(f"{who}: {shortened(row.status, 24) or 'no times'}")
    return "; ".join(remarks)
