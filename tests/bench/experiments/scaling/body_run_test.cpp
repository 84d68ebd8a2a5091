// What is timed of scenes of bodies, by a scene whose queries take as long as they are told to.
#include "bench/experiments/scaling/body_run.h"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "bench/contestants/roster.h"
#include "bench/contestants/scene_player.h"

namespace touchmark::bench::experiments::scaling {
namespace {

using Steady = std::chrono::steady_clock;
constexpr double query_ns = 50'000;

/// Answers nothing, after as long as that takes by another clock than the run's.
class SlowScene {
 public:
  struct Session {
    Work work;
  };
  void place(std::uint32_t, const Pose&) noexcept {}
  std::optional<BodyContact> nearest_body(const Probe&, double, Session&) const noexcept {
    const auto start = Steady::now();
    while (std::chrono::duration<double, std::nano>(Steady::now() - start).count() < query_ns) {
    }
    return std::nullopt;
  }
  std::size_t bytes() const noexcept { return 0; }
  Accuracy accuracy() const noexcept { return {}; }
};

contestants::Roster slow_roster() {
  contestants::ContestantInfo info;
  info.name = "slow";
  info.queries = {workload::Query::nearest};
  info.scenes_only = true;
  info.build_scene = [](const scenes::PlacedScene& placed, const contestants::OptionValues&) {
    return contestants::scene_contestant(placed, [](const scenes::PlacedScene&) { return SlowScene(); });
  };
  info.build = [](const TriangleMesh&, const contestants::OptionValues&) {
    return std::unique_ptr<contestants::Contestant>();
  };
  return contestants::Roster({info});
}

TEST(BodyRun, TellsTicksInNanoseconds) {
  const contestants::Roster roster = slow_roster();
  BodyRun run(roster, {roster.parse("slow")}, 2);
  const std::vector<BodyRow> rows = run.run(2, "still", 60, [](const auto&) {});
  ASSERT_EQ(rows.size(), 2U);
  for (const BodyRow& row : rows) {
    ASSERT_EQ(row.status, "ok");
    // Medians: other work on the machine may make some ticks longer.
    for (const double ns : {row.first_tick_ns, row.tick_ns}) {
      EXPECT_GT(ns, 0.9 * query_ns);
      EXPECT_LT(ns, 1.5 * query_ns);
    }
  }
}

}  // namespace
}  // namespace touchmark::bench::experiments::scaling
