#!/usr/bin/python3
"""scripts/record in a small repository of its own, where the comparison is made up."""
import datetime
import os
import pathlib
import shutil
import signal
import subprocess
import tempfile
import time
import unittest

ROOT = pathlib.Path(__file__).resolve().parents[2]
RUN = next(ROOT.glob("results/*/*/run.json"))
BENCH = """#!/bin/bash
echo "$*" >>"$TEST_LOG"
[ "${BENCH_STATUS-0}" = 0 ] || exit "$BENCH_STATUS"
while [ "$1" != --out ]; do shift; done
if [ -n "${BENCH_HANGS-}" ]; then
  # As the program does it, which writes what it has when it is told to end, whatever became of its script.
  (
    trap 'sleep 0.5; mkdir -p "$2"; echo late >"$2/results.csv"; touch "$TEST_LOG.ended"; exit' TERM INT
    touch "$TEST_LOG.begun"
    while :; do sleep 0.05; done
  ) &
  wait
fi
mkdir -p "$2/plots"
cp "$TEST_RUN" "$2/run.json"
echo made-up >"$2/results.csv"
echo made-up >"$2/plots/latency.png"
touch "$2/plots/errors.png" "$2/report.html" "$2/steps.bin" "$2/visited.json"
"""
SETUP = "#!/bin/bash\n"
PAPERS = """#!/bin/bash
echo "papers $*" >>"$TEST_LOG"
mkdir -p "$2/park-jang-2018/figures"
echo made-up >"$2/park-jang-2018/report.md"
touch "$2/park-jang-2018/figures/fig07_time.png"
exit "${PAPERS_STATUS-0}"
"""
PROGRAM = """#!/bin/bash
if [ "$1" = scale ]; then
  echo "scale ${*:4}" >>"$TEST_LOG"
  mkdir -p "$3"
  echo made-up >"$3/scaling.csv"
  exit "${SCALE_STATUS-0}"
fi
if [ "$1" = update ]; then
  echo "update ${*:4}" >>"$TEST_LOG"
  mkdir -p "$3"
  echo made-up >"$3/update.csv"
  exit "${UPDATE_STATUS-0}"
fi
if [ "$1" = bench ]; then
  words=("$@")
  for ((i = 0; i < $#; ++i)); do
    [ "${words[i]}" != --out ] || { out=${words[i + 1]}; unset 'words[i]' 'words[i + 1]'; break; }
  done
  echo "${words[*]}" >>"$TEST_LOG"
  mkdir -p "$out"
  printf '%s\n' bunny,slide,ok,grid-group "bunny,jump,not measured," >"$out/suite.csv"
  exit "${SUITE_STATUS-0}"
fi
echo "$1" >>"$TEST_LOG"
[ -s "$2/results.csv" ] && [ -s "$2/README.md" ] && exit "${VALIDATE_STATUS-0}"
"""
XEON = "model name\t: Intel(R) Xeon(R) Processor @ 2.80GHz\nflags\t\t: fpu avx avx2 avx512f avx512dq\n"


class Record(unittest.TestCase):
    def setUp(self):
        temporary = tempfile.TemporaryDirectory()
        self.addCleanup(temporary.cleanup)
        self.directory = pathlib.Path(temporary.name)
        self.root = self.directory / "repository"
        for path, text in (("scripts/bench", BENCH), ("scripts/papers", PAPERS), ("scripts/setup", SETUP),
                           ("scripts/build-program", "#!/bin/bash\n[ \"$*\" = touchmark-extra ]\n"),
                           ("build/release/bin/touchmark", PROGRAM), ("core/code", "int x;\n"),
                           (".gitignore", "/build/\n")):
            file = self.root / path
            file.parent.mkdir(parents=True, exist_ok=True)
            file.write_text(text, encoding="utf-8")
            file.chmod(0o755)
        shutil.copy(ROOT / "scripts" / "record", self.root / "scripts" / "record")
        (self.directory / "cpuinfo").write_text(XEON, encoding="utf-8")
        self.git("init", "-q")
        self.commit()

    def git(self, *words):
        done = subprocess.run(["git", "-c", "user.name=T", "-c", "user.email=t@example.org", *words], cwd=self.root,
                              capture_output=True, text=True, check=True)
        return done.stdout.strip()

    def commit(self):
        self.git("add", "-A")
        self.git("commit", "-q", "-m", "x")

    def environment(self, **variables):
        return {**os.environ, "TEST_LOG": str(self.directory / "log"), "TEST_RUN": str(RUN),
                "TOUCHMARK_CPUINFO": str(self.directory / "cpuinfo"), "TOUCHMARK_CORES": "2", **variables}

    def record(self, *words, **variables):
        return subprocess.run([self.root / "scripts" / "record", *words], capture_output=True, text=True, check=False,
                              cwd=self.directory, stdin=subprocess.DEVNULL, env=self.environment(**variables))

    def recordings(self):
        return sorted((self.root / "results").glob("*/*"))

    def expect_nothing_recorded(self):
        self.assertEqual(self.recordings(), [])
        self.assertEqual(list((self.root / "build").glob("recording-*")), [])

    def test_leaves_a_complete_folder_named_after_machine_date_and_commit(self):
        done = self.record()
        self.assertEqual(done.returncode, 0, done.stderr)
        [recording] = self.recordings()
        self.assertEqual(recording.parent.name, "xeon-2.8ghz-avx512-2-cores")
        today = datetime.datetime.now(datetime.timezone.utc).date().isoformat()
        self.assertEqual(recording.name, f"{today}-{self.git('rev-parse', '--short=7', 'HEAD')}")
        self.assertEqual({path.name for path in recording.iterdir()}, {"README.md", "plots", "results.csv", "run.json"})
        self.assertEqual([path.name for path in (recording / "plots").iterdir()], ["latency.png"])
        lines = (recording / "README.md").read_text(encoding="utf-8").splitlines()
        self.assertEqual([line.split(":")[0] for line in lines], ["What", "How", "On"])
        self.assertIn("`scripts/record`", lines[1])
        self.assertEqual(list((self.root / "build").glob("recording-*")), [])

    def test_hands_the_chosen_contestants_and_papers_on(self):
        done = self.record("--only", "grid-group", "fcl:bv=obbrss", "--papers", PAPERS_STATUS="1")
        self.assertEqual(done.returncode, 0, done.stderr)
        [recording] = self.recordings()
        self.assertEqual([path.name for path in (recording / "papers" / "park-jang-2018").iterdir()], ["report.md"])
        log = (self.directory / "log").read_text(encoding="utf-8").splitlines()
        self.assertTrue(log[0].endswith("--detector grid-group --detector fcl:bv=obbrss"), log)
        self.assertEqual(log[2], "validate")

    def test_adds_the_growth_with_the_mesh(self):
        done = self.record("--scaling", "--only", "embree")
        self.assertEqual(done.returncode, 0, done.stderr)
        [recording] = self.recordings()
        self.assertTrue((recording / "scaling" / "scaling.csv").exists())
        log = (self.directory / "log").read_text(encoding="utf-8").splitlines()
        self.assertEqual(log[1:], ["scale --detector embree", "validate"])

    def test_adds_the_suite_as_planned_or_for_as_many_minutes_as_asked(self):
        for minutes, words in (([], ""), (["30"], " --cells all --minutes 30")):
            with self.subTest(minutes):
                done = self.record("--suite", *minutes, "--only", "embree")
                self.assertEqual(done.returncode, 0, done.stderr)
                [recording] = self.recordings()
                self.assertEqual((recording / "suite" / "suite.csv").read_text(encoding="utf-8"), "bunny,slide,ok,grid-group\n")
                log = (self.directory / "log").read_text(encoding="utf-8").splitlines()
                self.assertEqual(log[1:], [f"bench --suite{words} --detector embree", "validate"])
                shutil.rmtree(recording)
                (self.directory / "log").unlink()

    def test_records_other_comparisons_beside_the_default_one(self):
        done = self.record("--beside", "touches", "unlimited", "update")
        self.assertEqual(done.returncode, 0, done.stderr)
        [recording] = self.recordings()
        self.assertTrue(recording.name.endswith(self.git("rev-parse", "--short=7", "HEAD")), recording.name)
        for path in ("results.csv", "touches/results.csv", "unlimited/run.json", "update/update.csv"):
            self.assertTrue((recording / path).exists(), path)
        log = (self.directory / "log").read_text(encoding="utf-8").splitlines()
        self.assertIn("/touches --query touches --detector aabb-tree", log[1])
        self.assertIn("/unlimited --reach inf --detector aabb-tree", log[2])
        self.assertEqual(log[3:], ["update ", "validate"])

    def test_leaves_the_contestants_of_a_frontier_to_the_program(self):
        done = self.record("--beside", "frontier")
        self.assertEqual(done.returncode, 0, done.stderr)
        [recording] = self.recordings()
        self.assertTrue((recording / "frontier" / "results.csv").exists())
        log = (self.directory / "log").read_text(encoding="utf-8").splitlines()
        self.assertTrue(log[1].endswith("/frontier --frontier"), log)

    def test_refuses_a_changed_tree(self):
        for path, text in (("core/code", "int y;\n"), ("core/new", ""), ("elsewhere/new", "")):
            file = self.root / path
            file.parent.mkdir(exist_ok=True)
            file.write_text(text, encoding="utf-8")
            done = self.record()
            self.assertEqual(done.returncode, 2, path)
            self.assertIn(path, done.stderr)
            self.git("stash", "-u", "-q")
        self.expect_nothing_recorded()
        self.assertFalse((self.directory / "log").exists(), "nothing was measured")

    def test_never_writes_over_a_recording(self):
        self.assertEqual(self.record().returncode, 0)
        [recording] = self.recordings()
        (self.root / ".git" / "info" / "exclude").write_text("/results/\n", encoding="utf-8")
        (recording / "results.csv").write_text("precious", encoding="utf-8")
        done = self.record()
        self.assertEqual(done.returncode, 2)
        self.assertIn("is there already", done.stderr)
        self.assertEqual((recording / "results.csv").read_text(encoding="utf-8"), "precious")

    def test_leaves_nothing_of_a_run_that_failed(self):
        for variables, status in (({"BENCH_STATUS": "1"}, 1), ({"BENCH_STATUS": "130"}, 130), ({"VALIDATE_STATUS": "1"}, 1)):
            done = self.record(**variables)
            self.assertEqual(done.returncode, status, variables)
            self.assertIn("nothing is recorded", done.stderr)
        done = self.record("--papers", PAPERS_STATUS="3")
        self.assertEqual(done.returncode, 3)
        done = self.record("--beside", "update", UPDATE_STATUS="1")
        self.assertEqual(done.returncode, 1)
        done = self.record("--scaling", SCALE_STATUS="1")
        self.assertEqual(done.returncode, 1)
        self.assertIn("nothing is recorded", done.stderr)
        self.expect_nothing_recorded()

    def test_leaves_nothing_when_it_is_interrupted_while_the_program_writes(self):
        begun, ended = self.directory / "log.begun", self.directory / "log.ended"
        # From a terminal the whole group is told, by a supervisor the script alone.
        for number, tell, status in ((signal.SIGINT, os.killpg, 130), (signal.SIGTERM, os.kill, 143)):
            with subprocess.Popen([self.root / "scripts" / "record"], stdout=subprocess.DEVNULL, stderr=subprocess.PIPE,
                                  text=True, cwd=self.directory, stdin=subprocess.DEVNULL, start_new_session=True,
                                  # Else an interrupt stays ignored where these tests run in the background.
                                  preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL),
                                  env=self.environment(BENCH_HANGS="yes")) as process:
                while not begun.exists():
                    self.assertIsNone(process.poll(), "it ended by itself")
                    time.sleep(0.02)
                tell(process.pid, number)
                said = process.communicate()[1]
            self.assertEqual(process.returncode, status, said)
            self.assertIn("nothing is recorded", said)
            self.assertTrue(ended.exists(), "it did not wait for the program")
            self.expect_nothing_recorded()
            begun.unlink()
            ended.unlink()

    def test_refuses_what_it_does_not_know(self):
        for words in (["--fast"], ["--only"], ["--only", "--papers"], ["--beside"], ["--beside", "everything"], ["--suite", "0"], ["--suite", "long"], ["here"]):
            done = self.record(*words)
            self.assertEqual(done.returncode, 2, words)
        self.expect_nothing_recorded()

    def test_names_machines_without_naming_hosts(self):
        for cpuinfo, name in ((XEON, "xeon-2.8ghz-avx512-2-cores"),
                              ("model name\t: AMD EPYC 7763 64-Core Processor\nflags\t: sse4_2 avx avx2\n", "epyc-7763-avx2-2-cores"),
                              ("model name\t: Intel(R) Core(TM) i7-9750H CPU @ 2.60GHz\nflags\t: avx2\n",
                               "core-i7-9750h-2.6ghz-avx2-2-cores")):
            (self.directory / "cpuinfo").write_text(cpuinfo, encoding="utf-8")
            done = self.record("--machine")
            self.assertEqual((done.returncode, done.stdout), (0, name + "\n"))


if __name__ == "__main__":
    unittest.main()
