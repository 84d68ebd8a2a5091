#!/usr/bin/python3
"""Draws which folder includes which, out of the #include lines: docs/pictures/rooms.svg.

An arrow that follows from others is left out. The same sources give the same bytes, so --check can tell whether the
picture is still true."""
import argparse
import html
import importlib.machinery
import importlib.util
import itertools
import pathlib
import sys

sys.dont_write_bytecode = True
ROOT = pathlib.Path(__file__).resolve().parents[2]
PICTURE = ROOT / "docs" / "pictures" / "rooms.svg"
OWN_FILES = {"core": "probe.h, detector.h, ...", "baselines": "reach.h", "bench": "main.cpp"}  # in the layer's own folder
TITLES = {"core": "the library", "baselines": "the rivals", "bench": "the program"}

ROW, BOX, GAP, LETTER, MARGIN = 54, 28, 18, 7.6, 16  # pixels: between rows, of a box, between boxes, of a letter, around


def check_layers():
    """The script that knows the order of the folders."""
    loader = importlib.machinery.SourceFileLoader("check_layers", str(ROOT / "scripts" / "check_layers"))
    module = importlib.util.module_from_spec(importlib.util.spec_from_loader("check_layers", loader))
    loader.exec_module(module)
    return module


def included_rooms(layer, rules):
    """Room to the rooms of the same layer that its files include."""
    rooms = rules.ROOMS.get(layer) or ["", *sorted(folder.parent.name for folder in (ROOT / layer).glob("*/CMakeLists.txt"))]
    found = {room: set() for room in rooms}
    for file in sorted((ROOT / layer).rglob("*")):
        path = file.relative_to(ROOT).as_posix()
        if file.suffix not in (".h", ".cpp", ".inl") or path.startswith("bench/regression/driver/"):
            continue  # the gate's driver is a program of its own
        for line in file.read_text(encoding="utf-8").splitlines():
            include = rules.INCLUDE.match(line)
            if not include or include[1] != '"' or not include[2].startswith(layer + "/"):
                continue
            if include[2].startswith(rules.GENERATED):
                continue
            own, other = rules.room_of(path), rules.room_of(include[2])
            if own != other:
                found[own].add(other)
    return found


def all_below(found):
    """Room to every room that it depends on, directly or not."""
    below = {}

    def visit(room):
        if room not in below:
            below[room] = set(found[room]).union(*(visit(other) for other in found[room]))
        return below[room]
    for room in found:
        visit(room)
    return below


def needed_arrows(found):
    """The arrows from which all others follow."""
    below = all_below(found)
    return {room: {other for other in others if not any(other in below[third] for third in others - {other})}
            for room, others in found.items()}


def rows_of(arrows):
    """The rooms row by row, the lowest first: each above all that it includes, and what includes nothing just below its
    lowest user."""
    height = {}

    def visit(room):
        if room not in height:
            height[room] = 1 + max((visit(other) for other in arrows[room]), default=-1)
        return height[room]
    for room in arrows:
        visit(room)
    users = {room: [height[user] for user in arrows if room in arrows[user]] for room in arrows}
    for room, above in users.items():
        if above and height[room] <= 1:
            height[room] = max(height[room], min(above) - 1)
    return [[room for room in arrows if height[room] == row] for row in range(max(height.values()) + 1)]


def with_bends(rows, arrows):
    """The same where every arrow ends in the row below: a longer one gets a bend, (from, to, row), in each row between."""
    row_of = {room: number for number, row in enumerate(rows) for room in row}
    rows, short = [list(row) for row in rows], {room: [] for room in arrows}
    for room, others in arrows.items():
        for other in sorted(others):
            start = room
            for number in range(row_of[room] - 1, row_of[other], -1):
                bend = (room, other, number)
                rows[number].append(bend)
                short[start].append(bend)
                short[bend] = []
                start = bend
            short[start].append(other)
    return rows, short


def placed(rows, arrows, label):
    """Room or bend to its middle, and the width of all. Each row is put in the order that makes its arrows shortest."""
    def wide(one):
        return box_width(label(one)) + GAP
    middles, width = {}, max(sum(map(wide, row)) for row in rows)
    for number, row in enumerate(rows):
        best = None
        for order in itertools.permutations(row):
            left, trial = (width - sum(map(wide, order))) / 2, {}
            for one in order:
                trial[one] = left + wide(one) / 2
                left += wide(one)
            length = sum(abs(trial[one] - middles[other][0]) for one in order for other in arrows[one])
            if best is None or length < best[0]:
                best = length, trial
        middles.update({one: (x, (len(rows) - 1 - number) * ROW + BOX / 2) for one, x in best[1].items()})
    return middles, width


def box_width(text):
    return LETTER * len(text) + 18


def svg(width, height, title, body):
    """A whole file, white so that it can be read on a dark page."""
    return "\n".join([
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 {width:.0f} {height:.0f}" '
        f'width="{width:.0f}" font-family="DejaVu Sans, Arial, sans-serif" font-size="13">',
        f"<title>{title}</title>",
        "<style>.frame{fill:#f6f6f4;stroke:#bbb}.box{fill:#fff;stroke:#444}text{text-anchor:middle;fill:#202020}"
        ".title{font-weight:bold}.arrow{fill:none;stroke:#666;stroke-width:1.2;marker-end:url(#head)}</style>",
        '<defs><marker id="head" viewBox="0 0 8 8" refX="7" refY="4" markerWidth="7" markerHeight="7" orient="auto">'
        '<path d="M0 0L8 4L0 8z" fill="#666"/></marker></defs>',
        '<rect width="100%" height="100%" fill="#fff"/>', *body, "</svg>", ""])


def box(x, y, wide, text):
    """Around its middle."""
    return [f'<rect x="{x - wide / 2:.1f}" y="{y - BOX / 2:.1f}" width="{wide:.1f}" height="{BOX}" rx="5" class="box"/>',
            f'<text x="{x:.1f}" y="{y + 4.5:.1f}">{html.escape(text)}</text>']


def framed(title, x, y, width, height, lines):
    return [f'<rect x="{x:.1f}" y="{y:.1f}" width="{width:.1f}" height="{height:.1f}" rx="8" class="frame"/>',
            f'<text x="{x + width / 2:.1f}" y="{y + 26:.1f}" class="title">{html.escape(title)}</text>', *lines]


def line(points):
    path = "L".join(f"{x:.1f} {y:.1f}" for x, y in points)
    return f'<path d="M{path}" class="arrow"/>'


def drawn_layer(layer, rules):
    """The SVG lines of one layer, its width and its height."""
    def label(one):
        return "" if isinstance(one, tuple) else one or OWN_FILES[layer]
    found = included_rooms(layer, rules)
    rooms = list(found)
    needed = needed_arrows(found)
    rows, arrows = with_bends(rows_of(needed), needed)
    middles, width = placed(rows, arrows, label)
    lines = []
    for room in rooms:
        for other in arrows[room]:
            x, y = middles[room]
            points = [(x, y + BOX / 2)]
            while isinstance(other, tuple):
                points.append(middles[other])
                (other,) = arrows[other]
            x, y = middles[other]
            lines.append(line(points + [(x, y - BOX / 2 - 2)]))
    for room in rooms:
        lines += box(*middles[room], box_width(label(room)), label(room))
    return lines, width, (len(rows) - 1) * ROW + BOX


def picture():
    rules = check_layers()
    drawn = {layer: drawn_layer(layer, rules) for layer in TITLES}
    pad, head, between = GAP, 46, 3 * MARGIN  # around the boxes, above them, from frame to frame
    right = max(drawn[layer][1] for layer in ("core", "baselines"))
    heights = {layer: height + head + pad for layer, (_, _, height) in drawn.items()}
    left_width, right_width = drawn["bench"][1] + 2 * pad, right + 2 * pad
    total = max(heights["bench"], heights["baselines"] + between + heights["core"])
    right_x = MARGIN + left_width + between
    frames = {"bench": (MARGIN, MARGIN, left_width, total),
              "baselines": (right_x, MARGIN, right_width, heights["baselines"]),
              "core": (right_x, MARGIN + total - heights["core"], right_width, heights["core"])}
    body = []
    for layer, (x, y, width, height) in frames.items():
        lines, inner, tall = drawn[layer]
        moved = f'<g transform="translate({x + (width - inner) / 2:.1f}, {y + height - pad - tall:.1f})">'
        body += framed(f"{layer}/: {TITLES[layer]}", x, y, width, height, [moved, *lines, "</g>"])
    for layer in ("baselines", "core"):
        y = frames[layer][1] + heights[layer] / 2
        body.append(line([(MARGIN + left_width, y), (right_x - 2, y)]))
    x = right_x + right_width / 2
    body.append(line([(x, MARGIN + heights["baselines"]), (x, frames["core"][1] - 2)]))
    width = right_x + right_width + MARGIN
    return svg(width, total + 2 * MARGIN, "Which folder includes which; arrows that follow from others are left out", body)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter,
                                     epilog="example: scripts/drawing/rooms.py && git diff --stat docs/pictures")
    parser.add_argument("--check", action="store_true", help="write nothing; exit with 1 where the picture is not that of the includes")
    check, now = parser.parse_args().check, picture()
    if check and (not PICTURE.exists() or PICTURE.read_text(encoding="utf-8") != now):
        sys.exit(f"rooms: {PICTURE.relative_to(ROOT)} is not that of the includes: run scripts/drawing/rooms.py")
    if not check:
        PICTURE.parent.mkdir(parents=True, exist_ok=True)
        PICTURE.write_text(now, encoding="utf-8")
    return 0


if __name__ == "__main__":
    sys.exit(main())
