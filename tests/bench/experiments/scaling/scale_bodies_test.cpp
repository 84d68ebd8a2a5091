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
  const std::size_t at = damaged.rfind(",ok");
  damaged.replace(at, 3, ",differs");
  std::ofstream(folder_.file("out/bodies.csv")) << damaged;
  const Outcome outcome = run_touchmark({"validate", folder_.file("out")});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.out.find("does not go with differing"), std::string::npos) << outcome.out;
}

}  // namespace
}  // namespace touchmark::bench::cli
