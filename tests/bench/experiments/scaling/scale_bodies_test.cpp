/// `touchmark scale --bodies` from the outside.
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "tests/bench/cli/csv_fields.h"
#include "tests/bench/cli/run_touchmark.h"
#include "tests/temporary_folder.h"

namespace touchmark::bench::cli {
namespace {

class ScaleBodies : public testing::Test {
 protected:
  Outcome scale(const Fields& more) const {
    Fields command{"scale", "--bodies", "--quick", "--out", folder_.file("out")};
    command.insert(command.end(), more.begin(), more.end());
    return run_touchmark(command);
  }
  std::vector<Fields> read(const Fields& columns) const {
    return fields_in(folder_.file("out/bodies.csv"), columns);
  }
  TemporaryFolder folder_;
};

TEST_F(ScaleBodies, MeasuresEachNumberWithEachMotionFreeAndBeside) {
  const Outcome outcome = scale({"--sizes", "2,20", "--detector", "sphere-cluster", "--detector", "looped"});
  ASSERT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  std::vector<Fields> expected;
  const auto moved = [](const std::string& motion, const std::string& bodies) {
    return motion == "still" ? "0" : motion == "one" ? "1" : bodies;
  };
  for (const std::string motion : {"still", "one", "drift", "all"})
    for (const std::string bodies : {"1", "2", "20"})
      for (const std::string detector : {"sphere-cluster", "looped"})
        for (const std::string place : {"free", "beside"})
          expected.push_back({detector, bodies, motion, place, moved(motion, bodies), "0", "ok"});
  EXPECT_EQ(read({"detector", "bodies", "motion", "place", "moved", "differing", "status"}), expected);
  // Beside a body every query finds it, in free space none does.
  for (const Fields& row : read({"place", "found", "frames", "ticks_per_frame"}))
    EXPECT_EQ(std::stoi(row[1]), row[0] == "free" ? 0 : std::stoi(row[2]) * std::stoi(row[3]));
  EXPECT_NE(outcome.out.find("bodies^exponent"), std::string::npos) << outcome.out;
  const Outcome valid = run_touchmark({"validate", folder_.file("out")});
  EXPECT_EQ(valid.status, 0) << valid.out;
}

TEST_F(ScaleBodies, MeasuresTicksAfterWhatASceneOfOursPrepares) {
  ASSERT_EQ(scale({"--sizes", "2,20", "--detector", "sphere-cluster", "--detector", "looped"}).status, 0);
  const std::vector<Fields> rows = read({"detector", "bodies", "prepare_ns", "first_tick_prepared_ns",
                                         "tick_prepared_ns", "tick_prepared_over_one"});
  ASSERT_FALSE(rows.empty());
  for (const Fields& row : rows) {
    for (std::size_t i = 2; i < row.size(); ++i) EXPECT_EQ(row[i].empty(), row[0] == "looped") << i;
  }
}

TEST_F(ScaleBodies, ComparesTicksWithThoseOfASceneOfOneBodyThatIsTimedInTurns) {
  // A loop over all bodies takes a hundred times as long or more with ten thousand of them, beside a body,
  // too, where each query is dear. A scene of one body is compared with another one.
  ASSERT_EQ(scale({"--sizes", "1,10000", "--detector", "looped"}).status, 0);
  for (const Fields& row : read({"bodies", "tick_over_one", "first_tick_over_one"})) {
    const double over_one = std::stod(row[1]);
    EXPECT_GT(over_one, row[0] == "1" ? 0.1 : 20.0);
    EXPECT_LT(over_one, row[0] == "1" ? 10.0 : 1e5);
    // The clock may not tell the first tick with one body from nothing.
    if (row[0] != "1" && !row[2].empty()) {
      EXPECT_GT(std::stod(row[2]), 20);
    }
  }
}

TEST_F(ScaleBodies, SaysWhoTakesNoMovingBodiesAndGoesOn) {
  const Outcome outcome = scale({"--sizes", "2,3", "--detector", "sphere-cluster", "--detector", "merged"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  for (const Fields& row : read({"detector", "motion", "status"}))
    EXPECT_EQ(row[2].starts_with("refused"), row[0] == "merged" && row[1] != "still") << row[2];
}

TEST_F(ScaleBodies, RefusesWhatIsOfMeshesInOneLine) {
  expect_bad_input({"scale", "--bodies", "--mesh", "cube"}, {"--mesh", "--bodies"});
  expect_bad_input({"scale", "--bodies", "--trajectory", "slide"}, {"--trajectory", "--bodies"});
  expect_bad_input({"scale", "--bodies", "--sizes", "0,5"}, {"bodies", "\"0\""});
  expect_bad_input({"scale", "--bodies", "--sizes", "10,2M"}, {"bodies", "2M"});
}

TEST_F(ScaleBodies, ValidateNamesARowThatDoesNotAgreeWithItself) {
  ASSERT_EQ(scale({"--sizes", "2,3", "--detector", "sphere-cluster"}).status, 0);
  std::ifstream file(folder_.file("out/bodies.csv"));
  std::stringstream text;
  text << file.rdbuf();
  std::string damaged = text.str();
  const std::size_t at = damaged.rfind(",ok,");
  damaged.replace(at, 4, ",differs,");
  std::ofstream(folder_.file("out/bodies.csv")) << damaged;
  const Outcome outcome = run_touchmark({"validate", folder_.file("out")});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.out.find("does not go with differing"), std::string::npos) << outcome.out;
}

TEST_F(ScaleBodies, ValidateTakesFilesWithoutTheColumnsThatCameLater) {
  ASSERT_EQ(scale({"--sizes", "2,3", "--detector", "sphere-cluster"}).status, 0);
  std::stringstream text;
  text << std::ifstream(folder_.file("out/bodies.csv")).rdbuf();
  // Before what is prepared, and before first ticks over those with one body.
  for (const int later : {6, 2}) {
    std::string older;
    std::istringstream lines(text.str());
    for (std::string line; std::getline(lines, line);) {
      for (int i = 0; i < later; ++i) line.resize(line.rfind(','));
      older += line + "\n";
    }
    std::ofstream(folder_.file("out/bodies.csv")) << older;
    const Outcome outcome = run_touchmark({"validate", folder_.file("out")});
    EXPECT_EQ(outcome.status, 0) << later << outcome.out;
  }
}

}  // namespace
}  // namespace touchmark::bench::cli
