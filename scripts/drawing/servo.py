"""servo_histogram.csv as one picture: how many ticks came later than a time, both axes logarithmic, as users of cyclictest
know it. A line ends at the latest tick."""
import collections

from . import detectors
from .layout import canvas, duration, label, log_axis, percent
from .results import NothingToDraw, number, rows_of, shortened, unique

COLUMNS = ["detector", "options", "trajectory", "loop", "time", "up_to_ns", "ticks"]
IDLE = {"color": "0.55", "linestyle": ":", "linewidth": 1.3}


class Bucket:
    """One row of servo_histogram.csv."""

    def __init__(self, record, line):
        self.name = record["detector"] + (":" + record["options"] if record["options"] else "")
        self.trajectory, self.loop, self.time = record["trajectory"], record["loop"], record["time"]
        self.up_to_ns, self.ticks = (number(record[column], column, line) for column in ("up_to_ns", "ticks"))


def read(path):
    return rows_of(path, COLUMNS, Bucket)


def later(buckets):
    """(time, share of the ticks that came later than the bucket before it) of each bucket."""
    buckets = sorted(buckets, key=lambda bucket: bucket.up_to_ns)
    total = left = sum(bucket.ticks for bucket in buckets)
    points = []
    for bucket in buckets:
        points.append((max(bucket.up_to_ns, 1), left / total))
        left -= bucket.ticks
    return points


def draw_servo(plt, buckets, about, source):
    curves = collections.defaultdict(list)
    for bucket in buckets:
        if bucket.time in ("latency", "query"):
            curves[bucket.name, bucket.loop, bucket.time].append(bucket)
    names = detectors.in_order(unique(bucket.name for bucket in buckets))
    if not curves:
        raise NothingToDraw("no tick")
    settings = about.get("servo", {})
    rate = settings.get("rate_hz", 0)
    shares = {key: later(rows) for key, rows in curves.items()}
    times = [time for points in shares.values() for time, _ in points] + ([1e9 / rate] if rate else [])
    least = min(share for points in shares.values() for _, share in points)
    figure, (axes,) = canvas(plt, 1, 7.5, 4.2, bottom=1.35)
    log_axis(axes.xaxis, min(times) / 1.5, max(times) * 2, duration)
    log_axis(axes.yaxis, least / 2, 1.3, percent)
    for (name, loop, time), points in sorted(shares.items()):
        look = IDLE if loop == "idle" else {**detectors.line(name), "color": detectors.colour(name),
                                            "alpha": 1 if time == "latency" else 0.45}
        axes.step([time for time, _ in points], [share for _, share in points], where="pre", **look)
    if rate:
        axes.axvline(1e9 / rate, color="#c0392b", linewidth=1)
    legend = [plt.Line2D([], [], label=shortened(name), color=detectors.colour(name), **detectors.line(name)) for name in names]
    legend += [plt.Line2D([], [], label="pale: the query alone", color="0.75"),
               plt.Line2D([], [], label="the same loop, nothing asked", **IDLE)]
    if rate:
        legend.append(plt.Line2D([], [], label=f"the period: {duration(1e9 / rate)}", color="#c0392b", linewidth=1))
    asked = f"{buckets[0].trajectory}, {settings.get('ticks', 0):,} ticks at {rate:g} Hz, load {settings.get('load', '')}, " \
            f"{settings.get('scheduler', '')}" if settings else buckets[0].trajectory
    label(figure, "Paced loop: share of the ticks that came later than a time", asked, source,
          "from the scheduled start of a tick to its answer (log scale)", legend)
    return figure
