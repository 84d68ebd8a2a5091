/// `touchmark many` from the outside.
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/bench/cli/csv_fields.h"
#include "tests/bench/cli/run_touchmark.h"
#include "tests/temporary_folder.h"

namespace touchmark::bench::cli {
namespace {

class Many : public testing::Test {
 protected:
  Outcome many(const Fields& more) const {
    Fields command{"many",    "--mesh", "icosphere:3", "--points", "500",   "--shell-points",   "300",
                   "--ticks", "4",      "--rounds",    "2",        "--out", folder_.file("out")};
    command.insert(command.end(), more.begin(), more.end());
    return run_touchmark(command);
  }
  std::vector<Fields> read(const Fields& columns) const {
    return fields_in(folder_.file("out/many.csv"), columns);
  }
  TemporaryFolder folder_;
};

TEST_F(Many, ChecksTheAnswersOfEveryKind) {
  const Outcome outcome = many({"--detector", "sphere-cluster", "--order", "automatic", "--threads", "2"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(
      read({"detector", "kind", "triangles", "points", "calls", "threads", "order", "differing", "status"}),
      (std::vector<Fields>{
          {"sphere-cluster", "coherent", "1280", "500", "1", "2", "automatic", "0", "ok"},
          {"sphere-cluster", "incoherent", "1280", "500", "1", "2", "automatic", "0", "ok"},
          {"sphere-cluster", "pointshell", "1280", "300", "4", "2", "automatic", "0", "ok"},
          {"sphere-cluster", "pointshell-close", "1280", "300", "4", "2", "automatic", "0", "ok"}}));
  const std::vector<Fields> answered = read({"answered"});
  EXPECT_EQ(answered[1], Fields{"500"});
  EXPECT_EQ(answered[3], Fields{"1200"});
  for (const Fields& row : read({"points_per_second", "ns_per_point", "us_per_call"}))
    for (const std::string& value : row) EXPECT_GT(std::stod(value), 0);
}

TEST_F(Many, AsksInEveryOrderFromAsManyThreads) {
  EXPECT_EQ(many({"--detector", "aabb-tree", "--kind", "incoherent", "--order", "curve", "--order",
                  "as-given", "--threads", "1", "--threads", "3"})
                .status,
            0);
  EXPECT_EQ(read({"order", "threads"}),
            (std::vector<Fields>{{"curve", "1"}, {"as-given", "1"}, {"curve", "3"}, {"as-given", "3"}}));
}

TEST_F(Many, RefusesWhatItDoesNotKnow) {
  expect_bad_input({"many", "--kind", "sorted"}, {"--kind", "sorted"});
  expect_bad_input({"many", "--order", "hilbert"}, {"--order", "hilbert"});
  expect_bad_input({"many", "--threads", "0"}, {"--threads"});
  expect_bad_input({"many", "--mesh", "icosphere:1", "--reach", "inf"}, {"--reach", "inf"});
}

}  // namespace
}  // namespace touchmark::bench::cli
