#!/usr/bin/python3
"""Draws the path of one probe through the processes: docs/pictures/probe.svg. The numbers are those of the table in
docs/architecture.md."""
import sys

sys.dont_write_bytecode = True
from rooms import BOX, MARGIN, ROOT, box, framed, line, svg  # noqa: E402

PICTURE = ROOT / "docs" / "pictures" / "probe.svg"
GAP, HEAD, LANE_GAP, PAD = 14, 46, 26, 14  # pixels: between rows, above them, between lanes, beside the boxes
LANES = {"touchmark": 330, "shared memory": 210, "touchmark-worker, one a contestant": 340}  # title: width
PROGRAM, SHARED, WORKER = range(3)
BOXES = {  # (lane, row): text
    (PROGRAM, 0): "1 trajectory: a position a tick",
    (PROGRAM, 1): "2 workload: steps of probe and reach",
    (PROGRAM, 2): "3 write_input",
    (SHARED, 2): "mesh and traces",
    (PROGRAM, 3): "4 start the process",
    (WORKER, 3): "5 build: D::build(mesh, options)",
    (PROGRAM, 4): "6 calibrate, 7 choose the sample",
    (WORKER, 4): "first steps, timed",
    (PROGRAM, 5): "request: answer",
    (WORKER, 5): "8 loop of ContestantOf<D>",
    (WORKER, 6): "9 D::nearest(probe, reach, session)",
    (WORKER, 7): "10 answer, 11 checksum",
    (SHARED, 7): "answers and work",
    (PROGRAM, 7): "checksums compared",
    (PROGRAM, 8): "12 judge, by the oracle's truth",
    (PROGRAM, 9): "13 requests in random turns",
    (WORKER, 9): "the same loop, timed",
    (WORKER, 10): "times and checksum",
    (PROGRAM, 10): "checksum of each timed pass compared",
    (PROGRAM, 11): "14 row",
    (PROGRAM, 12): "15 results.csv",
}
# Boxes in their order; where two follow from one, or one from two, there are several paths.
PATHS = [[(PROGRAM, 0), (PROGRAM, 1), (PROGRAM, 2), (PROGRAM, 3), (PROGRAM, 4), (PROGRAM, 5), (WORKER, 5), (WORKER, 6), (WORKER, 7),
         (SHARED, 7), (PROGRAM, 7), (PROGRAM, 8), (PROGRAM, 9), (WORKER, 9), (WORKER, 10), (PROGRAM, 10), (PROGRAM, 11), (PROGRAM, 12)],
        [(PROGRAM, 2), (SHARED, 2), (WORKER, 3)], [(PROGRAM, 3), (WORKER, 3)], [(PROGRAM, 4), (WORKER, 4)]]


def main():
    lefts, left = [], MARGIN
    for width in LANES.values():
        lefts.append(left)
        left += width + LANE_GAP
    widths = list(LANES.values())
    height = 2 * MARGIN + HEAD + (1 + max(row for _, row in BOXES)) * (BOX + GAP)

    def middle(lane, row):
        return lefts[lane] + widths[lane] / 2, MARGIN + HEAD + row * (BOX + GAP) + BOX / 2

    def arrow(start, end):
        (x, y), (to_x, to_y) = middle(*start), middle(*end)
        if start[0] == end[0]:
            return line([(x, y + BOX / 2), (to_x, to_y - BOX / 2 - 2)])
        side = 1 if to_x > x else -1
        return line([(x + side * (widths[start[0]] / 2 - PAD), y), (to_x - side * (widths[end[0]] / 2 - PAD + 2), to_y)])
    body = []
    for (title, width), left in zip(LANES.items(), lefts):
        body += framed(title, left, MARGIN, width, height - 2 * MARGIN, [])
    body += [arrow(*pair) for path in PATHS for pair in zip(path, path[1:])]
    for (lane, row), text in BOXES.items():
        body += box(*middle(lane, row), widths[lane] - 2 * PAD, text)
    total = lefts[-1] + widths[-1] + MARGIN
    PICTURE.write_text(svg(total, height, "The path of a probe: program, shared memory, worker process", body), encoding="utf-8")


if __name__ == "__main__":
    main()
