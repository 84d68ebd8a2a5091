"""results.csv and run.json, read with care: whatever cannot be used is told in one line."""
import csv
import json
import math
import pathlib

TEXT_COLUMNS = ["detector", "options", "mesh", "trajectory", "query", "guarantee", "status"]
NUMBER_COLUMNS = ["triangles", "steps", "radius", "missed", "false_contacts", "wrong_triangle", "unresolved", "beyond_bound",
                  "wrong_point", "wrong_normal", "malformed", "max_distance_error", "ns_p50", "ns_p90", "ns_p99", "ns_p999",
                  "ns_max", "update_rate_hz"]
OPTIONAL_NUMBERS = ["ns_per_query", "max_distance_error_of_diagonal", "build_ms", "first_answer_ms", "bytes", "stored_missed",
                    "stored_false_contacts", "stored_max_distance_error_of_diagonal", "clock_cost_ns", "ns_undisturbed",
                    "disturbed_share", "beyond_tolerance", "rounding", "cold_l2_ns_p50", "cold_ns_p50", "cold_ns_p99",
                    "bracket_p50", "bracket_max"]
MAY_BE_INFINITE = ["radius", "max_distance_error", "max_distance_error_of_diagonal",
                   "stored_max_distance_error_of_diagonal"]
DONE = "ok"


class Unusable(Exception):
    """A file or a wish that cannot be served; the message is one line."""


class NothingToDraw(Exception):
    """The rows hold nothing for this picture; the message says why, in one line."""


class Record:
    """The wanted columns of one row as members: texts, numbers, which are NaN where they are not there, and counts, which
    are 0 there."""

    def __init__(self, record, line, texts, numbers=(), counts=()):
        for column in texts:
            setattr(self, column, record.get(column) or "")
        for column in (*numbers, *counts):
            setattr(self, column, number(record.get(column), column, line))
        for column in counts:
            if math.isnan(getattr(self, column)):
                setattr(self, column, 0)


class Row(Record):
    """One row of results.csv."""

    def __init__(self, record, line):
        super().__init__(record, line, TEXT_COLUMNS, NUMBER_COLUMNS + OPTIONAL_NUMBERS)
        self.name = self.detector + (":" + self.options if self.options else "")
        self.done = self.status == DONE
        if math.isnan(self.ns_per_query) and self.update_rate_hz > 0:
            self.ns_per_query = 1e9 / self.update_rate_hz
        self.take_undisturbed()

    def take_undisturbed(self):
        """Where it is known, the time that other work on the machine does not move is the one that is compared."""
        if self.ns_undisturbed > 0:
            self.ns_per_query, self.update_rate_hz = self.ns_undisturbed, 1e9 / self.ns_undisturbed

    @property
    def scene(self):
        return self.mesh, self.query, self.radius


class Run:
    """The rows of one file, and what run.json beside it says of where they come from."""

    def __init__(self, path, rows, about):
        folder = path.resolve().parent
        self.path, self.rows = path, rows
        self.name = folder.name if path.name == "results.csv" else path.stem
        self.source = source_of(self.name, about)


def source_of(name, about):
    """The line that says where numbers are from."""
    facts = [about.get("cpu"), about.get("compiler"), "commit " + about["commit"] if about.get("commit") else ""]
    return ", ".join([name] + [str(fact) for fact in facts if fact])


def number(text, column, line):
    if not text:
        return math.nan
    try:
        value = float(text)
    except ValueError:
        raise Unusable(f"line {line}: column {column}: '{shortened(text)}' is not a number") from None
    if math.isinf(value) and column not in MAY_BE_INFINITE:
        raise Unusable(f"line {line}: column {column}: '{shortened(text)}' is not finite")
    return math.nan if math.isnan(value) else value  # one NaN, which equals itself in a tuple


def read_records(path, columns):
    """(line, record) of each row of a CSV file that must have these columns."""
    try:
        with open(path, newline="", encoding="utf-8") as file:
            reader = csv.DictReader(file, strict=True)
            missing = [column for column in columns if column not in (reader.fieldnames or [])]
            if missing:
                raise Unusable(f"the header has no column {', '.join(missing)}")
            for record in reader:
                if None in record or None in record.values():
                    raise Unusable(f"line {reader.line_num}: not as many fields as the header")
                yield reader.line_num, record
    except (UnicodeDecodeError, csv.Error) as error:
        raise Unusable(f"not a CSV file in UTF-8: {error}") from None


def rows_of(path, columns, row):
    """The file's rows as row(record, line) makes them: at least one."""
    try:
        rows = [row(record, line) for line, record in read_records(path, columns)]
        if not rows:
            raise Unusable("no row follows the header")
        return rows
    except OSError as error:
        raise Unusable(f"{path}: {error.strerror}") from None
    except Unusable as error:
        raise Unusable(f"{path}: {error}") from None


def read_about(path):
    try:
        about = json.loads(path.read_text(encoding="utf-8"))
    except FileNotFoundError:
        return {}
    except OSError as error:
        raise Unusable(f"{path}: {error.strerror}") from None
    except ValueError as error:  # of the text's encoding, too
        raise Unusable(f"{path}: not JSON in UTF-8: {error}") from None
    return about if isinstance(about, dict) else {}


def read_run(path):
    path = pathlib.Path(path)
    rows = rows_of(path, TEXT_COLUMNS + NUMBER_COLUMNS, Row)
    return Run(path, rows, read_about(path.with_name("run.json")))


def unique(values):
    return list(dict.fromkeys(values))


def finite(values):
    return [value for value in values if math.isfinite(value)]


def positive(values):
    return [value for value in finite(values) if value > 0]


def geometric_mean(values):
    return math.exp(sum(map(math.log, values)) / len(values))


def shortened(text, most=48):
    return text if len(text) <= most else text[:most - 3] + "..."
