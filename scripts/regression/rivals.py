"""The rivals' times beside ours, for people to read. Their code does not change with ours: nothing depends on them."""
import collections
import csv
import json
import pathlib
import re
import subprocess
import tempfile

from regression import builds

PROGRAM = builds.ROOT / "build" / "release" / "bin" / "touchmark"
OURS = ("grid-group", "sphere-cluster")
RIVALS = ("embree", "bullet:method=callback", "bullet", "fcl")  # where the program has them
SCENE, TRAJECTORIES = "noisy-sphere:20000", ("slide", "approach", "jump")
SECONDS = 30

# ratios: rival to trajectory to its median time over that of the faster of ours; commit: that the program was built from.
# One of ratios and skipped, why there are none, is empty.
Rivals = collections.namedtuple("Rivals", "commit ratios skipped")


def skipped(why):
    return Rivals("", {}, why)


def measured():
    """By a short `touchmark bench` of the release build."""
    if not PROGRAM.exists():
        return skipped(f"{PROGRAM.relative_to(builds.ROOT)} is not built")
    try:
        with tempfile.TemporaryDirectory() as out:
            names = known(run("list"))
            wanted = [rival for rival in RIVALS if rival.partition(":")[0] in names]
            if not wanted:
                return skipped("the program was built without any")
            run("bench", "--mesh", SCENE, "--query", "nearest", "--quick", "--out", out,
                *each("--trajectory", TRAJECTORIES), *each("--detector", [*OURS, *wanted]))
            return read(pathlib.Path(out))
    except subprocess.TimeoutExpired:
        return skipped(f"that took longer than {SECONDS} s")
    except subprocess.CalledProcessError as error:
        return skipped((error.stderr.strip() or f"status {error.returncode}").splitlines()[-1])
    except (OSError, ValueError, KeyError) as error:
        return skipped(str(error))


def run(*arguments):
    return subprocess.run([PROGRAM, *arguments], stdin=subprocess.DEVNULL, capture_output=True, text=True, check=True,
                          timeout=SECONDS).stdout


def each(flag, values):
    return [text for value in values for text in (flag, value)]


def known(listing):
    """The contestants that `touchmark list` names, each on a line of its own."""
    return re.findall(r"^  (\S+)$", listing.partition("scenes")[0], re.MULTILINE)


def read(folder):
    with open(folder / "run.json", encoding="utf-8") as file:
        commit = json.load(file)["commit"]
    with open(folder / "results.csv", newline="", encoding="utf-8") as file:
        return Rivals(commit, ratios(list(csv.DictReader(file))), "")


def ratios(rows):
    """Of the median query, which hardly feels what else runs here."""
    ns = {(name(row), row["trajectory"]): float(row["ns_p50"]) for row in rows if row["status"] == "ok"}
    found = {}
    for rival in dict.fromkeys(name(row) for row in rows if row["detector"] not in OURS):
        found[rival] = {trajectory: ns[rival, trajectory] / min(ns[one, trajectory] for one in OURS)
                        for trajectory in TRAJECTORIES if (rival, trajectory) in ns}
    return found


def name(row):
    return row["detector"] + (f":{row['options']}" if row["options"] else "")


def lines(rivals, head):
    """What is printed; head: the commit that is judged."""
    if rivals.skipped:
        return [f"RIVALS NOT MEASURED: {rivals.skipped}"]
    built = "" if rivals.commit and head.startswith(rivals.commit.partition("-")[0]) else f", built from {rivals.commit}"
    told = [f"rivals' median time over that of the faster of {' and '.join(OURS)} on {SCENE} (build/release{built}; a short "
            "measurement, not judged):"]
    for rival, by_trajectory in rivals.ratios.items():
        told.append(f"  {rival:24}" + "  ".join(f"{trajectory} {ratio:.1f}" for trajectory, ratio in by_trajectory.items()))
    return told
