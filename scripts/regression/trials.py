"""How often the gate cries wolf, and how often it hears one: builds known to be equal, slower or faster."""
import collections

import numpy

from regression import judge, measure, report

# What is injected into head, and into base and control: the share of the steps that are asked twice.
EQUAL = "equal"
INJECTIONS = {EQUAL: (0, 0), "5 % slower": (0.05, 0), "15 % slower": (0.15, 0), "15 % faster": (0, 0.15)}


# times: case to its judge.CaseTime
Run = collections.namedtuple("Run", "verdict instructions times")


class Trial:
    """One run of the gate's judgement of time and instructions."""

    def __init__(self, driver, plugins, out, effort):
        self.driver, self.plugins, self.out, self.effort = driver, plugins, out, effort

    def run(self, seed, injection, ratios):
        """ratios: case to its instructions, head over base; these cases are timed. Returns a Run."""
        head_again, base_again = injection

        def take(batch, pending):
            return measure.times(self.driver, self.plugins, self.out, seed * judge.BATCHES + batch, pending,
                                 base_again=base_again, head_again=head_again, **self.effort)
        limits = {case: judge.time_limit(ratio) for case, ratio in ratios.items()}
        times = judge.judge_times(take, limits, numpy.random.default_rng(seed))
        findings = {case: judge.judge_instructions(ratio) for case, ratio in ratios.items()}
        verdict, *_ = judge.judge_all([], findings, *judge.time_verdicts(times))
        return Run(verdict, findings, times)


def instruction_ratios(driver, plugin, wanted):
    """For each injection: case to the ratio of its instructions."""
    shares = sorted({share for injection in INJECTIONS.values() for share in injection})
    counted = dict(zip(shares, measure.instructions(driver, [plugin] * len(shares), shares)))
    return {kind: {case: counted[head][case] / counted[base][case] for case in counted[0] if wanted(case)}
            for kind, (head, base) in INJECTIONS.items()}


def summary(kind, runs):
    """One row: what came out, over the runs and over the cases of all runs."""
    verdicts = collections.Counter(run.verdict for run in runs)
    told = collections.Counter(runs[0].instructions.values())
    times = [time for run in runs for time in run.times.values()]
    cases = collections.Counter(time.verdict() for time in times)
    first_slow = sum(time.batches[0].finding == "slow" for time in times)
    off = sum(batch.finding == "off" for time in times for batch in time.batches)
    batches = [len(time.batches) for time in times]
    faster = sum(report.last_telling(time.batches).head.high < judge.TIME_FASTER for time in times)
    low, middle, high = numpy.percentile([time.batches[0].head.median for time in times], [5, 50, 95])
    return (kind, str(len(runs)), str(verdicts[judge.PASS]), str(verdicts[judge.REGRESSION]),
            str(verdicts[judge.INCONCLUSIVE]), f"{told['fail']} of {sum(told.values())}",
            f"{cases[judge.REGRESSION]} of {len(times)}", str(first_slow), str(faster), str(cases[judge.UNDECIDED]),
            str(cases[judge.INCONCLUSIVE]), f"{off} of {sum(batches)}", f"{numpy.mean(batches):.1f}; {max(batches)}",
            f"{report.percent(middle)} [{report.percent(low)}, {report.percent(high)}]")


HEADER = ("injected", "runs", "pass", "regression", "inconclusive", "cases failing by instructions",
          "cases slower by time", "by one batch", "faster", "undecided", "inconclusive", "controls off",
          "batches a case: mean; most", "median time of one batch [5 %, 95 %]")


def markdown(rows):
    lines = ["| " + " | ".join(row) + " |" for row in (HEADER, *rows)]
    lines.insert(1, "|" + "---|" * len(HEADER))
    return "\n".join(lines) + "\n"
