/// Nothing judged is never "as claimed": crashes, limits of the machine and closed descriptors, each with its
/// exit status and its line.
#include <algorithm>
#include <chrono>
#include <cmath>
#include <csignal>
#include <fstream>
#include <regex>
#include <sstream>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "tests/bench/cli/child_program.h"
#include "tests/bench/cli/run_touchmark.h"

namespace touchmark::bench::cli {
namespace {

const std::string hostile_program = TOUCHMARK_HOSTILE_PROGRAM;
const std::string small_verify =
    " verify --mesh noisy-sphere:500 --trajectory slide --steps 50 --query nearest --detector ";

/// `command` is for bash, which the program replaces: "ulimit -n 8; exec PROGRAM ...".
Outcome in_shell(const std::string& command) { return run_program_at({"/bin/bash", "-c", command}); }

std::size_t lines_in(const std::string& text) {
  return static_cast<std::size_t>(std::count(text.begin(), text.end(), '\n'));
}

bool says(const std::string& text, const std::string& words) { return text.find(words) != std::string::npos; }

/// How many depends on how busy the machine is: slow contestants are given fewer steps.
bool says_that_some_were_judged(const std::string& text) {
  return std::regex_search(text, std::regex("\n[1-9][0-9]* answers judged exactly\n"));
}

Outcome run_hostile(std::vector<std::string> arguments) {
  arguments.insert(arguments.begin(), hostile_program);
  return run_program_at(arguments);
}

TEST(NothingJudged, OfOneThatClaimsExactnessAndCrashesIsAFailure) {
  for (const std::string detector : {"aborts", "aborts-at-build", "exits"}) {
    const std::vector<std::string> on_cube{"--mesh",  "cube", "--trajectory", "slide",
                                           "--steps", "20",   "--detector",   detector};
    std::vector<std::string> verify{"verify", "--query", "nearest"}, bench{"bench", "--quick", "--no-cold"};
    verify.insert(verify.end(), on_cube.begin(), on_cube.end());
    bench.insert(bench.end(), on_cube.begin(), on_cube.end());
    const Outcome verified = run_hostile(verify), timed = run_hostile(bench);
    EXPECT_EQ(verified.status, 1) << verified.out;
    EXPECT_TRUE(says(verified.out, "BROKEN " + detector)) << verified.out;
    EXPECT_TRUE(says(verified.out, "\n0 answers judged exactly\n")) << verified.out;
    EXPECT_FALSE(says(verified.out, "as claimed")) << verified.out;
    EXPECT_EQ(timed.status, 1) << timed.out;
    EXPECT_TRUE(says(timed.err, detector + " on slide: crashed:")) << timed.err;
    EXPECT_EQ(lines_in(timed.err), 1U) << timed.err;
    EXPECT_TRUE(says(timed.out, "\n0 answers judged exactly\n")) << timed.out;
  }
}

TEST(NothingJudged, InStressIsAFailureOfOneThatClaimsExactness) {
  const Outcome outcome =
      run_hostile({"stress", "--family", "tangent", "--probes", "30", "--detector", "aborts-at-build"});
  EXPECT_EQ(outcome.status, 1) << outcome.out;
  EXPECT_TRUE(says(outcome.out, "BROKEN")) << outcome.out;
  EXPECT_FALSE(says(outcome.out, "as claimed")) << outcome.out;
}

TEST(NothingJudged, AfterAnUpdateIsAFailureOfOneThatClaimsExactnessAndCrashes) {
  const Outcome outcome = run_hostile({"update", "--mesh", "icosphere:1", "--steps", "20", "--shares", "100%",
                                       "--detector", "aborts-at-build"});
  EXPECT_EQ(outcome.status, 1) << outcome.out;
  EXPECT_EQ(outcome.err, "touchmark: aborts-at-build after 100 % moved: crashed:SIGABRT\n");
}

TEST(NothingJudged, OfQueriesThatNobodyAnswersIsInconclusive) {
  const std::vector<std::string> sweeps{"--mesh", "cube",    "--trajectory", "slide",      "--steps",
                                        "20",     "--query", "sweep",        "--detector", "touches-only"};
  for (const std::string command : {"verify", "bench"}) {
    std::vector<std::string> arguments{command};
    arguments.insert(arguments.end(), sweeps.begin(), sweeps.end());
    const Outcome outcome = run_hostile(arguments);
    EXPECT_EQ(outcome.status, 4) << command << outcome.out;
    EXPECT_EQ(outcome.err, "touchmark: inconclusive: 0 answers were judged\n");
    EXPECT_EQ(says(outcome.out, "nothing judged"), command == "verify") << outcome.out;
    EXPECT_FALSE(says(outcome.out, "as claimed")) << outcome.out;
  }
}

TEST(Limits, OfDescriptorsAreStatusThreeAndNamed) {
  const std::string program = std::string("exec ") + TOUCHMARK_PROGRAM;
  const std::string commands[] = {
      small_verify + "grid-group", " stress --family tangent --probes 20 --detector grid-group",
      " bench --quick --mesh cube --trajectory slide --steps 20 --detector grid-group"};
  for (const std::string& command : commands) {
    for (const int descriptors : {8, 9, 10}) {
      const Outcome outcome = in_shell("ulimit -n " + std::to_string(descriptors) + "; " + program + command);
      EXPECT_EQ(outcome.status, 3) << command << descriptors << outcome.out << outcome.err;
      EXPECT_TRUE(says(outcome.err, "no more than " + std::to_string(descriptors) + " open files"))
          << outcome.err;
      EXPECT_EQ(lines_in(outcome.err), 1U) << outcome.err;
      EXPECT_FALSE(says(outcome.out, "as claimed")) << outcome.out;
    }
  }
}

TEST(Limits, OfDescriptorsThatSufficeAreNoLimits) {
  const Outcome outcome =
      in_shell(std::string("ulimit -n 16; exec ") + TOUCHMARK_PROGRAM + small_verify + "grid-group");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(says_that_some_were_judged(outcome.out)) << outcome.out;
}

TEST(Limits, OfMemoryAreStatusThreeWhereAContestantHadNothingJudged) {
  const std::string on_cube =
      " --mesh icosphere:4 --trajectory slide --steps 20 --detector brute-force --detector "
      "grid-group:bytes_per_triangle=1e9";
  const std::string begin = std::string("ulimit -v 1048576; exec ") + TOUCHMARK_PROGRAM;
  for (const std::string& command : {" verify --query nearest" + on_cube, " bench --quick" + on_cube}) {
    const Outcome outcome = in_shell(begin + command);
    EXPECT_EQ(outcome.status, 3) << outcome.out << outcome.err;
    EXPECT_TRUE(says(outcome.err, "grid-group:bytes_per_triangle=1e9: nothing judged: refused: no memory: "))
        << outcome.err;
    EXPECT_EQ(lines_in(outcome.err), 1U) << outcome.err;
    EXPECT_TRUE(says_that_some_were_judged(outcome.out)) << outcome.out;
  }
}

TEST(Limits, OfTheSizeOfFilesAreStatusThreeAndNamed) {
  const Outcome outcome =
      in_shell(std::string("ulimit -f 1; exec ") + TOUCHMARK_PROGRAM + small_verify + "grid-group");
  EXPECT_EQ(outcome.status, 3) << outcome.out << outcome.err;
  EXPECT_TRUE(says(outcome.err, "ulimit -f")) << outcome.err;
}

TEST(ClosedDescriptors, AreNoCrashes) {
  const std::string command = TOUCHMARK_PROGRAM + small_verify + "grid-group --detector brute-force";
  for (const std::string closed : {" <&-", " 2>&-", " <&- 2>&-"}) {
    const Outcome outcome = in_shell("exec " + command + closed);
    EXPECT_EQ(outcome.status, 0) << closed << outcome.out;
    EXPECT_TRUE(says_that_some_were_judged(outcome.out)) << closed << outcome.out;
    EXPECT_EQ(outcome.err, "") << closed;
  }
  for (const std::string closed : {" >&-", " <&- >&-"}) {
    const Outcome outcome = in_shell("exec " + command + closed);
    EXPECT_EQ(outcome.status, 3) << closed;
    EXPECT_TRUE(says(outcome.err, "cannot write to standard output")) << outcome.err;
    EXPECT_EQ(lines_in(outcome.err), 1U) << outcome.err;
  }
  EXPECT_EQ(in_shell("exec " + command + " <&- >&- 2>&-").status, 3);
}

TEST(ClosedDescriptors, DoNotHideABadArgument) {
  const Outcome outcome = in_shell(std::string("exec ") + TOUCHMARK_PROGRAM + " verify --steps none 2>&-");
  EXPECT_EQ(outcome.status, 2);
}

std::vector<int> children_of(pid_t process) {
  std::ifstream in("/proc/" + std::to_string(process) + "/task/" + std::to_string(process) + "/children");
  std::vector<int> children;
  for (int child = 0; in >> child;) children.push_back(child);
  return children;
}

/// The contestant marks a file when it is being built, which is after its worker came up.
TEST(Bench, AKilledWorkerIsAFailureOfOneThatClaimsExactness) {
  const TemporaryFolder folder;
  const std::string mark = folder.file("mark");
  ::setenv("TOUCHMARK_TEST_COUNTER", mark.c_str(), 1);
  const ChildProgram child({hostile_program, "bench", "--mesh", "cube", "--steps", "20", "--quick",
                            "--no-cold", "--trajectory", "slide", "--detector", "stalls", "--timeout", "60"});
  for (int i = 0; i < 1200 && content_of(mark).empty(); ++i)
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  const std::vector<int> workers = children_of(child.id());
  ASSERT_EQ(workers.size(), 1U);
  ::kill(workers.front(), SIGKILL);
  const Outcome outcome = child.wait();
  ::unsetenv("TOUCHMARK_TEST_COUNTER");
  EXPECT_EQ(outcome.status, 1) << outcome.out;
  EXPECT_EQ(outcome.err, "touchmark: stalls on slide: crashed:SIGKILL\n");
  EXPECT_TRUE(says(outcome.out, "\n0 answers judged exactly\n")) << outcome.out;
}

/// The lines of `text` that are commands, each with the program that is to run it.
std::vector<std::string> commands_in(const std::string& text, const std::string& program) {
  std::vector<std::string> commands;
  std::istringstream lines(text);
  for (std::string line; std::getline(lines, line);) {
    const std::string begin = "    touchmark ";
    if (line.starts_with(begin)) commands.push_back(program + " " + line.substr(begin.size()));
  }
  return commands;
}

/// 40 steps in metres along a meridian of the unit sphere of millimetres, under names of their own.
std::string motion_in_metres() {
  const std::string path = ::testing::TempDir() + "motion_in_metres.csv";
  std::ofstream file(path);
  file << "a,b,c\n";
  for (int i = 0; i < 40; ++i)
    file << 0.001 * std::cos(0.01 * i) << ',' << 0.001 * std::sin(0.01 * i) << ",0\n";
  return path;
}

TEST(WrongAnswers, AreToldWithTheCommandsThatRepeatThem) {
  const std::string told[] = {
      run_hostile({"verify", "--mesh", "icosphere:2", "--steps", "40", "--trajectory", "slide", "--query",
                   "nearest", "--detector", "lies"})
          .out,
      run_hostile({"bench", "--mesh", "icosphere:2", "--steps", "40", "--trajectory", "slide", "--quick",
                   "--no-cold", "--detector", "lies"})
          .out,
      run_hostile({"verify", "--mesh", "icosphere:2", "--trajectory", motion_in_metres(), "--columns",
                   "x=a,y=b,z=c", "--motion-scale", "1000", "--query", "nearest", "--detector", "lies"})
          .out,
      run_hostile({"stress", "--family", "thresholds", "--probes", "60", "--detector", "lies"}).out};
  for (const std::string& text : told) {
    const std::regex wrong(
        "  step ([0-9]+) \\(1 distance\\): probe .*; expected ([0-9.e+-]+) to triangle .*; got ([0-9.e+-]+) "
        "to triangle ");
    std::vector<std::smatch> steps;
    for (std::sregex_iterator i(text.begin(), text.end(), wrong), end; i != end; ++i) steps.push_back(*i);
    const std::vector<std::string> commands = commands_in(text, hostile_program);
    ASSERT_EQ(steps.size(), 3U) << text;
    ASSERT_EQ(commands.size(), 3U) << text;
    for (std::size_t i = 0; i < steps.size(); ++i) {
      EXPECT_NE(steps[i][2], steps[i][3]);
      const Outcome again = in_shell(commands[i]);
      EXPECT_EQ(again.status, 0) << commands[i] << again.err;
      EXPECT_TRUE(says(again.out, "\n" + steps[i][1].str() + ",")) << again.out;
      EXPECT_TRUE(says(again.out, "," + steps[i][3].str() + ",")) << commands[i] << "\n" << again.out << text;
    }
  }
}

TEST(Query, AStepAloneIsThatOfTheWhole) {
  const std::vector<std::string> whole{"query",   "--mesh", "icosphere:2", "--trajectory", "slide",
                                       "--steps", "30",     "--detector",  "grid-group"};
  std::istringstream rows(run_touchmark(whole).out);
  std::string header, row;
  std::getline(rows, header);
  for (int step = 0; step < 30; ++step) {
    std::getline(rows, row);
    if (step % 11 != 0) continue;
    for (const std::string session : {"replayed", "fresh"}) {
      std::vector<std::string> alone = whole;
      alone.insert(alone.end(), {"--step", std::to_string(step), "--session", session});
      const Outcome outcome = run_touchmark(alone);
      EXPECT_EQ(outcome.status, 0) << outcome.err;
      EXPECT_EQ(outcome.out, header + "\n" + row + "\n") << session;
      EXPECT_EQ(outcome.err, "");
    }
  }
}

TEST(Query, RefusesAStepThatIsNot) {
  const std::vector<std::string> query{"query", "--mesh",     "cube",       "--steps",
                                       "10",    "--detector", "brute-force"};
  const auto with = [&](std::vector<std::string> more) {
    more.insert(more.begin(), query.begin(), query.end());
    return more;
  };
  expect_bad_input(with({"--step", "10"}), {"--step", "10"});
  expect_bad_input(with({"--step", "first"}), {"--step", "first"});
  expect_bad_input(with({"--session", "fresh"}), {"--session", "--step"});
  expect_bad_input({"stress", "--family", "tangent", "--detector", "brute-force", "--repeat", "nearest/0"},
                   {"--repeat", "nearest/0"});
  expect_bad_input({"stress", "--detector", "brute-force", "--repeat", "nearest/0/0/1"},
                   {"--repeat", "--family"});
}

}  // namespace
}  // namespace touchmark::bench::cli
