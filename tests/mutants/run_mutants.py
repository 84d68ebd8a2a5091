#!/usr/bin/python3
"""Does the suite kill every mutant of core? Prints who was killed by which test.

Programs linked with the mutated core run in the order given until one fails, the mutant's own `killer` first.
A failed test kills, and so does one that never ends; a crash alone does not, since it shows no wrong answer.
Status 1 when a mutant lives, or when a program fails with every mutant asleep.
"""
import argparse
import concurrent.futures
import os
import pathlib
import re
import subprocess
import sys
import time

import mutate

MIN_PATIENCE_S, PATIENCE = 60, 20  # seconds, and how many times as long as with every mutant asleep
FAILED = re.compile(r"^\[  FAILED  \] ([^ ,]+)", re.MULTILINE)


def run(program, mutant, patience_s=600):
    """("passed" | "failed" | "hung" | "crashed", which test)."""
    environment = {**os.environ, "GTEST_FAIL_FAST": "1", "GTEST_BRIEF": "1"}
    environment.pop("TOUCHMARK_MUTANT", None)
    if mutant is not None:
        environment["TOUCHMARK_MUTANT"] = mutant
    try:
        ended = subprocess.run([program], env=environment, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
                               timeout=patience_s, check=False)
    except subprocess.TimeoutExpired:
        return "hung", program.name
    failed = FAILED.search(ended.stdout.decode(errors="replace"))
    if ended.returncode == 0:
        return "passed", program.name
    if failed:
        return "failed", f"{program.name}: {failed[1]}"
    return "crashed", f"{program.name}, status {ended.returncode}"


def judge(mutant, programs, patience_s):
    """(is it dead?, by what)."""
    crashes = []
    for program in sorted(programs, key=lambda p: p.name != mutant.get("killer")):
        how, what = run(program, mutant["name"], patience_s)
        if how == "failed":
            return True, what
        if how == "hung":
            return True, f"{what} (no end in {patience_s:.0f} s)"
        if how == "crashed":
            crashes.append(what)
    return False, "crashed only: " + "; ".join(crashes) if crashes else "LIVES"


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("listing", type=pathlib.Path, help="mutants.toml")
    parser.add_argument("programs", type=pathlib.Path, nargs="+", help="test programs linked with the mutated core")
    parser.add_argument("--only", metavar="NAME", help="this mutant alone")
    parser.add_argument("--report", type=pathlib.Path, metavar="FILE", help="where the table goes besides")
    parser.add_argument("--all-killers", action="store_true", help="run every program, print all that kill")
    arguments = parser.parse_args()
    mutants = [m for m in mutate.read_list(arguments.listing) if arguments.only in (None, m["name"])]
    names = {program.name for program in arguments.programs}
    for mutant in mutants:
        if mutant.get("killer", arguments.programs[0].name) not in names:
            parser.error(f"{mutant['name']}: its killer is {mutant['killer']}, none of {', '.join(sorted(names))}")
    start = time.monotonic()
    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as pool:
        asleep = list(pool.map(lambda program: run(program, None), arguments.programs))
        patience_s = max(MIN_PATIENCE_S, PATIENCE * (time.monotonic() - start))
        if arguments.all_killers:
            for mutant in mutants:
                found = pool.map(lambda program, name=mutant["name"]: run(program, name), arguments.programs)
                print(f"{mutant['name']:32} " + ("; ".join(f"{h} {w}" for h, w in found if h != "passed") or "LIVES"))
            return 0
        verdicts = list(pool.map(lambda mutant: judge(mutant, arguments.programs, patience_s), mutants))
    lines = [f"every mutant asleep: {how} {what}" for how, what in asleep if how != "passed"]
    sound = not lines
    lines.append(f"{'mutant':32} killed by")
    lines += [f"{mutant['name']:32} {what}" for mutant, (_, what) in zip(mutants, verdicts)]
    survivors = sum(not dead for dead, _ in verdicts)
    lines.append(f"{len(mutants) - survivors} of {len(mutants)} mutants killed in {time.monotonic() - start:.0f} s")
    print("\n".join(lines))
    if arguments.report:
        arguments.report.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return 0 if sound and survivors == 0 else 1


if __name__ == "__main__":
    sys.exit(main())
