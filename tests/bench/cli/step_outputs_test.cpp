/// steps.bin and --steps-out of `touchmark bench`, from the outside: what they hold agrees with results.csv,
/// and `touchmark validate` sees where it does not.
#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/bench/cli/run_touchmark.h"

namespace touchmark::bench::cli {
namespace {

constexpr int steps = 200;

/// Rows without quotes, by column.
std::vector<std::map<std::string, std::string>> rows_of(const std::string& csv) {
  std::istringstream lines(csv);
  std::string line;
  const auto fields = [](const std::string& text) {
    std::vector<std::string> found;
    std::istringstream stream(text + ',');
    for (std::string field; std::getline(stream, field, ',');) found.push_back(field);
    return found;
  };
  std::getline(lines, line);
  const std::vector<std::string> names = fields(line);
  std::vector<std::map<std::string, std::string>> rows;
  while (std::getline(lines, line)) {
    const std::vector<std::string> values = fields(line);
    std::map<std::string, std::string>& row = rows.emplace_back();
    for (std::size_t i = 0; i < names.size() && i < values.size(); ++i) row[names[i]] = values[i];
  }
  return rows;
}

/// One run for all tests: who is right, who takes spheres for triangles and so errs, and who is asked by a
/// former name.
class StepOutputs : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const TemporaryFolder folder;
    const Outcome finished = run_touchmark({"bench",
                                            "--mesh",
                                            "icosphere:2",
                                            "--quick",
                                            "--no-cold",
                                            "--steps",
                                            std::to_string(steps),
                                            "--trajectory",
                                            "approach",
                                            "--detector",
                                            "aabb-tree",
                                            "--detector",
                                            "sphere-cluster:precise=false",
                                            "--detector",
                                            "auto",
                                            "--out",
                                            folder.path(),
                                            "--steps-out",
                                            folder.file("steps.csv"),
                                            "--benchmark_min_time=0.001"});
    ASSERT_EQ(finished.status, 0) << finished.err;
    results() = content_of(folder.file("results.csv"));
    binary() = content_of(folder.file("steps.bin"));
    csv() = content_of(folder.file("steps.csv"));
  }
  static std::string& results() {
    static std::string text;
    return text;
  }
  static std::string& binary() {
    static std::string bytes;
    return bytes;
  }
  static std::string& csv() {
    static std::string text;
    return text;
  }

  static Outcome validate(const std::string& results, const std::string& binary) {
    const TemporaryFolder folder;
    folder.file("results.csv", results);
    folder.file("steps.bin", binary);
    return run_touchmark({"validate", folder.file("steps.bin")});
  }
};

std::string contestant_of(const std::map<std::string, std::string>& row) {
  return row.at("detector") + ':' + row.at("options");
}

TEST_F(StepOutputs, TheCsvHasARowAStepAndContestantWithTheLargestTimeOfTheResults) {
  std::map<std::string, double> largest;
  std::map<std::string, int> count;
  for (const auto& row : rows_of(csv())) {
    double& most = largest[contestant_of(row)];
    most = std::max(most, std::stod(row.at("ns")));
    EXPECT_EQ(row.at("step"), std::to_string(count[contestant_of(row)]++));
    EXPECT_EQ(row.at("triangle").empty(), row.at("found") == "0");
  }
  for (const auto& row : rows_of(results())) {
    EXPECT_EQ(count.at(contestant_of(row)), steps);
    EXPECT_NEAR(largest.at(contestant_of(row)), std::stod(row.at("ns_max")),
                1e-5 * std::stod(row.at("ns_max")));
  }
}

TEST_F(StepOutputs, ValidateFindsThemFine) {
  const Outcome outcome = validate(results(), binary());
  EXPECT_EQ(outcome.status, 0) << outcome.out;
  EXPECT_NE(outcome.out.find("steps.bin: fine (steps of 1 trajectories)"), std::string::npos) << outcome.out;
}

TEST_F(StepOutputs, TheCsvNamesTheContestantsAsTheResultsDo) {
  std::set<std::pair<std::string, std::string>> told, expected;
  for (const auto& row : rows_of(csv())) told.emplace(row.at("detector"), row.at("options"));
  for (const auto& row : rows_of(results())) expected.emplace(row.at("detector"), row.at("options"));
  EXPECT_EQ(told, expected);
  EXPECT_TRUE(expected.contains({"sphere-cluster", ""}));
}

TEST_F(StepOutputs, ValidateFindsEachDamage) {
  ASSERT_GT(binary().size(), 2000U);
  std::string header_cut = binary();
  header_cut.resize(500);
  std::string block_damaged = binary();
  char& inside = block_damaged[block_damaged.size() - 50];
  inside = static_cast<char>(~inside);  // one bit alone may be padding
  std::string other_version = binary();
  other_version[8] = 2;
  for (const std::string& damaged : {std::string(), std::string("TMSTEPS\n"), header_cut, block_damaged,
                                     other_version, binary().substr(0, binary().size() - 1)}) {
    EXPECT_EQ(validate(results(), damaged).status, 1) << damaged.size();
  }
}

TEST_F(StepOutputs, ValidateFindsStepsOfAnotherRun) {
  std::string other = results();
  other.replace(other.find("\n1,") + 3, 8, "19990101");
  const Outcome outcome = validate(other, binary());
  EXPECT_EQ(outcome.status, 1) << outcome.out;
  EXPECT_NE(outcome.out.find("is not that of results.csv"), std::string::npos) << outcome.out;
}

TEST_F(StepOutputs, ARunThatBeginsTakesAwayTheStepsOfTheOneBefore) {
  const TemporaryFolder folder;
  folder.file("steps.bin", "of an earlier run");
  const Outcome outcome = run_touchmark({"bench", "--mesh", "cube", "--quick", "--no-cold", "--steps", "5",
                                         "--trajectory", "slide", "--detector", "aabb-tree", "--out",
                                         folder.path(), "--benchmark_min_time=0.001"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(run_touchmark({"validate", folder.path()}).status, 0);
}

TEST_F(StepOutputs, AFullDiskIsToldOfAndNoFileIsLeft) {
  const TemporaryFolder folder;
  const Outcome outcome = run_touchmark({"bench", "--mesh", "cube", "--quick", "--no-cold", "--steps", "5",
                                         "--trajectory", "slide", "--detector", "aabb-tree", "--steps-out",
                                         "/dev/full", "--benchmark_min_time=0.001"});
  EXPECT_EQ(outcome.status, 3) << outcome.err;
  EXPECT_NE(outcome.err.find("cannot write /dev/full"), std::string::npos) << outcome.err;
}

}  // namespace
}  // namespace touchmark::bench::cli
