#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <map>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/experiments/papers/decimation.h"
#include "bench/meshes/meshes.h"
#include "tests/bench/cli/csv_fields.h"
#include "tests/bench/cli/run_touchmark.h"

namespace touchmark::bench::cli {
namespace {

bool is_there(const TemporaryFolder& folder, const char* file) {
  return std::filesystem::exists(folder.file(file));
}

/// Runs one quickly on a mesh into the folder.
Outcome run_paper(const char* paper, const std::string& mesh, const TemporaryFolder& folder,
                  std::vector<std::string> more = {}) {
  std::vector<std::string> words{"paper", paper, "--quick", "--out", folder.file("")};
  if (!mesh.empty()) words.insert(words.end(), {"--mesh", mesh});
  words.insert(words.end(), more.begin(), more.end());
  return run_touchmark(words);
}

/// One quick run on a small sphere, for all tests that only read what it left.
class PaperChoiSung : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    outcome_ = run_paper("choi-sung-2017", "icosphere:1", *folder_);
    ASSERT_EQ(outcome_.status, 0) << outcome_.err;
  }
  static void TearDownTestSuite() { delete folder_; }

  static inline const TemporaryFolder* folder_ = nullptr;
  static inline Outcome outcome_;
  const TemporaryFolder& folder = *folder_;
  const Outcome& outcome = outcome_;
};

TEST_F(PaperChoiSung, LeavesTablesReportAndPictureData) {
  EXPECT_EQ(outcome.err, "");
  EXPECT_NE(outcome.out.find("not of the paper's mesh"), std::string::npos) << outcome.out;
  for (const char* file : {"distances.csv", "models.csv", "table1.csv", "table2.csv", "table3.csv",
                           "fast_forms.csv", "frontier.csv", "levels.csv", "numbers.csv", "report.md",
                           "pictures/original-0-mesh.csv", "pictures/ls3-3-clustered.csv"})
    EXPECT_TRUE(is_there(folder, file)) << file;
}

TEST_F(PaperChoiSung, HasARowForEverySurfaceWithoutAndWithClustering) {
  const std::vector<Row> rows = rows_of(folder.file("table1.csv"));
  ASSERT_EQ(rows.size(), 2u * (1 + 5 * 3));
  for (auto row : rows) {
    const bool clustered = row["clustering"] != "0";
    if (!clustered) {
      EXPECT_EQ(row["spheres"], row["triangles"]);
    }
    EXPECT_LE(std::stoi(row["spheres"]), std::stoi(row["triangles"]));
    EXPECT_GT(std::stod(row["detection_ms"]), 0);
    EXPECT_NEAR(std::stod(row["detection_ms"]) * std::stod(row["update_rate_hz"]), 1000, 0.1);
    EXPECT_EQ(row["grid_ms"].empty(), clustered);
  }
  EXPECT_EQ(rows_of(folder.file("table2.csv")).size(), 5u);
  EXPECT_EQ(rows_of(folder.file("table3.csv")).size(), 4u);
}

TEST_F(PaperChoiSung, KeepsTheSurfaceOfTheInterpolatingFlatMethods) {
  for (auto row : rows_of(folder.file("table1.csv"))) {
    if (row["method"] == "mid-point" || row["method"] == "catmull-clark-linear") {
      EXPECT_NEAR(std::stod(row["relative_volume"]), 1, 1e-6);
    }
    if (row["method"] == "loop") {
      EXPECT_LT(std::stod(row["relative_volume"]), 0.95);
    }
  }
}

TEST(PaperChoiSungBunny, MakesThePapersCountsOfThePapersBunny) {
  const std::filesystem::path bunny = std::filesystem::path(TOUCHMARK_SHARED_MODELS) / "bunny-902.ply";
  if (!std::filesystem::exists(bunny)) GTEST_SKIP() << bunny << " is not there";
  const TemporaryFolder folder;
  ASSERT_EQ(run_paper("choi-sung-2017", bunny.string(), folder, {"--steps", "5"}).status, 0);
  const std::map<std::string, std::vector<std::string>> expected{
      {"butterfly", {"3580", "13620", "41768"}},
      {"catmull-clark-linear", {"5412", "21648", "86592"}},
      {"mid-point", {"3580", "13590", "41120"}},
      {"loop", {"3580", "13600", "38444"}},
      {"ls3", {"3580", "13668", "40730"}}};
  std::size_t found = 0;
  for (auto row : rows_of(folder.file("table1.csv"))) {
    const int level = std::stoi(row["level"]);
    if (level == 0) {
      EXPECT_EQ(row["spheres"], row["clustering"] == "0" ? "902" : "728");
      continue;
    }
    EXPECT_EQ(row["triangles"], expected.at(row["method"])[static_cast<std::size_t>(level - 1)]);
    ++found;
  }
  EXPECT_EQ(found, 30u);
  // The paper's 1686, 2469, 2896: the order in which it visits triangles is unknown.
  const std::vector<Row> table3 = rows_of(folder.file("table3.csv"));
  const double printed[] = {728, 1686, 2469, 2896};
  for (std::size_t level = 0; level < 4; ++level)
    EXPECT_NEAR(std::stod(table3[level].at("clustered_spheres")), printed[level], 0.03 * printed[level]);
  // What does not move the surface keeps its concave edges, Butterfly adds to them.
  std::map<std::string, double> bending;
  for (auto row : rows_of(folder.file("table1.csv")))
    if (row["level"] == "0" || row["level"] == "3")
      bending[row["method"]] = std::stod(row["concave_bending"]);
  for (const char* method : {"mid-point", "catmull-clark-linear"})
    EXPECT_NEAR(bending[method] / bending["original"], 1, 1e-3) << method;
  EXPECT_GT(bending["butterfly"] / bending["original"], 1.5);
  for (const char* method : {"loop", "ls3"}) EXPECT_LT(bending[method], bending["original"]) << method;
}

TEST(PaperChoiSungBunny, DecimatesWhereThePapersBunnyIsMissingAndSaysSo) {
  if (!experiments::papers::can_decimate()) GTEST_SKIP() << "built without OpenMesh";
  const TemporaryFolder folder;
  ::setenv("TOUCHMARK_MODELS", "/no-such-folder", 1);
  const Outcome outcome = run_paper("choi-sung-2017", "", folder, {"--levels", "1", "--steps", "5"});
  ::unsetenv("TOUCHMARK_MODELS");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(content_of(folder.file("report.md")).find("in place of the paper's own"), std::string::npos);
  const int triangles = std::stoi(rows_of(folder.file("table1.csv"))[0].at("triangles"));
  EXPECT_NEAR(triangles, 902, 4);
}

TEST(PaperParkJang, TimesEveryFormOnTheSameSteps) {
  const TemporaryFolder folder;
  const Outcome outcome = run_paper("park-jang-2018", "icosphere:3", folder);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err, "");
  std::map<std::string, std::vector<Row>> forms;
  for (auto row : rows_of(folder.file("times.csv"))) forms[row["form"]].push_back(row);
  EXPECT_EQ(forms["ungrouped"].size(), 1u);
  EXPECT_EQ(forms["direct"].size(), 1u);
  EXPECT_EQ(std::stod(forms["ungrouped"][0]["tests_per_query"]), 1280);
  for (const char* shape : {"cube", "sphere", "centered-sphere"}) {
    ASSERT_GT(forms[shape].size(), 5u) << shape;
    for (std::size_t i = 1; i < forms[shape].size(); ++i)
      EXPECT_GT(std::stoi(forms[shape][i]["groups"]), std::stoi(forms[shape][i - 1]["groups"]));
    for (auto row : forms[shape]) {
      EXPECT_GE(std::stod(row["tests_per_query"]), std::stod(row["groups"]));
      EXPECT_EQ(row["contacts"], forms["ungrouped"][0]["contacts"]);
    }
  }
  for (const char* file :
       {"best.csv", "numbers.csv", "report.md", "pictures/cube-groups.csv", "pictures/sphere-active.csv"})
    EXPECT_TRUE(is_there(folder, file)) << file;
}

TEST(PaperParkJang, TestsFewerTrianglesAndMoreGroupsAsTheyShrink) {
  const TemporaryFolder folder;
  ASSERT_EQ(run_paper("park-jang-2018", "icosphere:4", folder).status, 0);
  std::vector<double> tests;
  for (auto row : rows_of(folder.file("times.csv")))
    if (row["form"] == "cube") tests.push_back(std::stod(row["tests_per_query"]));
  const auto least = std::min_element(tests.begin(), tests.end());
  EXPECT_LT(*least, tests.front() / 4);
  EXPECT_LT(*least, tests.back());
}

TEST(Papers, RefuseBadInputInOneLineAndWriteNothing) {
  const TemporaryFolder folder;
  const std::string out = folder.file("out");
  for (const std::string paper : {"choi-sung-2017", "park-jang-2018"}) {
    const auto with = [&](const std::string& option, const std::string& value) {
      expect_bad_input({"paper", paper, "--mesh", "icosphere:1", "--out", out, option, value},
                       {option, value});
    };
    for (const char* radius : {"-1", "inf", "nan", "x", "1%%"}) with("--radius", radius);
    for (const char* steps : {"0", "-1", "1.5", "1000001"}) with("--steps", steps);
    with("--seed", "-1");
    with("--no-such-option", "1");
    expect_bad_input({"paper", paper, "--mesh", "no-such-mesh", "--out", out}, {"no-such-mesh"});
    expect_bad_input({"paper", paper, "--mesh", "icosphere:1", "--quick", "--out", folder.file("file", "")},
                     {"--out", "file"});
  }
  for (const char* clustering : {"0", "-1", "inf", "x"})
    expect_bad_input(
        {"paper", "choi-sung-2017", "--mesh", "icosphere:1", "--out", out, "--clustering", clustering},
        {"--clustering", clustering});
  for (const char* groups : {"0", "x", "1000001"})
    expect_bad_input(
        {"paper", "park-jang-2018", "--mesh", "icosphere:1", "--out", out, "--most-groups", groups},
        {"--most-groups", groups});
  for (const char* levels : {"0", "6", "x"})
    expect_bad_input({"paper", "choi-sung-2017", "--mesh", "icosphere:1", "--out", out, "--levels", levels},
                     {"--levels", levels});
  expect_bad_input({"paper", "choi-sung-2018"}, {"subcommand"});
  expect_bad_input({"paper"}, {"subcommand"});
  EXPECT_FALSE(std::filesystem::exists(out));
}

TEST(Papers, ShowAnExample) {
  for (const std::string paper : {"choi-sung-2017", "park-jang-2018"}) {
    const Outcome outcome = run_touchmark({"paper", paper, "--help"});
    EXPECT_EQ(outcome.status, 0);
    EXPECT_NE(outcome.out.find("Example: touchmark paper " + paper), std::string::npos) << outcome.out;
  }
}

}  // namespace
}  // namespace touchmark::bench::cli
