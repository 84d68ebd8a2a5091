"""Numbers as people read them, and the verdict in sentences."""
import html
import math

from .recording import RATES_HZ, geometric_mean

RATE_NAMES = ["1 kHz", "4 kHz", "10 kHz"]


def escaped(text):
    return html.escape(str(text), quote=True)


def duration(ns):
    if not math.isfinite(ns):
        return "–"
    for unit, size in (("s", 1e9), ("ms", 1e6), ("µs", 1e3)):
        if ns >= size:
            return f"{three_digits(ns / size)} {unit}"
    return f"{three_digits(ns)} ns"


def three_digits(value):
    if not math.isfinite(value):
        return "–"
    if value >= 1000:
        return f"{float(f'{value:.3g}'):,.0f}"
    return f"{value:.3g}"


def many(count, singular, plural=None):
    return f"{count:,} {singular if count == 1 else plural or singular + 's'}"


def listed(names):
    names = list(names)
    return names[0] if len(names) == 1 else ", ".join(names[:-1]) + " and " + names[-1] if names else ""


def slowest(rows, column):
    """The largest of a column over a contestant's rows; NaN unless all rows have it."""
    values = [row.number(column) for row in rows]
    return max(values) if values and all(math.isfinite(value) for value in values) else math.nan


def margins(ns):
    """How often the slowest step fits into the period of each rate."""
    return [1e9 / rate / ns if ns > 0 else math.nan for rate in RATES_HZ]


def winner_of(recording):
    """The contestant with the least geometric mean of those that finished everywhere and were never wrong."""
    means = {}
    for name in recording.contestants:
        rows = recording.rows_of(name)
        if len(rows) == len(recording.trajectories) and all(row.done and row.wrong == 0 for row in rows):
            mean = geometric_mean(row.ns for row in rows)
            if mean > 0:
                means[name] = mean
    return min(means.items(), key=lambda item: item[1], default=(None, math.nan))


def holding(what, ns):
    """`holds 1, 4 and 10 kHz, the last with a margin of 12`."""
    held = [(name, margin) for name, margin in zip(RATE_NAMES, margins(ns)) if margin >= 1]
    if not held:
        return f"{what} took up to {duration(ns)}, too long for 1 kHz"
    rates = listed(name.removesuffix(" kHz") for name, _ in held)
    return f"{what} took {duration(ns)}, which holds {rates} kHz, the last with a margin of {three_digits(held[-1][1])}"


def verdict(recording):
    """Sentences: who is fastest and right, with what margin, warm and cold; who misses; who is wrong and how often."""
    name, mean = winner_of(recording)
    sentences = []
    if name is None:
        sentences.append("No contestant finished all trajectories without a wrong answer.")
    else:
        rows = recording.rows_of(name)
        judged = sum(row.count("judged") or row.count("steps") for row in rows)
        cold = slowest(rows, "cold_ns_max")
        sentences.append(f"<strong>{escaped(name)}</strong> is the fastest that was never wrong in {judged:,} checked steps: "
                         f"{duration(mean)} a query. {holding('Its slowest warm step', slowest(rows, 'ns_max'))}"
                         + (f"; {holding('with all caches emptied a query', cold)}." if math.isfinite(cold) else
                            ". Queries with emptied caches were not measured (--cold)."))
    sentences.append(who_holds(recording))
    sentences.append(who_is_wrong(recording))
    return [sentence for sentence in sentences if sentence]


def how_measured(recording):
    """Sentences about the machine and how quiet it was."""
    about = recording.about
    cores = about.get("cores")
    machine = ", ".join(escaped(one) for one in (about.get("cpu"), f"{cores} cores" if isinstance(cores, int) else None) if one)
    shares = [one.get("disturbed_share") for one in about.get("steadiness") or []]
    shares = [one for one in shares if isinstance(one, (int, float)) and math.isfinite(one)]
    quiet = (f"Other work disturbed {share(max(shares))} of the samples of the least quiet trajectory." if shares
             else "How quiet the machine was is not recorded.")
    return f"Measured on {machine}. {quiet}" if machine else quiet


def who_holds(recording):
    """How many hold each rate at every step, and who does not hold 1 kHz."""
    most = {name: slowest(recording.rows_of(name), "ns_max") for name in recording.contestants}
    timed = {name: ns for name, ns in most.items() if ns > 0}
    if not timed:
        return ""
    counts = [sum(1 for ns in timed.values() if margins(ns)[k] >= 1) for k in range(len(RATES_HZ))]
    text = (f"Of {many(len(timed), 'contestant')}, {counts[0]} held 1 kHz at every warm step, {counts[1]} held 4 kHz and "
            f"{counts[2]} held 10 kHz")
    late = [escaped(name) for name, ns in timed.items() if margins(ns)[0] < 1]
    return text + (f"; too slow for 1 kHz: {listed(late)}." if late else ".")


def who_is_wrong(recording):
    parts = []
    for name in recording.contestants:
        rows = [row for row in recording.rows_of(name) if row.done]
        judged = sum(row.count("judged") or row.count("steps") for row in rows)
        wrong = sum(row.wrong for row in rows)
        if wrong and judged:
            broken = " against its own claim" if any(row.breaks_its_claim for row in rows) else ""
            parts.append(f"{escaped(name)} at {share(wrong / judged)} of the steps{broken}")
    failed = [escaped(name) for name in recording.contestants if any(not row.done for row in recording.rows_of(name))]
    text = f"Wrong: {listed(parts)}." if parts else "Nobody gave a wrong answer."
    return text + (f" Did not finish everywhere: {listed(failed)}." if failed else "")


def share(value):
    return f"{100 * value:.2g} %" if value < 0.1 else f"{100 * value:.0f} %"
