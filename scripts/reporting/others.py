"""What else a folder may hold: the suite's heat map, proxies, paced loops, and other tables as they are."""
import csv
import math

from .tables import cell, framed, head
from .words import duration, escaped

MOST_ROWS = 400
SHOWN = {
    "proxy.csv": ("Proxies", ["method", "options", "family", "probe", "courses", "ticks", "crossings", "pops", "violations",
                              "missed_goals", "jitters", "max_force_jump_n", "p50_ns", "p999_ns", "max_ns"]),
    "stab.csv": ("One stab through each method", None),
    "servo.csv": ("Paced loops", ["detector", "options", "trajectory", "rate_hz", "load", "verdict", "ticks", "missed_ticks",
                                  "longest_miss_run", "latency_ns_p50", "latency_ns_p999", "latency_ns_max", "query_ns_p999"]),
    "stress.csv": ("Hard input", ["detector", "options", "family", "probes", "missed", "false_contacts", "wrong_triangle",
                                  "beyond_bound", "status"]),
    "scaling.csv": ("Growth with the mesh", None),
    "choose.csv": ("Choice", ["rank", "detector", "options", "verdict", "ns_p999", "bytes"]),
}


def sections_of(recording):
    """(title, HTML) of each other file."""
    sections = []
    for path in recording.others:
        try:
            with open(path, newline="", encoding="utf-8") as file:
                reader = csv.DictReader(file)
                records, columns = list(reader), reader.fieldnames or []
        except (OSError, UnicodeDecodeError, csv.Error) as error:
            sections.append((path.name, f"<p>{escaped(path.name)} cannot be read: {escaped(error)}.</p>"))
            continue
        if path.name == "suite.csv":
            sections.append(("Suite", heat_map(records)))
        else:
            title, wanted = SHOWN[path.name]
            sections.append((title, plain_table(title, records, [name for name in wanted or columns if name in columns])))
    return sections


def plain_table(title, records, columns):
    """All rows, sortable; numbers with few digits."""
    heads = "".join(head(escaped(column.replace("_", " "))) for column in columns)
    body = "".join("<tr>" + "".join(value_cell(column, record.get(column) or "") for column in columns) + "</tr>"
                   for record in records[:MOST_ROWS])
    more = f" The first {MOST_ROWS} of {len(records):,} rows." if len(records) > MOST_ROWS else ""
    caption = f"<caption>{escaped(title)}.{more}</caption>"
    return framed(f"<table>{caption}<thead><tr>{heads}</tr></thead><tbody>{body}</tbody></table>", title)


def value_cell(column, text):
    try:
        value = float(text)
    except ValueError:
        return cell(escaped(text))
    if column.endswith("_ns") or "_ns_" in column or column.startswith("ns_"):
        return cell(duration(value) if value > 0 else "0", value)
    return cell(f"{value:.4g}" if value != int(value or 0) or abs(value) >= 1e15 else f"{int(value):,}", value) if math.isfinite(value) \
        else cell(escaped(text))


def heat_map(records):
    """Scenes by motions; in each cell the worst ratio of the fastest exact rival's mean time to that of the best of ours."""
    def ratio(record):
        try:
            return float(record.get("exact_ratio") or "nan")
        except ValueError:
            return math.nan

    shapes = list(dict.fromkeys((record.get("trajectory") or "").partition(":")[0] for record in records))
    scenes = list(dict.fromkeys(record.get("mesh") or "" for record in records))
    rows = []
    for scene in scenes:
        cells = []
        for shape in shapes:
            mine = [one for one in records if one.get("mesh") == scene and (one.get("trajectory") or "").partition(":")[0] == shape]
            known = [(ratio(one), one) for one in mine if ratio(one) > 0]
            if not known:
                cells.append(cell("–"))
                continue
            worst, one = min(known, key=lambda pair: pair[0])
            step = min(4, max(0, int(math.log2(max(worst, 1e-9)) + 1)))
            title = f"{one['trajectory']}, {one.get('query')}, reach {one.get('reach')}, {one.get('caches')}: {one.get('ours')} against {one.get('exact_rival')}"
            cells.append(cell(f"{worst:.2f}" if worst >= 1 else f"<b>{worst:.2f}</b>", worst, f"heat heat{step}", title))
        rows.append(f'<tr><th scope="row">{escaped(scene)}</th>{"".join(cells)}</tr>')
    heads = head("scene") + "".join(head(escaped(shape)) for shape in shapes)
    caption = ("<caption>The fastest exact rival’s time over that of the best of ours, the worst of each field’s cells: above 1 ours "
               "is faster. Bold: ours is slower.</caption>")
    return framed(f"<table>{caption}<thead><tr>{heads}</tr></thead><tbody>{''.join(rows)}</tbody></table>", "Suite")
