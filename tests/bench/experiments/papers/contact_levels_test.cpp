/// Contact levels of detail by a clock that counts what was looked at, so that every run is the same.
#include "bench/experiments/papers/choi_sung/contact_levels.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/experiments/papers/choi_sung/level_switch.h"
#include "bench/experiments/papers/paper_trace.h"
#include "bench/meshes/meshes.h"

namespace touchmark::bench::experiments::papers {
namespace {

/// Three levels of 100, 200 and 400 ns.
LevelSwitch three_levels(double period_ns) { return {{100, 200, 400}, period_ns}; }

/// Queries that take `times` what is expected of their level.
void run(LevelSwitch& levels, std::size_t queries, double times = 1) {
  constexpr double expected[] = {100, 200, 400};
  for (std::size_t i = 0; i < queries; ++i) levels.took(times * expected[levels.level()]);
}

TEST(LevelSwitch, StartsFastAndGoesToTheFinestLevelThatLeavesRoom) {
  LevelSwitch levels = three_levels(300);
  EXPECT_EQ(levels.level(), 0u);
  run(levels, LevelSwitch::calm - 1);
  EXPECT_EQ(levels.level(), 0u);  // not calm for long enough
  run(levels, 1);
  EXPECT_EQ(levels.level(), 1u);
  run(levels, 1000);
  EXPECT_EQ(levels.level(), 1u);  // 400 ns do not fit into 300
  LevelSwitch idle = three_levels(1e6);
  run(idle, 2 * LevelSwitch::calm);
  EXPECT_EQ(idle.level(), 2u);
}

TEST(LevelSwitch, TakesOneLongQueryForAnInterruptionAndTwoForALoad) {
  LevelSwitch levels = three_levels(1000);
  run(levels, 100);
  ASSERT_EQ(levels.level(), 2u);
  run(levels, 1, 1000);
  EXPECT_EQ(levels.level(), 2u);
  run(levels, LevelSwitch::recent);
  run(levels, 2, 3);              // 1,200 ns instead of 400
  EXPECT_EQ(levels.level(), 1u);  // where 600 ns are expected
}

TEST(LevelSwitch, SkipsLevelsThatWouldBeLateToo) {
  LevelSwitch levels = three_levels(1000);
  run(levels, 100);
  run(levels, 2, 8);  // 3,200, 1,600 or 800 ns
  EXPECT_EQ(levels.level(), 0u);
}

TEST(LevelSwitch, StaysWhereItIsBetweenTheTwoThresholds) {
  // The slower level would take nine tenths of the period: too little room to go there, enough to stay.
  LevelSwitch below({100, 900}, 1000);
  for (int i = 0; i < 1000; ++i) below.took(100);
  EXPECT_EQ(below.level(), 0u);
  LevelSwitch above({100, 700}, 1000);
  for (int i = 0; i < 100; ++i) above.took(100 + 600 * static_cast<double>(above.level()));
  ASSERT_EQ(above.level(), 1u);
  for (int i = 0; i < 1000; ++i) above.took(900);
  EXPECT_EQ(above.level(), 1u);
  EXPECT_EQ(above.switches(), 1u);
}

TEST(LevelSwitch, ComesBackWhenTheLoadIsGone) {
  LevelSwitch levels = three_levels(1000);
  run(levels, 100);
  run(levels, 50, 4);
  EXPECT_EQ(levels.level(), 1u);
  run(levels, 100);
  EXPECT_EQ(levels.level(), 2u);
  EXPECT_EQ(levels.switches(), 4u);  // up twice, down, up
}

/// Levels of a sphere, and a clock that goes on by as many nanoseconds as a whole scan of the level has
/// spheres, times a load.
class SimulatedLevels : public testing::Test {
 protected:
  SimulatedLevels() {
    for (std::size_t i = 0; i < levels.size(); ++i)
      expected.push_back(static_cast<double>(levels[i].detector.clusters().size()));
  }

  /// Asks every step; the clock goes on between its two readings.
  std::vector<std::size_t> levels_asked(ContactLevels::Session& session, std::size_t steps) {
    std::vector<std::size_t> asked;
    for (std::size_t i = 0; i < steps; ++i) {
      const workload::Step& step = trace[i % trace.size()];
      level = session.levels().level();
      asked.push_back(level);
      const std::optional<Contact> contact = levels.nearest(step.probe, step.reach, session);
      PublishedSphereCluster::Session alone;
      const std::optional<Contact> expected_contact =
          levels[level].detector.nearest(step.probe, step.reach, alone);
      EXPECT_EQ(contact.has_value(), expected_contact.has_value());
      if (!contact || !expected_contact) continue;
      EXPECT_EQ(contact->distance, expected_contact->distance);
    }
    return asked;
  }

  ContactLevels::Clock clock() {
    return [this] {
      reading = !reading;
      if (reading) return now;
      return now += load * expected[level];
    };
  }

  const TriangleMesh mesh = meshes::load_mesh("icosphere:1");
  ContactLevels levels = choi_sung_levels(mesh, {.levels = 2, .clustering = 0.05, .radius = 0.05});
  std::vector<workload::Step> trace = paper_trace("slide", mesh, 200, 1, 0.05);
  std::vector<double> expected;
  double now = 0, load = 1;
  std::size_t level = 0;
  bool reading = false;
};

TEST_F(SimulatedLevels, AreTheSpheresTheTrianglesAndThoseOfEachSubdivision) {
  ASSERT_EQ(levels.size(), 4u);
  EXPECT_EQ(levels[0].name, "spheres");
  EXPECT_EQ(levels[0].detector.accuracy().guarantee, Guarantee::conservative);
  EXPECT_EQ(levels[1].name, "triangles");
  EXPECT_EQ(levels[3].name, "ls3 2");
  EXPECT_GT(levels[3].detector.clusters().size(), levels[1].detector.clusters().size());
}

TEST_F(SimulatedLevels, AnswerAsTheLevelOfTheMomentDoesAndFollowTheLoad) {
  ContactLevels::Session session(levels, expected, 2 * expected.back(), clock());
  EXPECT_EQ(levels_asked(session, 200).back(), 3u);  // all the time it needs
  load = 1.9;
  EXPECT_EQ(levels_asked(session, 200).back(), 3u);
  load = 2.1;
  const std::vector<std::size_t> asked = levels_asked(session, 200);
  EXPECT_EQ(asked[1], 3u);
  EXPECT_EQ(asked[2], 2u);  // after two late queries
  EXPECT_EQ(asked.back(), 2u);
  load = 1;
  EXPECT_EQ(levels_asked(session, 200).back(), 3u);
}

TEST(ContactLevels, HaveARowForEveryLevelTreeAndWantedRate) {
  const TriangleMesh mesh = meshes::load_mesh("icosphere:1");
  const ContactLevelResult result = run_contact_levels(
      mesh, {.levels = 1, .clustering = 0.05, .radius = 0.05, .steps = 700, .rates = 3, .rounds = 2},
      [](const std::string&) {});
  ASSERT_TRUE(result.finished);
  ASSERT_EQ(result.rows.size(), 3u + 2u + 4u);
  const auto error = [&](std::size_t row) { return result.rows[row].mean_error; };
  // The exact forms answer alike, and a finer surface is nearer to the smooth one.
  EXPECT_EQ(error(1), error(3));
  EXPECT_EQ(error(2), error(4));
  EXPECT_LT(error(2), error(1));
  for (const ContactLevelRow& row : result.rows) {
    EXPECT_GT(row.rate_hz, 0);
    EXPECT_LE(row.mean_error, row.max_error);
    EXPECT_EQ(row.form == "switched", row.wanted_hz > 0);
  }
  EXPECT_EQ(contact_levels_table(result, mesh.diagonal()).size(), result.rows.size());
  EXPECT_NE(contact_levels_verdict(result, mesh.diagonal()).find("At 1 kHz"), std::string::npos);
}

}  // namespace
}  // namespace touchmark::bench::experiments::papers
