"""How contestants grow with the number of bodies: what touchmark scale --bodies measured."""
from . import detectors
from .layout import canvas, count, duration, label, log_axis, name_panel
from .results import NothingToDraw, number, rows_of, shortened, unique
from .scaling import memory

COLUMNS = ["detector", "options", "bodies", "motion", "place", "bytes_per_body", "publish_ns_per_body", "first_tick_ns",
           "tick_ns", "status"]
PANELS = [  # quantity, motion, place, title, how it is written
    ("tick_ns", "still", "free", "A tick in free space, bodies still", duration),
    ("tick_ns", "all", "free", "A tick in free space, all moving", duration),
    ("first_tick_ns", "all", "free", "The first tick after a frame, all moving", duration),
    ("first_tick_prepared_ns", "all", "free", "The same, each frame prepared for", duration),
    ("tick_ns", "still", "beside", "A tick beside a body, bodies still", duration),
    ("tick_ns", "all", "beside", "A tick beside a body, all moving", duration),
    ("publish_ns_per_body", "all", "free", "Placing a moved body", duration),
    ("bytes_per_body", "still", "free", "Memory of a body beside its shape", memory),
]


class Row:
    def __init__(self, record, line):
        self.name = record["detector"] + (":" + record["options"] if record["options"] else "")
        self.motion, self.place, self.done = record["motion"], record["place"], record["status"] == "ok"
        self.bodies = number(record["bodies"], "bodies", line)
        for column in ("bytes_per_body", "publish_ns_per_body", "first_tick_ns", "tick_ns"):
            setattr(self, column, number(record[column], column, line))
        prepared = "first_tick_prepared_ns"  # which older files do not have
        self.first_tick_prepared_ns = number(record.get(prepared), prepared, line)


def read(path):
    return rows_of(path, COLUMNS, Row)


def points_of(rows, quantity, motion, place):
    return [row for row in rows if row.done and (row.motion, row.place) == (motion, place) and getattr(row, quantity) > 0]


def draw_bodies(plt, rows, source):
    shown = [(panel, points_of(rows, *panel[:3])) for panel in PANELS]
    shown = [(panel, points) for panel, points in shown if points]
    if not shown:
        raise NothingToDraw("nothing was measured")
    names = detectors.in_order({row.name for _, points in shown for row in points})
    figure, panels = canvas(plt, len(shown), 4.2, 2.5, gap=(0.85, 0.6), columns=2, share_y=False,
                            bottom=1.05 + 0.2 * (len(names) // 4))
    spans = sorted(unique(row.bodies for _, points in shown for row in points))
    for axes, ((quantity, _, _, title, written), points) in zip(panels, shown):
        for name in names:
            curve = sorted((row.bodies, getattr(row, quantity)) for row in points if row.name == name)
            axes.plot([x for x, _ in curve], [y for _, y in curve], color=detectors.colour(name), **detectors.line(name))
            axes.plot([x for x, _ in curve], [y for _, y in curve], **detectors.mark(name, 6), linestyle="", zorder=3)
        values = [getattr(row, quantity) for row in points]
        name_panel(axes, title)
        log_axis(axes.xaxis, spans[0] / 1.5, spans[-1] * 1.5, count)
        log_axis(axes.yaxis, min(values) / 2, max(values) * 2, written)
    label(figure, "Growth with the number of bodies: down is better, flat is best", "field:N, nearest", source,
          "bodies (log scale); ticks: median of frames, bodies placed before the clock starts",
          [plt.Line2D([], [], label=shortened(name), **detectors.mark(name, 6), **detectors.line(name)) for name in names])
    return figure
