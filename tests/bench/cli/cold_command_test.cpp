/// What `touchmark bench` does with emptied caches, from the outside. No time is demanded of this machine.
#include <string>

#include <gtest/gtest.h>

#include "tests/bench/cli/csv_fields.h"
#include "tests/bench/cli/run_touchmark.h"
#include "tests/temporary_folder.h"

namespace touchmark::bench::cli {
namespace {

const Fields cold_columns{"cold_l2_ns_p50", "cold_l2_ns_p99", "cold_l2_ns_p999", "cold_ns_p50",
                          "cold_ns_p99",    "cold_ns_max",    "cold_samples",    "cold_l2_samples"};

/// The first row of what `bench` with these options leaves.
Row first_row(const Fields& more, Outcome& outcome) {
  const TemporaryFolder folder;
  Fields command{"bench",   "--mesh", "icosphere:2", "--trajectory", "slide", "--quick",
                 "--steps", "300",    "--detector",  "aabb-tree",    "--out", folder.file("out")};
  command.insert(command.end(), more.begin(), more.end());
  outcome = run_touchmark(command);
  EXPECT_EQ(run_touchmark({"validate", folder.file("out")}).status, 0)
      << run_touchmark({"validate", folder.file("out")}).out;
  return rows_of(folder.file("out/results.csv")).at(0);
}

TEST(Cold, FillsItsColumnsAndPrintsTheFloor) {
  Outcome outcome;
  const auto row = first_row({}, outcome);
  EXPECT_EQ(row.at("status"), "ok") << outcome.err;
  for (const char* column : {"cold_l2_ns_p50", "cold_ns_p50", "cold_ns_max"})
    EXPECT_NE(row.at(column), "") << column;
  EXPECT_LE(std::stod(row.at("cold_ns_p50")), std::stod(row.at("cold_ns_max")));
  // How many samples there is time for is the machine's affair.
  EXPECT_GE(std::stoul(row.at("cold_samples")), 5u);
  EXPECT_EQ(row.at("cold_ns_p99").empty(), std::stoul(row.at("cold_samples")) < 100);
  EXPECT_EQ(row.at("cold_l2_ns_p99").empty(), std::stoul(row.at("cold_l2_samples")) < 100);
  EXPECT_EQ(row.at("cold_l2_ns_p999").empty(), std::stoul(row.at("cold_l2_samples")) < 1000);
  EXPECT_NE(outcome.out.find("nothing asked"), std::string::npos) << outcome.out;
}

TEST(Cold, TakesAllOfTheSamplesAskedFor) {
  Outcome outcome;
  const auto row = first_row({"--cold-samples", "7"}, outcome);
  EXPECT_EQ(row.at("cold_samples"), "7") << outcome.err;
  EXPECT_EQ(row.at("cold_l2_samples"), "70");
  for (const Fields& bad : {Fields{"--cold-samples", "0"}, Fields{"--cold-samples", "many"},
                            Fields{"--cold-samples", "7", "--no-cold"}}) {
    Fields command{"bench", "--mesh", "icosphere:2"};
    command.insert(command.end(), bad.begin(), bad.end());
    EXPECT_EQ(run_touchmark(command).status, 2) << bad[1];
  }
}

TEST(Cold, IsLeftOutWhereThatIsAskedFor) {
  Outcome outcome;
  const auto row = first_row({"--no-cold"}, outcome);
  for (const std::string& column : cold_columns) EXPECT_EQ(row.at(column), "") << column;
  EXPECT_EQ(outcome.out.find("nothing asked"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace touchmark::bench::cli
