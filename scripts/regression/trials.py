"""How often the gate cries wolf, and how often it hears one: builds known to be equal, slower or faster."""
import collections

import numpy

from regression import judge, measure, report

# What is injected into head, and into base and control: the share of the steps that are asked twice.
EQUAL = "equal"
INJECTIONS = {EQUAL: (0, 0), "5 % slower": (0.05, 0), "15 % slower": (0.15, 0), "15 % faster": (0, 0.15)}


class Trial:
    """One run of the gate's judgement of time and instructions."""

    def __init__(self, driver, plugins, out, effort):
        self.driver, self.plugins, self.out, self.effort = driver, plugins, out, effort

    def run(self, seed, injection, ratios):
        """ratios: case to its instructions, head over base; these cases are timed. Returns the verdict, that of time
        for each case, the finding of its instructions and its batches."""
        head_again, base_again = injection
        generator = numpy.random.default_rng(seed)
        batches = collections.defaultdict(list)
        verdicts, pending = {}, list(ratios)
        for batch in range(judge.BATCHES):
            times = measure.times(self.driver, self.plugins, self.out, seed * 10 + batch, pending, base_again=base_again,
                                  head_again=head_again, **self.effort)
            for case, taken in times.items():
                limit = judge.time_limit(ratios.get(case))
                batches[case].append(judge.judge_batch(taken, limit, generator))
            verdicts = {case: judge.judge_time(found) for case, found in batches.items()}
            pending = [case for case, verdict in verdicts.items() if verdict is None]
            if not pending:
                break
        findings = {case: judge.judge_instructions(ratio) for case, ratio in ratios.items()}
        return judge.judge_all([], findings, verdicts)[0], verdicts, findings, batches


def instruction_ratios(driver, plugin, wanted):
    """For each injection: case to the ratio of its instructions."""
    shares = sorted({share for injection in INJECTIONS.values() for share in injection})
    counted = dict(zip(shares, measure.instructions(driver, [plugin] * len(shares), shares)))
    return {kind: {case: counted[head][case] / counted[base][case] for case in counted[0] if wanted(case)}
            for kind, (head, base) in INJECTIONS.items()}


def summary(kind, trials):
    """One row: what came out, over the runs and over the cases of all runs."""
    runs = collections.Counter(verdict for verdict, *_ in trials)
    cases = collections.Counter(verdict for _, verdicts, *_ in trials for verdict in verdicts.values())
    told = collections.Counter(finding for _, _, findings, _ in trials[:1] for finding in findings.values())
    medians = [found[0].head.median for *_, batches in trials for found in batches.values() if found]
    faster = sum(1 for *_, batches in trials for found in batches.values()
                 if report.last_telling(found).head.high < judge.TIME_FASTER)
    low, middle, high = numpy.percentile(medians, [5, 50, 95])
    total = sum(cases.values())
    return (kind, str(len(trials)), str(runs[judge.PASS]), str(runs[judge.REGRESSION]), str(runs[judge.INCONCLUSIVE]),
            f"{told['fail']} of {sum(told.values())}", f"{cases[judge.REGRESSION]} of {total}",
            f"{cases[judge.INCONCLUSIVE]} of {total}", f"{faster} of {total}",
            f"{report.percent(middle)} [{report.percent(low)}, {report.percent(high)}]")


HEADER = ("injected", "runs", "pass", "regression", "inconclusive", "cases failing by instructions",
          "cases slower by time", "cases inconclusive", "cases faster by time", "median time [5 %, 95 %]")


def markdown(rows):
    lines = ["| " + " | ".join(row) + " |" for row in (HEADER, *rows)]
    lines.insert(1, "|" + "---|" * len(HEADER))
    return "\n".join(lines) + "\n"
