"""The page's tables, as HTML that needs no script: ratios, the machine, one recording against another."""
import math
import re

from .recording import RATES_HZ, geometric_mean
from .words import RATE_NAMES, duration, escaped, margins, share, slowest, three_digits


def cell(text, value=math.nan, kind="", title="", tag="td"):
    """A cell with the number that it sorts by; `text` is HTML."""
    attributes = f' data-v="{value:.6g}"' if math.isfinite(value) else ""
    attributes += f' class="{kind}"' if kind else ""
    attributes += f' title="{escaped(title)}"' if title else ""
    return f"<{tag}{attributes}>{text}</{tag}>"


def head(text, title="", sortable=True, extra=""):
    about = f' title="{escaped(title)}"' if title else ""
    if not sortable:
        return f'<th scope="col"{about}{extra}>{text}</th>'
    return f'<th scope="col"{about}{extra}><button type="button" class="sort">{text}</button></th>'


def framed(table, label, long=False):
    """A table that scrolls by itself where the page is narrow, or where it is long."""
    return f'<div class="scroll{" long" if long else ""}" role="region" tabindex="0" aria-label="{escaped(label)}">{table}</div>'


def ratio_table(recording, number):
    """A row a contestant: how often longer than the best right one, mean and p99.9, by trajectory."""
    trajectories = recording.trajectories
    cold = any(row.number("cold_ns_max") > 0 for row in recording.rows)
    heads = [head("contestant"), head("all", "geometric mean of the ratios of the trajectories")]
    heads += [head(escaped(trajectory), "mean time over that of the fastest that was never wrong; below it the same of the "
                   "99.9 % times") for trajectory in trajectories]
    heads += [head("slowest warm step", "over all trajectories, each step's median of its passes"), holds_head("warm")]
    if cold:
        heads += [head("slowest cold", "the slowest query with all caches emptied"), holds_head("cold")]
    heads += [head("wrong", "the share of checked steps with a wrong answer"), head("memory")]
    best = {trajectory: (recording.best(trajectory), recording.best(trajectory, "ns_p999")) for trajectory in trajectories}
    rows = [ratio_row(recording, name, best, cold) for name in recording.contestants]
    rows.sort(key=lambda row: row[0])
    body = "".join(text for _, text in rows)
    caption = ("<caption><span>Time over that of the fastest contestant that was never wrong: 1.00 is that one. Large: the mean; small: "
               "the 99.9 % step. Grey: did not finish, or broke its claim.</span></caption>")
    table = f'<table class="ratios" data-recording="{number}">{caption}<thead><tr>{"".join(heads)}</tr></thead><tbody>{body}</tbody></table>'
    return framed(table, "Ratios")


def holds_head(what):
    return head("holds", f"1, 4 and 10 kHz at every {what} step measured", sortable=False)


def ratio_row(recording, name, best, cold):
    rows = recording.rows_of(name)
    failed = any(not row.done or row.breaks_its_claim for row in rows)
    ratios, cells = [], []
    for trajectory, (mean, tail) in best.items():
        row = recording.row(name, trajectory)
        ratio = row.ns / mean if row and row.done else math.nan
        ratios.append(ratio)
        cells.append(ratio_cell(row, ratio, tail))
    total = geometric_mean(ratios)
    warm = slowest(rows, "ns_max")
    cells.append(cell(duration(warm), warm))
    cells.append(holds_cell(warm))
    if cold:
        emptied = slowest(rows, "cold_ns_max")
        cells.append(cell(duration(emptied), emptied))
        cells.append(holds_cell(emptied))
    cells.append(wrong_cell(rows))
    memory = max((row.number("bytes") for row in rows), default=math.nan)
    cells.append(cell(f"{memory / 1e6:.1f} MB" if memory > 0 else "–", memory))
    first = f'<th scope="row"><button type="button" class="pick" data-name="{escaped(name)}">{breakable(name)}</button></th>'
    all_cell = cell(f"<b>{ratio_text(total)}</b>", total)
    html = f'<tr{" class=failed" if failed else ""} data-name="{escaped(name)}">{first}{all_cell}{"".join(cells)}</tr>'
    return (math.inf if math.isnan(total) else total), html


def breakable(name):
    """As HTML, which may go on in the next line behind a mark of the options."""
    return re.sub(r"([:,=])", r"\1<wbr>", escaped(name))


def ratio_text(ratio):
    if not math.isfinite(ratio):
        return "–"
    return f"{ratio:.2f}" if ratio < 10 else three_digits(ratio)


def ratio_cell(row, ratio, best_tail):
    if row is None:
        return cell("–", title="was not asked")
    if not row.done:
        return cell("failed", kind="failed", title=row.status)
    low, high = row.number("ns_undisturbed_low"), row.number("ns_undisturbed_high")
    interval = f", 95 % interval {duration(low)} to {duration(high)}" if high > 0 else ""
    tail = row.number("ns_p999")
    title = f"mean {duration(row.ns)}{interval}; p99.9 {duration(tail)}; {row.words_of_errors() or 'never wrong'}"
    small = f"<small>{ratio_text(tail / best_tail)}</small>" if tail > 0 and best_tail > 0 else "<small>–</small>"
    kinds = "failed" if row.breaks_its_claim else "first" if ratio <= 1.005 and row.wrong == 0 else ""
    return cell(f"{ratio_text(ratio)} {small}", ratio, kinds, title)


def holds_cell(ns):
    if not ns > 0:
        return cell("–", kind="holds")
    marks = [f'<span class="{"yes" if margin >= 1 else "no"}" title="{name}: {three_digits(margin)} times">{"✓" if margin >= 1 else "✗"}'
             f'{escaped(name.split()[0])}</span>' for name, margin in zip(RATE_NAMES, margins(ns))]
    said = "holds " + (", ".join(name for name, margin in zip(RATE_NAMES, margins(ns)) if margin >= 1) or "none")
    return cell(f'<span role="img" aria-label="{said}">{" ".join(marks)}</span>', kind="holds")


def wrong_cell(rows):
    done = [row for row in rows if row.done]
    judged = sum(row.count("judged") or row.count("steps") for row in done)
    wrong = sum(row.wrong for row in done)
    words = "; ".join(f"{row.trajectory}: {row.words_of_errors()}" for row in rows if row.words_of_errors())
    if not done:
        return cell("failed", math.inf, "failed", words)
    if not wrong:
        return cell("never", 0, title=f"{judged:,} steps checked")
    kind = "failed" if any(row.breaks_its_claim for row in done) else "errs"
    return cell(share(wrong / judged), wrong / judged, kind, words)


def machine_list(recording):
    """What it was measured on, and how quiet that was."""
    about = recording.about
    facts = [("processor", about.get("cpu")), ("cores", about.get("cores")), ("compiler", about.get("compiler")),
             ("flags", about.get("flags")), ("commit", about.get("commit")), ("date", about.get("date")),
             ("governor", about.get("governor")), ("seed", about.get("seed"))]
    load = about.get("load_average")
    if isinstance(load, list) and load and all(isinstance(one, (int, float)) for one in load):
        facts.append(("load at the start", " ".join(f"{one:.2f}" for one in load)))
    clock = about.get("clock") if isinstance(about.get("clock"), dict) else {}
    if clock:
        facts.append(("clock", f"{clock.get('name')}, {duration(float(clock.get('cost_ns') or math.nan))} a reading"))
    if isinstance(about.get("command_line"), list):
        facts.append(("command", "touchmark " + " ".join(map(str, about["command_line"]))))
    items = "".join(f"<dt>{escaped(name)}</dt><dd>{escaped(value)}</dd>" for name, value in facts if value not in (None, ""))
    return f'<dl class="facts">{items}</dl>{steadiness(about)}'


def steadiness(about):
    """How much other work disturbed each trajectory, and how equal two runs of one contestant came out."""
    rows = []
    for one in about.get("steadiness") or []:
        control = one.get("control") or {}
        ratio, low, high = (control.get(key, math.nan) for key in ("ratio", "ratio_low", "ratio_high"))
        equal = f"{ratio:.3f} ({low:.3f} to {high:.3f})" if isinstance(ratio, float) and ratio > 0 else "–"
        rows.append(f"<tr><th scope=row>{escaped(one.get('trajectory', ''))}</th>{cell(share(one.get('disturbed_share') or 0))}"
                    f"{cell(escaped(equal))}{cell('yes' if one.get('conclusive') else 'no')}</tr>")
    if not rows:
        return "<p>run.json does not say how quiet the machine was.</p>"
    heads = (head("trajectory", sortable=False) + head("disturbed", "share of samples that other work lengthened", False)
             + head("same against itself", "the same contestant timed a second time: 1 is equal, in brackets the 95 % interval", False)
             + head("conclusive", sortable=False))
    return framed(f"<table><caption><span>How quiet the machine was</span></caption><thead><tr>{heads}</tr></thead><tbody>{''.join(rows)}</tbody></table>", "How quiet the machine was")


REFERENCES = ["embree", "aabb-tree", "brute-force"]


def history(recordings):
    """Each contestant's time over that of one reference in the same run, by recording: what machines have in common."""
    reference = next((name for name in REFERENCES if all(name in one.contestants for one in recordings)), None)
    if reference is None:
        return f"<p>None of {', '.join(REFERENCES)} is in all recordings, so their ratios cannot be compared.</p>"
    names = list(dict.fromkeys(name for one in recordings for name in one.contestants))
    rows = "".join(f'<tr><th scope="row">{escaped(name)}</th>{"".join(history_cell(one, name, reference) for one in recordings)}</tr>' for name in names)
    heads = head("contestant") + "".join(head(escaped(one.name), escaped(str(one.about.get("date", "")))) for one in recordings)
    caption = (f"<caption><span>Time over that of {reference} in the same recording: below 1 is faster than {reference}. Geometric mean over "
               "the trajectories that all recordings have.</span></caption>")
    return framed(f"<table>{caption}<thead><tr>{heads}</tr></thead><tbody>{rows}</tbody></table>", "History")


def history_cell(recording, name, reference):
    shared = [(recording.row(name, one), recording.row(reference, one)) for one in recording.common]
    ratios = [row.ns / other.ns if row and other and row.done and other.done and other.ns > 0 else math.nan for row, other in shared]
    mean = geometric_mean(ratios)
    return cell(ratio_text(mean), mean)


def against(before, after):
    """B over A, by contestant and trajectory: below 1 is faster."""
    trajectories = [name for name in before.trajectories if name in after.trajectories]
    names = [name for name in before.contestants if name in after.contestants]
    if not names or not trajectories:
        return f"<p>{escaped(after.name)} and {escaped(before.name)} have no contestant on one trajectory in common.</p>"
    rows = []
    for name in names:
        cells = [against_cell(before.row(name, trajectory), after.row(name, trajectory)) for trajectory in trajectories]
        rows.append(f'<tr><th scope="row">{escaped(name)}</th>{"".join(cells)}</tr>')
    same = before.about.get("cpu") == after.about.get("cpu")
    warning = "" if same else " The machines differ, so only ratios between contestants tell something."
    heads = head("contestant") + "".join(head(escaped(trajectory)) for trajectory in trajectories)
    caption = (f"<caption><span>Time in {escaped(after.name)} over that in {escaped(before.name)}: below 1 is faster. Bold: the 95 % "
               f"intervals do not overlap.{escaped(warning)}</span></caption>")
    return framed(f"<table>{caption}<thead><tr>{heads}</tr></thead><tbody>{''.join(rows)}</tbody></table>", "One recording against another")


def against_cell(old, new):
    if old is None or new is None or not (old.done and new.done and old.ns > 0):
        return cell("–")
    ratio = new.ns / old.ns
    ends = [row.number(column) for row in (old, new) for column in ("ns_undisturbed_low", "ns_undisturbed_high")]
    apart = all(map(math.isfinite, ends)) and (ends[1] < ends[2] or ends[3] < ends[0])
    kind = ("faster" if ratio < 1 else "slower") if apart else ""
    text = f"<b>{ratio:.3f}</b>" if apart else f"{ratio:.3f}"
    return cell(text, ratio, kind, f"{duration(old.ns)} then {duration(new.ns)}")


assert len(RATE_NAMES) == len(RATES_HZ)
