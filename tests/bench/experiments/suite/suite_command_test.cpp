/// `touchmark bench --suite` from the outside.
#include <fstream>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/bench/cli/csv_fields.h"
#include "tests/bench/cli/run_touchmark.h"
#include "tests/temporary_folder.h"

namespace touchmark::bench::cli {
namespace {

class Suite : public testing::Test {
 protected:
  Outcome suite(const Fields& more) const {
    Fields command{"bench", "--suite", "--quick", "--out", folder_.file("out")};
    command.insert(command.end(), more.begin(), more.end());
    return run_touchmark(command);
  }
  TemporaryFolder folder_;
};

TEST_F(Suite, OneMeshGetsAScoreAndLeavesWhatIsValid) {
  const Outcome outcome = suite({"--mesh", "icosphere:2", "--cells", "3", "--steps", "200", "--detector",
                                 "sphere-cluster", "--detector", "grid-group"});
  ASSERT_TRUE(outcome.status == 0) << outcome.err;
  EXPECT_NE(outcome.out.find("geometric mean"), std::string::npos) << outcome.out;
  const std::vector<Fields> cells =
      fields_in(folder_.file("out/suite.csv"), {"mesh", "triangles", "caches", "ours", "status", "seed"});
  // Three cells; two contestants, and the best of them.
  ASSERT_EQ(cells.size(), 9U);
  for (const Fields& cell : cells) {
    EXPECT_EQ(cell[0], "icosphere:2");
    EXPECT_EQ(cell[1], "320");
    EXPECT_EQ(cell[4], "ok");
    EXPECT_EQ(cell[5], "1");
  }
  EXPECT_EQ(fields_in(folder_.file("out/results.csv"), {"detector"}).size(), 6U);
  const Outcome validated = run_touchmark({"validate", folder_.file("out")});
  EXPECT_EQ(validated.status, 0) << validated.out;
  nlohmann::json run;
  std::ifstream(folder_.file("out/run.json")) >> run;
  EXPECT_EQ(run["suite"]["cells"], 3);
}

TEST_F(Suite, MeasuresAllThatItPlansAndAsManyColdQueriesAsAskedFor) {
  const Outcome outcome = suite({"--mesh", "icosphere:2", "--cells", "6", "--cold-samples", "3", "--steps",
                                 "200", "--detector", "sphere-cluster", "--detector", "aabb-tree"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("all of them measured"), std::string::npos) << outcome.out;
  std::map<Fields, int> rows;
  for (const Fields& cell : fields_in(folder_.file("out/suite.csv"), {"section", "caches", "status"}))
    ++rows[cell];
  // Both are ours, and so is the best: five cells of hands, one also with all caches emptied, and one of
  // stress.
  const std::map<Fields, int> expected{{{"hand", "warm", "ok"}, 15},
                                       {{"hand", "l2", "ok"}, 15},
                                       {{"hand", "cold", "ok"}, 3},
                                       {{"stress", "warm", "ok"}, 3}};
  EXPECT_EQ(rows, expected);
  for (const Fields& row :
       fields_in(folder_.file("out/results.csv"), {"trajectory", "cold_samples", "cold_l2_samples"})) {
    EXPECT_TRUE(row[1].empty() || row[1] == "3") << row[0];
    EXPECT_TRUE(row[2].empty() || row[2] == "30") << row[0];
  }
  EXPECT_EQ(run_touchmark({"validate", folder_.file("out")}).status, 0);
}

TEST_F(Suite, WhatDoesNotFitIntoItsMinutesIsNotMeasuredAndSaidSo) {
  const Outcome outcome = suite({"--mesh", "icosphere:2", "--cells", "5", "--minutes", "0.00001", "--steps",
                                 "200", "--detector", "sphere-cluster", "--detector", "aabb-tree"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("4 planned cells were not measured"), std::string::npos) << outcome.out;
  EXPECT_EQ(run_touchmark({"validate", folder_.file("out")}).status, 0);
}

TEST_F(Suite, WhatItChoosesItselfCannotBeGiven) {
  for (const Fields& more : std::vector<Fields>{{"--trajectory", "slide"},
                                                {"--query", "touches"},
                                                {"--reach", "1%"},
                                                {"--cells", "0"},
                                                {"--cells", "1000"},
                                                {"--minutes", "0"},
                                                {"--detector", "embree"}}) {
    const Outcome outcome = suite(more);
    EXPECT_EQ(outcome.status, 2) << more.front() << outcome.err;
  }
  EXPECT_EQ(run_touchmark({"bench", "--cells", "3"}).status, 2);
}

}  // namespace
}  // namespace touchmark::bench::cli
