"""The page as a whole: what needs no script as HTML, the rest as data for the script, within a budget of bytes."""
import base64
import json
import pathlib

from drawing import detectors

from . import others, parts, tables, words
from .packing import Packer, packed
from .recording import time_of
from .replay import KINDS_OF_CHARGES, Detail, replay_of, resolution
from .steps_file import Damaged
from .visits import visits_of
from .words import escaped

BUDGET = 3_000_000  # bytes of the whole page
# As much as the budget allows.
DETAILS = [Detail(*one) for one in ((256, 16), (256, 14), (128, 14), (128, 12), (64, 12), (64, 12, False), (32, 12, False), (16, 10, False))]
WEB = pathlib.Path(__file__).resolve().parent / "web"
STYLE, LOADER = WEB / "page.css", WEB / "loader.js"
DASHES = {"full": [], "none": [7, 4], "left": [2, 3], "bottom": [8, 3, 2, 3], "right": [5, 2, 1, 2], "top": [1, 4]}
PICTURES = ["latency", "time_error", "update_rate", "errors", "cold"]


class TooLarge(Exception):
    """The page does not fit into the budget; the message says by how much."""


def page_of(recordings):
    """(HTML, remarks on what was left out or made coarser)."""
    try:
        script, style = parts.built()
    except parts.Missing as missing:
        return plain_page(recordings, str(missing))
    limit = f"to stay within {BUDGET / 1e6:g} MB"
    for detail in DETAILS:
        text = full_page(recordings, script, style, [detail] * len(recordings))
        if len(text.encode()) <= BUDGET:
            return text, [] if detail == DETAILS[0] else [f"curves have {detail.levels} levels a time, places {detail.bits} bits"
                                                               + ("" if detail.visits else ", what queries looked at is left out") + f", {limit}"]
    # With several recordings the newest keeps its replay longest.
    for first in range(1, len(recordings) + 1):
        text = full_page(recordings, script, style, [None] * first + [DETAILS[-1]] * (len(recordings) - first))
        if len(text.encode()) <= BUDGET:
            return text, [f"curves and replay of {words.listed(one.name for one in recordings[:first])} are left out, {limit}"]
    raise TooLarge(f"the page would have {len(text.encode()) / 1e6:.1f} MB, more than {BUDGET / 1e6:g}; name fewer folders")


def full_page(recordings, script, library_style, details):
    packer = Packer()
    data = {"recordings": [recording_json(one, packer, detail) for one, detail in zip(recordings, details)],
            "charges": KINDS_OF_CHARGES}
    json_text = json.dumps(data, separators=(",", ":"), allow_nan=False)
    elements = {"data": packed(json_text.encode()), "arrays": packer.text(), "program": packed(script.encode())}
    tail = f"<!-- {parts.LICENCES} -->\n"
    tail += "".join(f'<script type="application/octet-stream" id="{name}">{text}</script>\n' for name, text in elements.items())
    tail += f"<script>{LOADER.read_text(encoding='utf-8')}</script>"
    return document(recordings, library_style, tail, None)


def plain_page(recordings, why):
    """Tables and the pictures of scripts/plot, where there are some: for a machine on which the script cannot be built."""
    notice = (f"The interactive parts of this page are missing: {why}. Tables and pictures are complete; curves, replay and single "
              "steps need them.")
    return document(recordings, "", "", notice), [f"a page without interactive parts: {why}"]


def document(recordings, library_style, tail, notice):
    title = "Touchmark: " + ", ".join(one.name for one in recordings)
    style = library_style + STYLE.read_text(encoding="utf-8")
    body = "".join(recording_html(one, number, notice is not None) for number, one in enumerate(recordings))
    if len(recordings) > 1:
        body += comparison_html(recordings)
    warning = f'<p class="notice" role="status">{escaped(notice)}</p>' if notice else ""
    chooser = choice_of_recording(recordings) if len(recordings) > 1 and notice is None else ""
    # The policy makes sure that the page asks the network for nothing.
    policy = "default-src 'none'; script-src 'unsafe-inline'; style-src 'unsafe-inline'; img-src data: blob:"
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{policy}">
<meta name="color-scheme" content="light dark">
<title>{escaped(title)}</title>
<link rel="icon" href="data:,">
<style>{style}</style>
</head>
<body>
<a class="skip" href="#main">Skip to the verdict</a>
<header><h1>{escaped(title)}</h1>{chooser}{warning}
<noscript><p class="notice">Without JavaScript there are no curves and no replay; tables and verdict are complete.</p></noscript></header>
<main id="main">{body}</main>
<div id="copied" role="status" aria-live="polite"></div>
{tail}
</body>
</html>
"""


def choice_of_recording(recordings):
    options = "".join(f'<option value="{number}">{escaped(one.name)}</option>' for number, one in enumerate(recordings))
    return f'<p class="chooser"><label>Recording <select id="recording">{options}</select></label></p>'


def recording_html(recording, number, plain):
    remarks = "".join(f'<p class="notice">{escaped(remark)}</p>' for remark in recording.remarks)
    parts_of_it = [f'<article class="recording" data-recording="{number}" aria-label="{escaped(recording.name)}">']
    if recording.rows:
        first = recording.rows[0]
        scene = f"{first.fields['mesh']}, {int(first.number('triangles') or 0):,} triangles, {first.query}"
        sentences = "".join(f"<li>{sentence}</li>" for sentence in words.verdict(recording))
        parts_of_it.append(f'<section class="verdict" aria-label="Verdict"><p class="scene">{escaped(scene)}</p><ul>{sentences}</ul>'
                           f'<p class="scene">{words.how_measured(recording)}</p>{remarks}</section>')
        picture = "" if plain else f'<div class="scatter" data-recording="{number}"></div>'
        parts_of_it.append('<div class="first-look"><section aria-label="Ratios"><h2>Who is faster, and how much</h2>'
                           f'{tables.ratio_table(recording, number)}</section>{picture}</div>')
        parts_of_it.append(pictures_of(recording) if plain else f'<div class="interactive" data-recording="{number}"></div>')
        parts_of_it.append(f'<section aria-label="Machine"><h2>The machine, and how quiet it was</h2>{tables.machine_list(recording)}</section>')
    for title, html in others.sections_of(recording):
        parts_of_it.append(f'<section aria-label="{escaped(title)}"><h2>{escaped(title)}</h2>{html}</section>')
    return "\n".join(parts_of_it) + "</article>"


def pictures_of(recording):
    """The pictures that scripts/plot left in the folder, as part of the page."""
    found = [path for name in PICTURES for path in sorted((recording.path / "plots").glob(f"{name}*.png"))]
    figures, size = [], 0
    for path in found:
        content = path.read_bytes()
        size += len(content) * 4 / 3
        if size > BUDGET / 2:
            break
        figures.append(f'<figure><img alt="{escaped(path.stem)}" src="data:image/png;base64,{base64.b64encode(content).decode()}">'
                       f"<figcaption>{escaped(path.stem)}</figcaption></figure>")
    if not figures:
        return "<section><p>There are no pictures in plots/ of this folder; scripts/plot draws them.</p></section>"
    return f'<section aria-label="Pictures"><h2>Pictures</h2>{"".join(figures)}</section>'


def comparison_html(recordings):
    with_rows = [one for one in recordings if one.rows]
    pairs = "".join(f"<h3>{escaped(after.name)} against {escaped(before.name)}</h3>{tables.against(before, after)}"
                    for before, after in zip(with_rows, with_rows[1:]))
    if not pairs:
        return ""
    for one in with_rows:
        one.common = [name for name in with_rows[0].trajectories if all(name in other.trajectories for other in with_rows)]
    return (f'<section aria-label="History"><h2>The recordings side by side</h2>{tables.history(with_rows)}</section>'
            f'<section aria-label="Comparison"><h2>One recording against the one before</h2>{pairs}</section>')


def recording_json(recording, packer, detail):
    names = recording.contestants
    detectors.tell_apart(names)
    replay = replay_in(recording, packer, detail) if recording.steps and detail else None
    return {
        "name": recording.name, "trajectories": recording.trajectories,
        "contestants": [{"name": name, "color": detectors.colour(name), "dash": DASHES[detectors.filling(name)]}
                        for name in names],
        "rows": [row_json(row, recording) for row in recording.rows],
        "replay": replay, "visits": visits_of(recording.visits, packer) if replay and recording.visits and detail.visits else None,
        "resolution": resolution(detail.levels, replay) if replay else 0,
    }


def replay_in(recording, packer, detail):
    """Null where a block turns out to be damaged, which the page then says."""
    begun = len(packer.parts), packer.size
    try:
        return replay_of(recording.steps, packer, detail)
    except Damaged as damaged:
        del packer.parts[begun[0]:]
        packer.size = begun[1]
        recording.steps = recording.visits = None
        recording.remarks.append(f"There is no replay: {damaged}.")
        return None


def row_json(row, recording):
    best = recording.best(row.trajectory)
    ratio = time_of(row, None) / best if row.done and best > 0 else 0
    return {"name": row.name, "trajectory": row.trajectory, "fields": row.fields, "ns": row.ns if row.ns > 0 else None,
            "ratio": ratio if ratio > 0 else None, "words": row.words_of_errors(), "failed": not row.done or row.breaks_its_claim,
            "wrong": row.wrong}
