#!/usr/bin/python3
"""scripts/gate-trials with a gate that never errs, and with some that cannot be tried."""
import pathlib
import subprocess
import tempfile
import unittest

SCRIPT = pathlib.Path(__file__).resolve().parents[2] / "scripts" / "gate-trials"

# A detector that takes as long as the reference, judged without noise.
GATE = """#!/usr/bin/python3
import csv, pathlib, sys
def value(flag):
    return sys.argv[sys.argv.index(flag) + 1]
baseline = pathlib.Path(value("--baseline"))
if "--write-baseline" in sys.argv:
    baseline.write_text("mesh,ratio,ratio_low,ratio_high\\n\\"a, b\\",1,0.9,1.1\\n")
    sys.exit(WRITES)
(row,) = csv.DictReader(baseline.open())
assert row["mesh"] == "a, b"
ratio = float(row["ratio"])
verdict = "SLOWER" if ratio < 1 / 1.07 else "faster" if ratio > 1.07 else "pass"
pathlib.Path(value("--report")).write_text(f"ratio,batches,verdict\\n1,2,{verdict}\\n")
sys.exit(verdict == "SLOWER")
"""


class GateTrials(unittest.TestCase):
    def trials(self, program, *more):
        with tempfile.TemporaryDirectory() as folder:
            path = pathlib.Path(folder) / "touchmark"
            if program:
                path.write_text(program)
                path.chmod(0o755)
            return subprocess.run([SCRIPT, "--program", path, *more], capture_output=True, text=True, check=False)

    def test_counts_what_the_gate_said(self):
        done = self.trials(GATE.replace("WRITES", "0"), "--trials", "8")
        self.assertEqual(done.returncode, 0, done.stderr)
        rows = [[cell.strip() for cell in line.split("|")[1:-1]] for line in done.stdout.splitlines()[2:]]
        self.assertEqual(rows, [["nothing", "8", "8", "0", "0", "0", "2.0"], ["5 % slower", "2", "2", "0", "0", "0", "2.0"],
                                ["15 % slower", "2", "0", "0", "2", "0", "2.0"],
                                ["15 % faster", "2", "2", "2", "0", "0", "2.0"]])

    def test_says_why_there_are_no_rates(self):
        for program, more, status, text in (
            (None, [], 3, "is missing"), (GATE.replace("WRITES", "4"), [], 3, "no baseline"),
            (GATE.replace("WRITES", "2"), [], 2, "no word"), (GATE.replace("WRITES", "0"), ["--trials", "0"], 2, "--trials 0"),
        ):
            done = self.trials(program, *more)
            self.assertEqual(done.returncode, status, done.stderr)
            self.assertIn(text, done.stderr.splitlines()[-1])


if __name__ == "__main__":
    unittest.main()
