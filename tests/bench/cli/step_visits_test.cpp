/// `touchmark query --visits` and visited.json, from the outside: on a flat sheet, where geometry says what
/// can be near.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <filesystem>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/bench/cli/run_touchmark.h"

namespace touchmark::bench::cli {
namespace {

using Json = nlohmann::json;

constexpr int cells = 32, steps = 150;  // cells along each edge of the sheet
constexpr double reach = 0.0625, rounding = 1e-5;
constexpr double upper = 0.1, lower = 0.03;  // above what a ball of that radius touches, and below

struct Point {
  double x, y, z;
};
/// Goes over the sheet at 0.4 of the reach, from one corner's cell to the opposite one's.
Point center_at(int step) {
  const double along = 0.1 + 0.8 * step / (steps - 1);
  return {along, 0.9 * along + 0.03, 0.4 * reach};
}

std::string sheet() {
  std::string obj;
  for (int i = 0; i <= cells; ++i)
    for (int k = 0; k <= cells; ++k) obj += fmt::format("v {} {} 0\n", i / double{cells}, k / double{cells});
  for (int i = 0; i < cells; ++i) {
    for (int k = 0; k < cells; ++k) {
      const int a = i * (cells + 1) + k + 1, b = a + cells + 1;
      obj += fmt::format("f {} {} {}\nf {} {} {}\n", a, b, b + 1, a, b + 1, a + 1);
    }
  }
  return obj;
}

std::string motion() {
  std::string csv = "x,y,z\n";
  for (int step = 0; step < steps; ++step) {
    const Point p = center_at(step);
    csv += fmt::format("{},{},{}\n", p.x, p.y, p.z);
  }
  return csv;
}

std::int64_t triangle_under(const Point& p) {
  const int i = static_cast<int>(p.x * cells), k = static_cast<int>(p.y * cells);
  const int beyond = p.y * cells - k > p.x * cells - i ? 1 : 0;  // beyond the diagonal of its cell
  return 2 * (i * cells + k) + beyond;
}

double squared_beyond(const Json& box, const Point& p) {
  const double at[3] = {p.x, p.y, p.z};
  double sum = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const double low = box[axis], high = box[axis + 3];
    const double excess = std::max({low - at[axis], at[axis] - high, 0.0});
    sum += excess * excess;
  }
  return sum;
}

double beyond_cylinder(const Json& rod, const Point& p) {
  const double v[3] = {p.x - rod[0].get<double>(), p.y - rod[1].get<double>(), p.z - rod[2].get<double>()};
  double along = 0, squared = 0;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    along += v[axis] * rod[axis + 3].get<double>();
    squared += v[axis] * v[axis];
  }
  const double across = std::sqrt(std::max(0.0, squared - along * along));
  return std::hypot(std::max(0.0, std::abs(along) - rod[7].get<double>()),
                    std::max(0.0, across - rod[6].get<double>()));
}

/// Returns what the program says that a detector looked at in every 15th step.
Json looked_at(const std::string& detector, std::vector<std::string> question) {
  question.insert(question.begin(), "query");
  question.insert(question.end(), {"--radius", fmt::format("{}", reach), "--detector", detector, "--visits",
                                   "135,0,15,30,45,60,75,90,105,121"});
  const Outcome outcome = run_touchmark(question);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return Json::parse(outcome.out);
}

Json row_of(const std::string& detector, const std::string& path, const Json& seen) {
  return {{"detector", detector}, {"options", ""}, {"trajectory", path}, {"steps", seen}};
}

/// One run for all tests.
class StepVisits : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    const TemporaryFolder folder;
    const std::string mesh = folder.file("sheet.obj", sheet()), path = folder.file("motion.csv", motion());
    const Outcome finished =
        run_touchmark({"bench", "--mesh", mesh, "--trajectory", path, "--quick", "--no-cold", "--detector",
                       "aabb-tree", "--detector", "grid-group", "--detector", "sphere-cluster", "--out",
                       folder.path(), "--benchmark_min_time=0.001"});
    ASSERT_EQ(finished.status, 0) << finished.err;
    results() = content_of(folder.file("results.csv"));
    const std::size_t run_id = results().find("\n1,") + 3;
    visited() = {{"schema", 1}, {"run_id", results().substr(run_id, results().find(',', run_id) - run_id)}};
    for (const char* const detector : {"aabb-tree", "grid-group", "sphere-cluster"})
      visited()["rows"].push_back(
          row_of(detector, path, looked_at(detector, {"--mesh", mesh, "--trajectory", path})));
  }
  static Json& visited() {
    static Json json;
    return json;
  }
  static std::string& results() {
    static std::string text;
    return text;
  }
  static Outcome validate(const Json& damaged) {
    const TemporaryFolder folder;
    folder.file("results.csv", results());
    return run_touchmark({"validate", folder.file("visited.json", damaged.dump())});
  }
  static const Json& row(const char* detector) {
    for (const Json& one : visited().at("rows"))
      if (one.at("detector") == detector) return one;
    ADD_FAILURE() << "no row of " << detector;
    return visited();
  }
};

TEST_F(StepVisits, HaveTheStepsThatWereAskedForInTheirOrder) {
  for (const Json& one : visited().at("rows")) {
    std::vector<int> numbers;
    for (const Json& step : one.at("steps")) numbers.push_back(step.at("step"));
    EXPECT_EQ(numbers, (std::vector<int>{0, 15, 30, 45, 60, 75, 90, 105, 121, 135}));
  }
}

TEST_F(StepVisits, AreRefusedOfARivalOfAStepThatThereIsNotAndOfAScene) {
  const auto refused = [](std::vector<std::string> words, const std::string& why) {
    words.insert(words.begin(), "query");
    const Outcome outcome = run_touchmark(words);
    EXPECT_EQ(outcome.status, 2);
    EXPECT_NE(outcome.err.find(why), std::string::npos) << outcome.err;
  };
  refused({"--mesh", "cube", "--detector", "field", "--visits", "1"}, "unknown detector \"field\"");
  refused({"--mesh", "cube", "--detector", "grid-group", "--steps", "5", "--visits", "1,5"},
          "--visits \"5\" is none of the 5 steps");
  refused({"--scene", "heap:3", "--detector", "sphere-cluster", "--steps", "5", "--visits", "1"},
          "does not go with --scene");
}

TEST_F(StepVisits, WithoutTheirProgramAreRefusedWithTheCommandThatBuildsIt) {
  const TemporaryFolder folder;
  const std::string alone = folder.path() + "/touchmark";
  std::filesystem::copy_file(TOUCHMARK_PROGRAM, alone);
  const Outcome outcome =
      run_program_at({alone, "query", "--mesh", "cube", "--detector", "grid-group", "--visits", "0"});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_EQ(outcome.err,
            "touchmark: touchmark-tracer is missing; scripts/build-program touchmark-tracer builds it\n");
}

TEST_F(StepVisits, AreWhatValidateExpects) {
  const Outcome outcome = validate(visited());
  EXPECT_EQ(outcome.status, 0) << outcome.out;
  EXPECT_NE(outcome.out.find("visited.json: fine (what 3 rows looked at)"), std::string::npos) << outcome.out;
}

TEST_F(StepVisits, ValidateFindsEachDamage) {
  const std::vector<std::pair<std::string, Json>> damages{
      {"/schema", 2},
      {"/run_id", "19990101T000000Z-0000"},
      {"/rows/0/detector", "another"},
      {"/rows/0/why_not", "in words, though it has steps"},
      {"/rows/0/steps/0/step", -1},
      {"/rows/0/steps/1/step", 0},
      {"/rows/0/steps/0/found", "yes"},
      {"/rows/0/steps/0/boxes/0/0", 99},
      {"/rows/0/steps/0/boxes/0/6", 2},
      {"/rows/0/steps/0/boxes/0", Json::array({1, 2, 3})},
      {"/rows/0/steps/0/triangles/0", 1.5},
      {"/rows/0/steps/0/left_out/boxes", 5},
      {"/rows/0/steps/0/cylinders", Json::array({Json::array({0, 0, 0, 0, 0, 2, 1, 1, 1})})},
      {"/rows/0/steps/0/groups", Json::array({Json::array({0, 0, 0, 1, 1, 1, 1, 0})})},
  };
  for (const auto& [pointer, value] : damages) {
    Json damaged = visited();
    damaged[Json::json_pointer(pointer)] = value;
    const Outcome outcome = validate(damaged);
    EXPECT_EQ(outcome.status, 1) << pointer << '\n' << outcome.out;
    EXPECT_NE(outcome.out.find("visited.json:1: /"), std::string::npos) << pointer << '\n' << outcome.out;
  }
}

TEST_F(StepVisits, WhatWasEnteredIsWithinReachAndWhatWasNotIsFartherThanTheSheet) {
  std::size_t entered = 0, turned_away = 0;
  for (const Json& one : visited().at("rows")) {
    for (const Json& step : one.at("steps")) {
      EXPECT_TRUE(step.at("found"));
      const Point p = center_at(step.at("step"));
      const auto check = [&](bool is_entered, double distance) {
        ++(is_entered ? entered : turned_away);
        // The other lists what is near for steps ahead, too.
        if (is_entered && one.at("detector") != "sphere-cluster") {
          EXPECT_LE(distance, reach * (1 + rounding));
        }
        if (!is_entered) {
          EXPECT_GE(distance, p.z * (1 - rounding));
        }
      };
      for (const Json& box : step.value("boxes", Json::array()))
        check(box[6] == 1, std::sqrt(squared_beyond(box, p)));
      for (const Json& rod : step.value("cylinders", Json::array()))
        check(rod[8] == 1, beyond_cylinder(rod, p));
    }
  }
  EXPECT_GT(entered, 20U);
  EXPECT_GT(turned_away, 20U);
}

TEST_F(StepVisits, ACellHoldsTheProbeAndAGroupThatCoversItLiesUnderIt) {
  std::size_t seen = 0;
  for (const Json& step : row("grid-group").at("steps")) {
    const Point p = center_at(step.at("step"));
    for (const Json& cell : step.value("cells", Json::array()))
      EXPECT_LE(squared_beyond(cell, p), rounding * rounding);
    for (const Json& group : step.value("groups", Json::array())) {
      ++seen;
      EXPECT_GE(group[7], 1);
      if (group[6] == 1) {
        EXPECT_LE(std::sqrt(squared_beyond(group, p)), p.z * (1 + rounding));
      }
    }
  }
  EXPECT_GT(seen, 0U);
}

TEST_F(StepVisits, TheTreeComparedTheTriangleUnderTheProbe) {
  for (const Json& step : row("aabb-tree").at("steps")) {
    const auto ids = step.at("triangles").get<std::set<std::int64_t>>();
    EXPECT_TRUE(ids.contains(triangle_under(center_at(step.at("step"))))) << step.at("step");
  }
}

/// Every second step of a sweep goes down through the sheet from where the ball is free, and comes to it over
/// the point that this returns.
Point stabbed(int step) {
  const double fraction = (upper - reach) / (upper - lower);
  const Point from = center_at(step - 1), to = center_at(step);
  return {from.x + fraction * (to.x - from.x), from.y + fraction * (to.y - from.y), 0};
}

TEST(SweepVisits, HoldTheTriangleThatIsHitAndNoBoxOverItIsLeftOut) {
  const TemporaryFolder folder;
  std::string csv = "x,y,z\n";
  for (int step = 0; step < steps; ++step)
    csv += fmt::format("{},{},{}\n", center_at(step).x, center_at(step).y, step % 2 == 0 ? upper : lower);
  const std::string mesh = folder.file("sheet.obj", sheet()), path = folder.file("stabs.csv", csv);
  std::size_t down = 0, boxes = 0;
  for (const char* const detector : {"aabb-tree", "grid-group", "sphere-cluster"}) {
    for (const Json& step : looked_at(detector, {"--mesh", mesh, "--trajectory", path, "--query", "sweep"})) {
      const int number = step.at("step");
      EXPECT_EQ(step.at("found"), number > 0);
      if (number % 2 == 0) continue;
      ++down;
      const Point hit = stabbed(number);
      const auto ids = step.at("triangles").get<std::set<std::int64_t>>();
      EXPECT_TRUE(ids.contains(triangle_under(hit))) << detector << ' ' << number;
      for (const Json& box : step.value("boxes", Json::array())) {
        ++boxes;
        if (box[6] == 0) {
          EXPECT_GT(squared_beyond(box, hit), 0) << detector << ' ' << number;
        }
      }
    }
  }
  EXPECT_GT(down, 5U);
  EXPECT_GT(boxes, 50U);
}

TEST_F(StepVisits, OfAnEarlierRunAreTakenAway) {
  const TemporaryFolder folder;
  folder.file("visited.json", "of an earlier run");
  const Outcome outcome = run_touchmark({"bench", "--mesh", "cube", "--quick", "--no-cold", "--steps", "5",
                                         "--trajectory", "slide", "--detector", "brute-force", "--out",
                                         folder.path(), "--benchmark_min_time=0.001"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_FALSE(std::filesystem::exists(folder.path() + "/visited.json"));
}

TEST(WithoutATemporaryFolder, NothingIsSaidOfWhatADetectorLookedAt) {
  const Outcome outcome = run_program_at({"/usr/bin/env", "TMPDIR=/proc", TOUCHMARK_PROGRAM, "query",
                                          "--mesh", "cube", "--detector", "aabb-tree", "--visits", "0"});
  EXPECT_EQ(outcome.status, 3) << outcome.out;
  EXPECT_NE(outcome.err.find("in /proc: "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("set TMPDIR"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.out, "");
}

}  // namespace
}  // namespace touchmark::bench::cli
