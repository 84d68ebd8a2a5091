/// `touchmark scale` from the outside.
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/bench/cli/csv_fields.h"
#include "tests/bench/cli/run_touchmark.h"
#include "tests/temporary_folder.h"

namespace touchmark::bench::cli {
namespace {

class Scale : public testing::Test {
 protected:
  Outcome scale(const Fields& more) const {
    Fields command{"scale",      "--quick",   "--steps", "60",
                   "--detector", "aabb-tree", "--out",   folder_.file("out")};
    command.insert(command.end(), more.begin(), more.end());
    return run_touchmark(command);
  }
  std::vector<Fields> read(const std::string& name, const Fields& columns) const {
    return fields_in(folder_.file("out/" + name), columns);
  }
  TemporaryFolder folder_;
};

TEST_F(Scale, MeasuresEachSizeFitsAndLeavesWhatIsValid) {
  const Outcome outcome = scale({"--sizes", "100,1k,4k", "--detector", "brute-force"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("noisy-sphere, slide, nearest: exponent"), std::string::npos) << outcome.out;
  EXPECT_EQ(read("results.csv", {"mesh", "triangles", "detector", "status"}),
            (std::vector<Fields>{{"noisy-sphere:100", "100", "aabb-tree", "ok"},
                                 {"noisy-sphere:100", "100", "brute-force", "ok"},
                                 {"noisy-sphere:1000", "1000", "aabb-tree", "ok"},
                                 {"noisy-sphere:1000", "1000", "brute-force", "ok"},
                                 {"noisy-sphere:4000", "4000", "aabb-tree", "ok"},
                                 {"noisy-sphere:4000", "4000", "brute-force", "ok"}}));
  bool found = false;
  for (const Fields& fit : read("scaling.csv", {"detector", "quantity", "points", "exponent"})) {
    if (fit[0] != "brute-force" || fit[1] != "bytes") continue;
    found = true;
    EXPECT_EQ(fit[2], "3");
    EXPECT_NEAR(std::stod(fit[3]), 1, 0.01);  // so many bytes a triangle
  }
  EXPECT_TRUE(found);
  EXPECT_EQ(run_touchmark({"validate", folder_.file("out")}).status, 0);
}

TEST_F(Scale, ShrinksTheReachAsTheEdgesDo) {
  EXPECT_EQ(scale({"--sizes", "100,400", "--radius", "0.1", "--shrink", "all"}).status, 0);
  EXPECT_EQ(read("results.csv", {"triangles", "radius", "trajectory"}),
            (std::vector<Fields>{{"100", "0.1", "slide"}, {"400", "0.05", "slide"}}));
  for (const Fields& fit : read("scaling.csv", {"shrinks", "trajectory"}))
    EXPECT_EQ(fit, (Fields{"all", "slide"}));
  const Outcome wrong = run_touchmark({"scale", "--shrink", "speed"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.err.find("--shrink \"speed\""), std::string::npos) << wrong.err;
}

TEST_F(Scale, DescribesEveryMeshOfItsRows) {
  EXPECT_EQ(scale({"--sizes", "100,200", "--radius", "1%"}).status, 0);
  const std::string path = folder_.file("out/run.json");
  nlohmann::json run;
  std::ifstream(path) >> run;
  ASSERT_EQ(run["meshes"].size(), 2U);
  EXPECT_TRUE(run["finished"]);
  for (std::size_t i = 0; i < 2; ++i) {
    const nlohmann::json& mesh = run["meshes"][i];
    EXPECT_EQ(mesh["triangles"], 100 * (i + 1));
    EXPECT_NEAR(mesh["radius"], 0.01 * mesh["diagonal"].get<double>(), 1e-12);
  }
  run["meshes"].erase(1);
  std::ofstream(path) << run;
  const Outcome outcome = run_touchmark({"validate", folder_.file("out")});
  EXPECT_EQ(outcome.status, 1);
  EXPECT_NE(outcome.out.find("is not among run.json's meshes"), std::string::npos) << outcome.out;
}

TEST_F(Scale, LeavesOutOnLargerMeshesWhatTookTooLong) {
  const Outcome outcome = scale({"--sizes", "100,200,300", "--limit-seconds", "1e-6"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("aabb-tree: skipped: took "), std::string::npos) << outcome.err;
  const std::vector<Fields> rows = read("results.csv", {"triangles", "status"});
  ASSERT_EQ(rows.size(), 3U);
  EXPECT_EQ(rows[0], (Fields{"100", "ok"}));
  EXPECT_EQ(rows[1][1].substr(0, 14), "skipped: took ");
  EXPECT_NE(rows[1][1].find("on noisy-sphere:100"), std::string::npos) << rows[1][1];
  EXPECT_EQ(rows[2], (Fields{"300", rows[1][1]}));
  EXPECT_TRUE(read("scaling.csv", {"detector"}).empty());
  EXPECT_EQ(run_touchmark({"validate", folder_.file("out")}).status, 0);
}

TEST_F(Scale, TakesMeshesByName) {
  const Outcome outcome = scale({"--mesh", "icosphere:1", "--mesh", "icosphere:2", "--trajectory", "jump"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(read("results.csv", {"mesh", "trajectory"}),
            (std::vector<Fields>{{"icosphere:1", "jump"}, {"icosphere:2", "jump"}}));
  EXPECT_FALSE(read("scaling.csv", {"detector"}).empty());
}

TEST(ScaleCommand, NamesBadInput) {
  expect_bad_input({"scale", "--sizes", "1k"}, {"--sizes", "1k"});
  expect_bad_input({"scale", "--sizes", "1k,ten"}, {"--sizes", "ten"});
  expect_bad_input({"scale", "--mesh", "cube"}, {"--mesh", "cube"});
  expect_bad_input({"scale", "--mesh", "cube", "--mesh", "no-such"}, {"no-such"});
  expect_bad_input({"scale", "--limit-seconds", "soon"}, {"--limit-seconds", "soon"});
  expect_bad_input({"scale", "--detector", "no-such"}, {"no-such"});
  expect_bad_input({"scale", "--query", "all"}, {"--query", "all"});
}

}  // namespace
}  // namespace touchmark::bench::cli
