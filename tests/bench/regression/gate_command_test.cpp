/// `touchmark gate` on contestants whose speed the test sets.
#include <cstdlib>
#include <filesystem>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/bench/cli/run_touchmark.h"

namespace touchmark::bench::cli {
namespace {

const std::string hostile = TOUCHMARK_HOSTILE_PROGRAM;

/// The hostile contestants' times are what they claim, so that verdicts are the gate's and not the machine's.
/// What they claim is set in the environment that the workers inherit.
class Gate : public testing::Test {
 protected:
  void TearDown() override {
    ::unsetenv("TOUCHMARK_TEST_COST_NS");
    ::unsetenv("TOUCHMARK_TEST_COUNTER");
  }
  void write_baseline() const {
    const Outcome outcome = gate("paced", {"--write-baseline"});
    ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  }
  Outcome gate(const std::string& detector, const std::vector<std::string>& more = {},
               const std::string& reference = "honest") const {
    std::vector<std::string> command{hostile,        "gate",
                                     "--mesh",       "icosphere:0",
                                     "--steps",      "200",
                                     "--trajectory", "slide",
                                     "--detector",   detector,
                                     "--reference",  reference,
                                     "--baseline",   folder_.file("baseline.csv"),
                                     "--tolerance",  "10%",
                                     "--rounds",     "15"};
    command.insert(command.end(), more.begin(), more.end());
    return run_program_at(command);
  }
  static void cost_ns(int cost) { ::setenv("TOUCHMARK_TEST_COST_NS", std::to_string(cost).c_str(), 1); }

  TemporaryFolder folder_;
};

TEST_F(Gate, FailsWhatBecameSlowerAndPassesWhatDidNot) {
  write_baseline();
  const Outcome same = gate("paced");
  EXPECT_EQ(same.status, 0) << same.out << same.err;
  EXPECT_NE(same.out.find(" same "), std::string::npos) << same.out;
  EXPECT_NE(same.out.find(" answers judged exactly\n"), std::string::npos) << same.out;
  EXPECT_EQ(same.out.find("\n0 answers judged exactly\n"), std::string::npos) << same.out;
  cost_ns(10'800);
  const Outcome within_tolerance = gate("paced");
  EXPECT_EQ(within_tolerance.status, 0) << within_tolerance.out;
  cost_ns(11'200);
  const Outcome slower = gate("paced");
  EXPECT_EQ(slower.status, 1) << slower.out;
  EXPECT_NE(slower.out.find("SLOWER"), std::string::npos) << slower.out;
  cost_ns(8'800);
  const Outcome faster = gate("paced", {"--report", folder_.file("report.csv")});
  EXPECT_EQ(faster.status, 0) << faster.out;
  EXPECT_NE(content_of(folder_.file("report.csv")).find(",faster\n"), std::string::npos);
}

TEST_F(Gate, IsInconclusiveWhenTheReferenceDoesNotMeasureEqualToItself) {
  ::setenv("TOUCHMARK_TEST_COUNTER", folder_.file("counter").c_str(), 1);
  const Outcome outcome = gate("honest", {"--write-baseline"}, "moody");
  EXPECT_EQ(outcome.status, 4) << outcome.out << outcome.err;
  EXPECT_NE(outcome.err.find("moody did not measure equal to itself"), std::string::npos) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder_.file("baseline.csv"))) << "nothing is written from noise";
}

TEST_F(Gate, FailsOtherAnswersThanInTheBaseline) {
  write_baseline();
  std::string csv = content_of(folder_.file("baseline.csv"));
  const std::size_t checksum = csv.find(",20,20,") + 7;  // behind the work: all triangles in every step
  ASSERT_NE(checksum, std::string::npos + 7) << csv;
  csv[checksum] = csv[checksum] == '0' ? '1' : '0';
  folder_.file("baseline.csv", csv);
  const Outcome outcome = gate("paced");
  EXPECT_EQ(outcome.status, 1) << outcome.out;
  EXPECT_NE(outcome.out.find("answers differ"), std::string::npos) << outcome.out;
}

TEST_F(Gate, FailsWrongAnswersAndCrashes) {
  for (const std::string detector : {"lies", "aborts", "refuses", "fickle"}) {
    const Outcome outcome = gate(detector, {"--write-baseline"});
    EXPECT_EQ(outcome.status, 1) << detector << outcome.out << outcome.err;
    EXPECT_NE(outcome.err.find(detector + " on slide: "), std::string::npos) << outcome.err;
  }
}

TEST_F(Gate, TakesAnswersThatDependOnThoseBeforeWithinTheirWord) {
  const Outcome outcome = gate("settles", {"--write-baseline"});
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  const Outcome failed = gate("drifts", {"--write-baseline"});
  EXPECT_EQ(failed.status, 1) << failed.out << failed.err;
}

TEST_F(Gate, RefusesABaselineForSomethingElse) {
  const Outcome absent = gate("paced");
  EXPECT_EQ(absent.status, 2);
  EXPECT_NE(absent.err.find("baseline.csv"), std::string::npos) << absent.err;
  write_baseline();
  const Outcome other_detector = gate("honest");
  EXPECT_EQ(other_detector.status, 2);
  EXPECT_NE(other_detector.err.find("no row for honest against honest"), std::string::npos);
  const Outcome other_trace = gate("paced", {"--seed", "2"});
  EXPECT_EQ(other_trace.status, 2);
  EXPECT_NE(other_trace.err.find("another trajectory"), std::string::npos) << other_trace.err;
  const Outcome other_mesh = gate("paced", {"--normalize"});
  EXPECT_EQ(other_mesh.status, 2);
  EXPECT_NE(other_mesh.err.find("another mesh"), std::string::npos) << other_mesh.err;
}

TEST_F(Gate, KeepsTheOtherRowsOfABaseline) {
  write_baseline();
  ASSERT_EQ(gate("honest", {"--write-baseline"}).status, 0);
  const std::string csv = content_of(folder_.file("baseline.csv"));
  EXPECT_NE(csv.find(",paced,"), std::string::npos);
  EXPECT_NE(csv.find(",honest,"), std::string::npos);
}

TEST_F(Gate, NamesWhatIsWrongOnTheCommandLine) {
  expect_bad_input({"gate", "--baseline", "b.csv", "--mesh", "cube"}, {"--detector"});
  expect_bad_input({"gate", "--mesh", "cube", "--detector", "aabb-tree"}, {"--baseline"});
  for (const char* tolerance : {"0", "100%", "-5%", "x"}) {
    expect_bad_input({"gate", "--mesh", "cube", "--detector", "aabb-tree", "--baseline", "b.csv",
                      "--tolerance", tolerance},
                     {"--tolerance", tolerance});
  }
  expect_bad_input(
      {"gate", "--mesh", "cube", "--detector", "aabb-tree", "--baseline", "b.csv", "--rounds", "2"},
      {"--rounds \"2\""});
  expect_bad_input(
      {"gate", "--mesh", "cube", "--detector", "aabb-tree", "--baseline", "b.csv", "--reference", "no-such"},
      {"no-such"});
}

}  // namespace
}  // namespace touchmark::bench::cli
