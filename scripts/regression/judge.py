"""What the regression gate decides, from numbers alone.

Order of judgement: answers and work must equal the expectation; instructions may rise by little; time may rise
only by what the layout of code and memory can do by itself. Timing that its own control contradicts decides
nothing.
"""
import collections
import math

import numpy

# Instructions of a case, head over base: warn, fail.
INSTRUCTIONS_WARN, INSTRUCTIONS_FAIL = 1.005, 1.02
# Time, head over base. Code layout alone moves it by up to 7 %, so less counts only where instructions rose, too.
TIME_FAIL, TIME_FAIL_WITH_INSTRUCTIONS = 1.07, 1.03
# The control is a second copy of base: its interval must not lie wholly beyond this, or the machine told two equal
# builds apart.
CONTROL_OFF = 1.015
# An interval wider than this on either side tells nothing.
TOO_WIDE = 1.05
# Worth telling, never a failure.
INSTRUCTIONS_FASTER, TIME_FASTER = 0.98, 0.97
# A slow-down counts when two batches find it; batches that tell nothing are repeated as long as this many suffice.
BATCHES, AGREEING = 3, 2
CONFIDENCE, RESAMPLES = 0.95, 2000

PASS, REGRESSION, INCONCLUSIVE = "pass", "regression", "inconclusive"

Interval = collections.namedtuple("Interval", "low median high")  # of a ratio: 1 is no change
Batch = collections.namedtuple("Batch", "head control finding")  # finding: fine, slow, off or noisy
Accepted = collections.namedtuple("Accepted", "instructions time", defaults=(1.0, 1.0))


def interval(log_ratios, generator):
    """Median and bootstrap interval of ratios whose logarithms come as sittings x rounds.

    Rounds of one sitting share where memory lies, so sittings are drawn first, then rounds within each.
    """
    sittings, rounds = log_ratios.shape
    drawn_sittings = generator.integers(sittings, size=(RESAMPLES, sittings, 1))
    drawn_rounds = generator.integers(rounds, size=(RESAMPLES, sittings, rounds))
    medians = numpy.median(log_ratios[drawn_sittings, drawn_rounds].reshape(RESAMPLES, -1), axis=1)
    tail = 100 * (1 - CONFIDENCE) / 2
    low, high = numpy.percentile(medians, [tail, 100 - tail])
    return Interval(*(math.exp(x) for x in (low, numpy.median(log_ratios), high)))


def half_width(of):
    return math.sqrt(of.high / of.low)


def time_limit(instructions, accepted=Accepted()):
    """Which ratio of times the lower end of an interval must not exceed."""
    rose = instructions is not None and instructions > INSTRUCTIONS_WARN
    return accepted.time * (TIME_FAIL_WITH_INSTRUCTIONS if rose else TIME_FAIL)


def judge_batch(times, limit, generator):
    """times: processor time as sittings x rounds x (base, control, head)."""
    base, control, head = numpy.moveaxis(numpy.log(times), 2, 0)
    against_control = interval(control - base, generator)
    against_base = interval(head - (base + control) / 2, generator)  # both are base: twice as much is known of it
    if against_control.low > CONTROL_OFF or against_control.high < 1 / CONTROL_OFF:
        finding = "off"
    elif half_width(against_control) > TOO_WIDE:
        finding = "noisy"
    elif against_base.low > limit:
        finding = "slow"
    elif half_width(against_base) > TOO_WIDE:
        finding = "noisy"
    else:
        finding = "fine"
    return Batch(against_base, against_control, finding)


def judge_time(batches):
    """PASS, REGRESSION or INCONCLUSIVE of a case; None while another batch could still decide."""
    findings = [batch.finding for batch in batches]
    if "fine" in findings:
        return PASS
    if findings.count("slow") >= AGREEING:
        return REGRESSION
    return None if len(findings) < BATCHES else INCONCLUSIVE


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
    """The verdict of a run.

    answers: what judge_answers yields; instructions: case to judge_instructions; times: case to judge_time. untold:
    reasons why something that should have been measured was not. A failure is never hidden by what is inconclusive.
    """
    failed = [f"{name}: {text}" for name, kind, text in answers if kind == "fail"]
    failed += [f"{name}: more instructions" for name, found in instructions.items() if found == "fail"]
    failed += [f"{name}: slower" for name, found in times.items() if found == REGRESSION]
    open_questions = list(untold) + [f"{name}: time" for name, found in times.items() if found == INCONCLUSIVE]
    verdict = REGRESSION if failed else INCONCLUSIVE if open_questions else PASS
    return verdict, failed, open_questions
