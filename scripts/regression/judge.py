"""What the regression gate decides, from numbers alone.

Order of judgement: answers and work must equal the expectation; instructions may rise by little; time may rise
only by what the layout of code and memory can do by itself. Timing that its own control contradicts decides
nothing.
"""
import collections
import math
import statistics

import numpy

# Instructions of a case, head over base: warn, fail.
INSTRUCTIONS_WARN, INSTRUCTIONS_FAIL = 1.005, 1.02
# Time, head over base. Code layout alone moves it by up to 7 %, so less counts only where instructions rose, too.
TIME_FAIL, TIME_FAIL_WITH_INSTRUCTIONS = 1.07, 1.03
# A case passes once its interval excludes a slow-down so far beyond its limit: 15 % where the limit is 7 %. The interval
# is wider here, so that so many looks together exclude it wrongly in no more cases than one look would.
BEYOND = 1.15 / TIME_FAIL
# The control is a second copy of base. Nothing is decided while its interval lies wholly beyond the first of these, or
# not wholly within the second: then the machine may tell two equal builds apart.
CONTROL_OFF, CONTROL_KNOWN = 1.015, TIME_FAIL
# Equal controls are called off in at most this share of runs, however many cases and batches are looked at.
FALSELY_OFF = 0.01
# Worth telling, never a failure.
INSTRUCTIONS_FASTER, TIME_FASTER = 0.98, 0.97
# Batches of a case are pooled until they tell something. A slow-down counts when a second pool finds it, too.
BATCHES, AGREEING = 8, 2
CONFIDENCE, RESAMPLES = 0.95, 2000
# When more of the cases are undecided in the end, it is the machine that is restless, and not a case.
UNDECIDED_CASES = 0.1

PASS, REGRESSION, INCONCLUSIVE, UNDECIDED = "pass", "regression", "inconclusive", "undecided"

Interval = collections.namedtuple("Interval", "low median high")  # of a ratio: 1 is no change
# A pool after one more batch; finding: fine, slow, off (the control) or wide (one of the intervals).
Batch = collections.namedtuple("Batch", "head control finding")
Accepted = collections.namedtuple("Accepted", "instructions time", defaults=(1.0, 1.0))


def medians_drawn_anew(log_ratios, generator):
    """The bootstrap of the median; log_ratios are sittings x rounds.

    Rounds of one sitting share where memory lies, so sittings are drawn first, then rounds within each.
    """
    sittings, rounds = log_ratios.shape
    drawn_sittings = generator.integers(sittings, size=(RESAMPLES, sittings, 1))
    drawn_rounds = generator.integers(rounds, size=(RESAMPLES, sittings, rounds))
    return numpy.median(log_ratios[drawn_sittings, drawn_rounds].reshape(RESAMPLES, -1), axis=1)


def interval(log_ratios, drawn, looks=1):
    tail = 100 * (1 - CONFIDENCE) / 2 / looks
    low, high = numpy.percentile(drawn, [tail, 100 - tail])
    return Interval(*(math.exp(x) for x in (low, numpy.median(log_ratios), high)))


def is_off(log_ratios, drawn, looks):
    """Does the control differ by more than CONTROL_OFF, beyond what chance does in so many looks (Bonferroni)?

    The tail is too thin for the percentiles of the bootstrap; its standard error and the normal one serve.
    """
    errors = statistics.NormalDist().inv_cdf(1 - FALSELY_OFF / looks / 2)
    return abs(numpy.median(log_ratios)) - errors * numpy.std(drawn) > math.log(CONTROL_OFF)


def leans(control):
    return control.low > CONTROL_OFF or control.high < 1 / CONTROL_OFF


def is_known(control):
    return control.low >= 1 / CONTROL_KNOWN and control.high <= CONTROL_KNOWN


def time_limit(instructions, accepted=Accepted()):
    """Which ratio of times the lower end of an interval must not exceed."""
    rose = instructions is not None and instructions > INSTRUCTIONS_WARN
    return accepted.time * (TIME_FAIL_WITH_INSTRUCTIONS if rose else TIME_FAIL)


def judge_pool(times, limit, generator, looks=1):
    """times: processor time as sittings x rounds x (base, control, head); looks: how many pools a run judges."""
    base, control, head = numpy.moveaxis(numpy.log(times), 2, 0)
    control_ratios, ratios = control - base, head - (base + control) / 2  # both are base: twice as much is known of it
    drawn_controls = medians_drawn_anew(control_ratios, generator)
    drawn = medians_drawn_anew(ratios, generator)
    against_control, against_base = interval(control_ratios, drawn_controls), interval(ratios, drawn)
    if is_off(control_ratios, drawn_controls, looks):
        finding = "off"
    elif leans(against_control) or not is_known(against_control):
        finding = "wide"
    elif against_base.low > limit:
        finding = "slow"
    elif interval(ratios, drawn, BATCHES).high < limit * BEYOND:
        finding = "fine"
    else:
        finding = "wide"
    return Batch(against_base, against_control, finding)


class CaseTime:
    """What is found of one case, a batch after the other."""

    def __init__(self, limit, looks):
        self.limit, self.looks = limit, looks
        self.batches = []
        self.times, self.pooled = [], 0  # of all batches; how many of the last make up the pool

    def add(self, times, generator):
        self.times.append(times)
        self.pooled += 1
        batch = self.judge_last(self.pooled, generator)
        if batch.finding == "fine" and self.pooled < len(self.times):
            # What one pool found is dropped only if it shows no more in all that is known.
            if self.judge_last(len(self.times), generator).finding != "fine":
                batch = batch._replace(finding="wide")
        if batch.finding == "slow":
            self.pooled = 0  # what is to agree with it starts anew
        self.batches.append(batch)

    def judge_last(self, count, generator):
        return judge_pool(numpy.concatenate(self.times[-count:]), self.limit, generator, self.looks)

    def is_open(self):
        return self.judged() is None and len(self.batches) < BATCHES

    def verdict(self):
        """After the last batch that there is time for."""
        return self.judged() or (UNDECIDED if self.might_be_equal() else INCONCLUSIVE)

    def judged(self):
        findings = [batch.finding for batch in self.batches]
        if "fine" in findings:
            return PASS
        return REGRESSION if findings.count("slow") >= AGREEING else None

    def might_be_equal(self):
        """Nothing was found against it: it is only not known well enough."""
        if any(batch.finding == "slow" for batch in self.batches):
            return False
        last = self.batches[-1]
        return last.finding == "wide" and last.head.low <= self.limit


def chance_of_leaning(cases):
    """How many of so many equal controls lean at most, in all but FALSELY_OFF of runs (binomial)."""
    share, left = 1 - CONFIDENCE, 1.0
    for leaning in range(cases + 1):
        left -= math.comb(cases, leaning) * share**leaning * (1 - share)**(cases - leaning)
        if left <= FALSELY_OFF:
            return leaning
    return cases


def machine_is_off(found):
    """Why no time is believed, whatever the single cases found; or None. found: case to CaseTime."""
    leaning = sum(leans(time.batches[0].control) for time in found.values())
    if leaning <= chance_of_leaning(len(found)):
        return None
    return f"the machine tells equal builds apart: the control differs from base in {leaning} of {len(found)} cases"


def judge_times(take, limits, generator, enough_time=lambda pending: True):
    """take(batch, cases) measures a batch: the times of each case; limits: case to time_limit. Case to CaseTime.

    Cases that are decided are left out of the next batch.
    """
    found = {case: CaseTime(limit, BATCHES * len(limits)) for case, limit in limits.items()}
    pending = list(found)
    for batch in range(BATCHES):
        if not pending or not enough_time(pending):
            break
        for case, times in take(batch, pending).items():
            found[case].add(times, generator)
        pending = [case for case in pending if found[case].batches and found[case].is_open()]
    return {case: time for case, time in found.items() if time.batches}


def time_verdicts(found):
    """Case to verdict, and reasons why the run can have none."""
    off = machine_is_off(found)
    if off is None:
        return {case: time.verdict() for case, time in found.items()}, []
    return {}, [off]


def judge_instructions(ratio, accepted=Accepted()):
    """"fail", "warn", "faster", "same" or "unknown"."""
    if ratio is None:
        return "unknown"
    if ratio > INSTRUCTIONS_FAIL * accepted.instructions:
        return "fail"
    if ratio > INSTRUCTIONS_WARN * accepted.instructions:
        return "warn"
    return "faster" if ratio < INSTRUCTIONS_FASTER else "same"


def judge_answers(expected, measured):
    """Yields (case, kind, text) for every difference; kind is "fail" or "skip".

    Both map a case's name to a dictionary with inputs, cells, spheres, boxes, triangles, answers, details; measured
    also with note (why there are no numbers) and needs_file.
    """
    for name in expected.keys() - measured.keys():
        yield name, "fail", "expected, but no longer among the pinned cases"
    for name, now in measured.items():
        then = expected.get(name)
        if now["note"]:
            yield name, "skip" if now["needs_file"] and not now["inputs"] else "fail", now["note"]
        elif then is None:
            yield name, "fail", "a new case without an expectation"
        elif then["inputs"] != now["inputs"]:
            if now["needs_file"]:
                yield name, "skip", "the mesh's file is another edition than the one expected"
            else:
                yield name, "fail", "the inputs changed: another scene or trajectory"
        else:
            changed = [field for field in ("answers", "details") if then[field] != now[field]]
            if changed:
                yield name, "fail", "other answers" if "answers" in changed else "other points or normals"
            for field in ("cells", "spheres", "boxes", "triangles"):
                if then[field] != now[field]:
                    yield name, "fail", f"{field} looked at: {now[field]}, expected {then[field]}"


def judge_all(answers, instructions, times, untold=()):
    """The verdict of a run, with what failed, what is inconclusive and what passes undecided.

    answers: what judge_answers yields; instructions: case to judge_instructions; times: case to its verdict. untold:
    reasons why something that should have been measured was not. A failure is never hidden by what is inconclusive.
    A case whose time stays undecided passes where it takes no more instructions and hardly another is so restless.
    """
    failed = [f"{name}: {text}" for name, kind, text in answers if kind == "fail"]
    failed += [f"{name}: more instructions" for name, found in instructions.items() if found == "fail"]
    failed += [f"{name}: slower" for name, found in times.items() if found == REGRESSION]
    undecided = [name for name, found in times.items() if found == UNDECIDED]
    passing = [name for name in undecided if instructions.get(name) in ("same", "faster")]
    if len(undecided) > max(1, UNDECIDED_CASES * len(times)):
        passing = []
    open_questions = list(untold) + [f"{name}: time" for name, found in times.items()
                                     if found == INCONCLUSIVE or (found == UNDECIDED and name not in passing)]
    verdict = REGRESSION if failed else INCONCLUSIVE if open_questions else PASS
    return verdict, failed, open_questions, passing
