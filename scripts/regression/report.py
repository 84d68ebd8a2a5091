"""The table that people read and the record that programs read."""
import json

from regression import judge

VERDICTS = {judge.PASS: "PASS", judge.REGRESSION: "REGRESSION", judge.INCONCLUSIVE: "INCONCLUSIVE"}


def percent(ratio):
    return "" if ratio is None else f"{100 * (ratio - 1):+.1f} %"


def span(interval):
    if interval is None:
        return ""
    return f"{percent(interval.median)} [{100 * (interval.low - 1):+.1f}, {100 * (interval.high - 1):+.1f}]"


def bounds(interval):
    return f"{100 * (interval.low - 1):+.0f} to {100 * (interval.high - 1):+.0f} %"


def lines_of_table(rows):
    widths = [max(len(row[i]) for row in rows) for i in range(len(rows[0]))]
    for row in rows:
        yield "  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip()


def words(case):
    """What there is to say of a case, gravest first."""
    said = []
    if case["answers"]:
        said.append("; ".join(case["answers"]))
    if case["instructions_finding"] == "fail":
        said.append("MORE INSTRUCTIONS")
    elif case["instructions_finding"] == "warn":
        said.append("more instructions")
    if case["time_verdict"] == judge.REGRESSION:
        said.append("SLOWER")
    elif case["time_verdict"] == judge.INCONCLUSIVE:
        said.append("time inconclusive: " + ", ".join(batch.finding for batch in case["batches"]))
    elif case["time_verdict"] == judge.UNDECIDED:
        said.append("time undecided within " + bounds(case["batches"][-1].head))
    elif case["time_verdict"] is None and case["batches"]:
        said.append("time not believed")
    elif "slow" in [batch.finding for batch in case["batches"]]:
        said.append("slower once, not again")
    batch = last_telling(case["batches"]) if case["time_verdict"] else None
    if batch and batch.head.high < judge.TIME_FASTER:
        said.append("faster")
    elif case["instructions_finding"] == "faster":
        said.append("fewer instructions")
    return "; ".join(said) or "ok"


def last_telling(batches):
    telling = [batch for batch in batches if batch.finding in ("fine", "slow")] or batches
    return telling[-1] if telling else None


def table(cases):
    """cases: name to the dictionary that regress.Case.record makes."""
    rows = [("case", "instructions", "time, head over base", "control over base", "")]
    for name, case in cases.items():
        batch = last_telling(case["batches"])
        rows.append((name, percent(case["instructions_ratio"]), span(batch and batch.head),
                     span(batch and batch.control), words(case)))
    return "\n".join(lines_of_table(rows))


def as_json(record):
    """Named tuples become objects."""
    def plain(value):
        if hasattr(value, "_asdict"):
            value = value._asdict()
        if isinstance(value, dict):
            return {key: plain(item) for key, item in value.items()}
        if isinstance(value, (list, tuple)):
            return [plain(item) for item in value]
        return value
    return json.dumps(plain(record), indent=1) + "\n"
