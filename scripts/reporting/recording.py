"""One recording: the rows of results.csv, run.json and steps.bin of a folder, and what else is in it."""
import math
import pathlib

from drawing import detectors
from drawing.results import Unusable, read_about, read_records, unique

from .steps_file import Damaged, StepsFile
from .visits import Unreadable, Visits

NEEDED = ["detector", "options", "mesh", "trajectory", "query", "status", "steps"]
OTHERS = ["suite.csv", "proxy.csv", "stab.csv", "servo.csv", "stress.csv", "scaling.csv", "bodies.csv", "bodies_growth.csv",
          "choose.csv", "update.csv", "many.csv"]
RATES_HZ = [1000, 4000, 10000]


class Row:
    """One row of results.csv; what is not there is NaN or empty text."""

    def __init__(self, record):
        self.fields = {column: value for column, value in record.items() if value != ""}
        self.name = record["detector"] + (":" + record["options"] if record["options"] else "")
        self.trajectory, self.query, self.status = record["trajectory"], record["query"], record["status"]
        self.done = self.status == "ok"
        self.ns = self.number("ns_undisturbed") if self.number("ns_undisturbed") > 0 else self.number("ns_per_query")

    def number(self, column):
        try:
            return float(self.fields.get(column, "nan"))
        except ValueError:
            return math.nan

    def count(self, column):
        value = self.number(column)
        return int(value) if math.isfinite(value) else 0

    def words_of_errors(self):
        """What was wrong, in words; empty where nothing was."""
        if not self.done:
            return f"did not finish: {self.status}"
        kinds = [("missed", "missed contact"), ("false_contacts", "false contact"), ("wrong_triangle", "wrong triangle"),
                 ("beyond_bound", "distance beyond its bound"), ("wrong_point", "wrong point"),
                 ("wrong_normal", "wrong normal"), ("wrong_side", "wrong side"), ("malformed", "malformed answer")]
        return ", ".join(f"{self.count(column):,} × {words}" for column, words in kinds if self.count(column))

    @property
    def wrong(self):
        """At least so many answers: one answer may be counted under several heads."""
        return max(self.count(column) for column in
                   ["missed", "false_contacts", "wrong_triangle", "beyond_bound", "wrong_point", "wrong_normal",
                    "wrong_side", "malformed"])

    @property
    def breaks_its_claim(self):
        if not self.done or not self.fields.get("judged", self.fields.get("steps")):
            return False
        guarantee = self.fields.get("guarantee", "")
        if guarantee == "exact":
            return self.wrong > 0
        return self.count("malformed") + self.count("wrong_side") > 0 or (guarantee == "conservative" and self.count("missed") > 0)


def real(value):
    """A number of a JSON file; NaN where it is none."""
    return float(value) if isinstance(value, (int, float)) and not isinstance(value, bool) else math.nan


class Recording:
    """What one folder holds."""

    def __init__(self, path):
        self.path = pathlib.Path(path)
        self.name = self.path.resolve().name
        results = self.path / "results.csv"
        self.others = [self.path / name for name in OTHERS if (self.path / name).is_file()]
        self.rows, self.remarks, self.steps, self.visits = [], [], None, None
        self.common = []  # trajectories that all recordings of a page have
        self.about = read_about(self.path / "run.json")
        if not results.is_file():
            if not self.others:
                raise Unusable(f"{self.path}: no results.csv in it, nor one of {', '.join(OTHERS)}")
            return
        try:
            self.rows = [Row(record) for _, record in read_records(results, NEEDED)]
        except Unusable as error:
            raise Unusable(f"{results}: {error}") from None
        except OSError as error:
            raise Unusable(f"{results}: {error.strerror}") from None
        if not self.rows:
            raise Unusable(f"{results}: no row follows the header")
        self.keep_one_question()
        self.read_steps()

    def keep_one_question(self):
        """Tables compare contestants on one mesh, query, radius and reach. A suite has its own; of others the first is kept."""
        columns = ["mesh", "query"]
        pairs = [(row.name, row.trajectory, *(row.fields.get(column) for column in columns)) for row in self.rows]
        if len(set(pairs)) < len(pairs):
            columns += ["radius", "reach"]
        asked = unique(tuple(row.fields.get(column, "") for column in columns) for row in self.rows)
        if len(asked) == 1:
            return
        if any(path.name == "suite.csv" for path in self.others):
            self.rows = []
            return
        self.rows = [row for row in self.rows if tuple(row.fields.get(column, "") for column in columns) == asked[0]]
        named = ", ".join(f"{column} {value}" for column, value in zip(columns, asked[0]))
        self.remarks.append(f"results.csv has {len(asked)} questions; tables and verdict are of the first: {named}.")

    def read_steps(self):
        path = self.path / "steps.bin"
        if not path.is_file():
            self.remarks.append("Curves of single steps and the replay are of one mesh that stands: a scene of bodies has none." if self.bodies else
                                "This folder has no steps.bin, so there are no curves of single steps and no replay. "
                                "touchmark bench --out leaves one.")
            return
        try:
            self.steps = StepsFile(path)
        except Damaged as error:
            self.remarks.append(f"There is no replay: {error}.")
            return
        run_ids = unique(row.fields.get("run_id", "") for row in self.rows)
        if self.steps.run_id not in run_ids:
            self.remarks.append(f"steps.bin is of another run, {self.steps.run_id}, and is left out.")
            self.steps = None
        if self.steps is not None and (self.path / "visited.json").is_file():
            self.read_visits()

    def read_visits(self):
        try:
            visits = Visits(self.path / "visited.json")
        except Unreadable as error:
            self.remarks.append(f"What queries looked at is not shown: {error}.")
            return
        if visits.run_id == self.steps.run_id:
            self.visits = visits
        else:
            self.remarks.append(f"visited.json is of another run, {visits.run_id}, and is left out.")

    @property
    def steadiness(self):
        """The objects of run.json about how quiet each trajectory was."""
        found = self.about.get("steadiness")
        return [one for one in found if isinstance(one, dict)] if isinstance(found, list) else []

    @property
    def bodies(self):
        """How many bodies the scene has; 0 where it is a mesh."""
        mesh = self.about.get("mesh")
        bodies = mesh.get("bodies") if isinstance(mesh, dict) else None
        return bodies if isinstance(bodies, int) else 0

    @property
    def contestants(self):
        return detectors.in_order(row.name for row in self.rows)

    @property
    def trajectories(self):
        return unique(row.trajectory for row in self.rows)

    def row(self, name, trajectory):
        return next((row for row in self.rows if row.name == name and row.trajectory == trajectory), None)

    def rows_of(self, name):
        return [row for row in self.rows if row.name == name]

    def best(self, trajectory, column=None):
        """The least time on this trajectory of those that finished and keep what they claim, were never wrong, too."""
        times = [time_of(row, column) for row in self.rows
                 if row.trajectory == trajectory and row.done and row.wrong == 0 and time_of(row, column) > 0]
        return min(times, default=math.nan)


def time_of(row, column):
    return row.ns if column is None else row.number(column)


def geometric_mean(values):
    values = list(values)
    if not values or not all(value > 0 for value in values):
        return math.nan
    return math.exp(sum(map(math.log, values)) / len(values))
