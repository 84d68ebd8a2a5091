"""What else a folder may hold: the suite's heat map, proxies, paced loops, and other tables as they are."""
import csv
import math

from .recording import geometric_mean
from .tables import cell, framed, head
from .words import duration, escaped

MAX_ROWS = 400
SHOWN = {
    "proxy.csv": ("Proxies", ["method", "options", "family", "probe", "courses", "ticks", "crossings", "pops", "violations",
                              "missed_goals", "jitters", "max_force_jump_n", "p50_ns", "p999_ns", "max_ns"]),
    "stab.csv": ("One stab through each method", None),
    "servo.csv": ("Paced loops", ["detector", "options", "trajectory", "rate_hz", "load", "verdict", "ticks", "missed_ticks",
                                  "longest_miss_run", "latency_ns_p50", "latency_ns_p999", "latency_ns_max", "query_ns_p999"]),
    "stress.csv": ("Hard input", ["detector", "options", "family", "probes", "missed", "false_contacts", "wrong_triangle",
                                  "beyond_bound", "status"]),
    "scaling.csv": ("Growth with the mesh", None),
    "update.csv": ("Updates", ["detector", "options", "share", "status", "build_ms", "update_ms", "update_over_build",
                              "ns_per_query_updated", "ns_per_query_built"]),
    "many.csv": ("Many points", None),
    "audit.csv": ("Audit", None),
    "bodies.csv": ("Growth with the number of bodies", ["detector", "options", "bodies", "motion", "place", "tick_ns", "tick_over_one",
                                                        "first_tick_ns", "first_tick_over_one", "tick_prepared_ns", "tick_prepared_over_one",
                                                        "first_tick_prepared_ns", "first_tick_prepared_over_one", "publish_ns_per_body", "bytes_per_body", "differing", "status"]),
    "bodies_growth.csv": ("How fast that grows", ["detector", "options", "motion", "place", "quantity", "exponent", "exponent_low",
                                                  "exponent_high"]),
    "choose.csv": ("Choice", ["rank", "detector", "options", "verdict", "ns_p999", "bytes"]),
}
LONG = 25  # rows: more are kept in a frame that scrolls
# Of long tables also a row a contestant: what is summed up, and of what the largest counts.
SUMMED = {
    "proxy.csv": (["method", "options"], ["courses", "ticks", "crossings", "pops", "violations", "missed_goals", "jitters"],
                  ["max_force_jump_n", "p999_ns", "max_ns"]),
    "stress.csv": (["detector", "options"], ["probes", "missed", "false_contacts", "wrong_triangle", "beyond_bound", "crashes",
                                             "timeouts", "refusals"], []),
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
            sections.append(("Suite", sentence_of_suite(records) + heat_map(records)))
        else:
            title, wanted = SHOWN[path.name]
            if path.name in SUMMED:
                keys, *columns_of = SUMMED[path.name]
                sections.append((title + ", summed up", plain_table(f"{title}, all families", summed(records, keys, *columns_of), [*keys, *sum(columns_of, [])])))
            sections.append((title, plain_table(title, records, [name for name in wanted or columns if name in columns])))
    return sections


def summed(records, keys, added, largest):
    """A record for each combination of the keys."""
    together = {}
    for record in records:
        of_key = together.setdefault(tuple(record.get(key) or "" for key in keys), {column: [] for column in added + largest})
        for column, values in of_key.items():
            values += finite(record.get(column))
    return [{**dict(zip(keys, key)), **{column: repr(sum(of_key[column])) for column in added},
             **{column: repr(max(of_key[column])) if of_key[column] else "" for column in largest}} for key, of_key in together.items()]


def finite(text):
    """The number in a list, or an empty list where there is none."""
    try:
        value = float(text)
    except (TypeError, ValueError):
        return []
    return [value] if math.isfinite(value) else []


def plain_table(title, records, columns):
    """All rows, sortable; numbers with few digits."""
    heads = "".join(head(escaped(column.replace("_", " "))) for column in columns)
    body = "".join("<tr>" + "".join(value_cell(column, record.get(column) or "") for column in columns) + "</tr>"
                   for record in records[:MAX_ROWS])
    more = f" The first {MAX_ROWS} of {len(records):,} rows." if len(records) > MAX_ROWS else ""
    caption = f"<caption><span>{escaped(title)}.{more}</span></caption>"
    return framed(f"<table>{caption}<thead><tr>{heads}</tr></thead><tbody>{body}</tbody></table>", title, len(records) > LONG)


def value_cell(column, text):
    try:
        value = float(text)
    except ValueError:
        return cell(escaped(text))
    if column.endswith("_ns") or "_ns_" in column or column.startswith("ns_"):
        return cell(duration(value) if value > 0 else "0", value)
    return cell(f"{value:.4g}" if value != int(value or 0) or abs(value) >= 1e15 else f"{int(value):,}", value) if math.isfinite(value) \
        else cell(escaped(text))


def ratio(record):
    """How often longer the fastest exact rival took than the best of ours; NaN where one has no time, or it is in no score."""
    if record.get("exact_counts") == "0":
        return math.nan
    return (finite(record.get("exact_ratio")) or [math.nan])[0]


def sentence_of_suite(records):
    known = [record for record in records if ratio(record) > 0]
    if not known:
        return f"<p>None of {len(records):,} cells has both a time of ours and one of an exact rival.</p>"
    ahead = sum(1 for record in known if ratio(record) > 1)
    worst = min(known, key=ratio)
    return (f"<p>In {ahead:,} of {len(known):,} cells the best of ours is faster than the fastest exact rival; over all, the rival takes "
            f"<strong>{geometric_mean(map(ratio, known)):.2f} times</strong> as long. The worst cell: {ratio(worst):.2f} times, "
            f"{escaped(question_of(worst))}.{f' {len(records) - len(known):,} more have no such pair of times, or are in no score.' if len(records) > len(known) else ''}</p>")


def question_of(record):
    return ", ".join(f"{label}{record.get(column) or 'unknown'}" for label, column in
                     (("", "mesh"), ("", "trajectory"), ("", "query"), ("reach ", "reach"), ("caches ", "caches")))


def heat_map(records):
    """Scenes by motions; in each cell the worst ratio of the fastest exact rival's mean time to that of the best of ours."""
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
            title = f"{question_of(one)}: {one.get('ours')} against {one.get('exact_rival')}"
            cells.append(cell(f"{worst:.2f}" if worst >= 1 else f"<b>{worst:.2f}</b>", worst, f"heat heat{step}", title))
        rows.append(f'<tr><th scope="row">{escaped(scene)}</th>{"".join(cells)}</tr>')
    heads = head("scene") + "".join(head(escaped(shape)) for shape in shapes)
    caption = ("<caption><span>The fastest exact rival’s time over that of the best of ours, the worst of each field’s cells: above 1 ours "
               "is faster. Bold: ours is slower.</span></caption>")
    return framed(f"<table>{caption}<thead><tr>{heads}</tr></thead><tbody>{''.join(rows)}</tbody></table>", "Suite")
