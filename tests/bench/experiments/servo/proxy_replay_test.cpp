/// What is told of a paced proxy: the goals of its loop once more, judged by the oracle.
#include "bench/experiments/servo/proxy_replay.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bench/contestants/contestant_of.h"
#include "bench/contestants/guided_proxy.h"
#include "bench/contestants/own_scene.h"
#include "bench/meshes/meshes.h"
#include "bench/scenes/schedule.h"
#include "bench/workers/timing/run_servo.h"
#include "core/brute_force/brute_force.h"
#include "tests/bench/experiments/servo/simulated_clock.h"

namespace touchmark::bench::experiments::servo {
namespace {

constexpr double radius = 0.125;

/// Sees no surface.
class Blind {
 public:
  struct Options {};
  struct Session {
    Work work;
  };
  static Blind build(const TriangleMesh&, const Options&) { return {}; }
  static Blind build(const TriangleMesh&) { return {}; }
  bool touches(const Probe&, Session&) const noexcept { return false; }
  std::optional<Impact> first_hit(const Sweep&, Session&) const noexcept { return std::nullopt; }
  std::size_t contacts(const Probe&, double, Session&, std::span<Contact>) const noexcept { return 0; }
  std::size_t bytes() const noexcept { return 0; }
  Accuracy accuracy() const noexcept { return {}; }
};

/// From above a cube's top straight down through it in 40 steps.
class ProxyReplayTest : public testing::Test {
 protected:
  ProxyReplayTest() : workload_{"cube", meshes::load_mesh("cube", false), radius, {}, {"down"}, {{}}} {
    for (int i = 0; i <= 40; ++i) workload_.traces[0].push_back({{{0.1, 0.2, 2 - 0.1 * i}, radius}, radius});
  }

  template <class D>
  std::unique_ptr<contestants::Contestant> contestant() const {
    return std::make_unique<contestants::ContestantOf<D>>(D::build(workload_.mesh));
  }
  Vec3 start() const { return workload_.traces[0].front().probe.center; }
  static Coupling coupling() {
    Coupling coupling;
    coupling.radius = radius;
    return coupling;
  }
  template <class D>
  std::vector<workers::TickRecord> loop(SimulatedClock& clock, std::size_t ticks) const {
    contestants::GuidedProxy proxy(contestant<D>(), workload_.mesh, coupling());
    proxy.place(start());
    std::vector<workers::TickRecord> records(ticks);
    workers::PacedReplay pacer({}, workload_.traces[0].size(), clock, records);
    workers::step_paced(proxy, {workload::Query::nearest, workload_.traces[0]}, pacer);
    return records;
  }
  template <class D>
  ProxyReplay replay() const {
    return ProxyReplay(workload_, oracle_, contestant<D>(), coupling(), start());
  }

  workload::Workload workload_;
  std::shared_ptr<proxies::WayOracle> oracle_ = std::make_shared<proxies::WayOracle>(workload_.mesh);
};

TEST_F(ProxyReplayTest, ComesToTheSameThoughTicksWereLost) {
  SimulatedClock clock;
  clock.late_by[12] = 3'000'001;  // two ticks are lost, and their goals never seen
  const auto records = loop<BruteForce>(clock, 60);
  ProxyReplay replay = this->replay<BruteForce>();
  replay.place();
  EXPECT_TRUE(replay.follow(std::span(records).first(20)));
  EXPECT_TRUE(replay.follow(std::span(records).subspan(20)));
  EXPECT_EQ(replay.tally().ticks, 58u);
  EXPECT_EQ(replay.tally().crossings + replay.tally().violations, 0u);
  EXPECT_GT(replay.tally().contact_ticks, 30u) << "the cube's top is at a half; it goes down and back";
  EXPECT_GT(replay.work_max(), 0u);
}

TEST_F(ProxyReplayTest, FindsATickThatCameToSomethingElse) {
  SimulatedClock clock;
  auto records = loop<BruteForce>(clock, 30);
  const auto agrees = [&](const std::vector<workers::TickRecord>& ticks) {
    ProxyReplay replay = this->replay<BruteForce>();
    replay.place();
    return replay.follow(ticks);
  };
  EXPECT_TRUE(agrees(records));
  std::vector<workers::TickRecord> unseen = records;
  unseen.erase(unseen.begin() + 2);
  EXPECT_FALSE(agrees(unseen)) << "the loop had a goal more";
  records[7].checksum ^= 1;
  EXPECT_FALSE(agrees(records));
}

TEST_F(ProxyReplayTest, CountsTheCrossingsOfADetectorThatSeesNothing) {
  SimulatedClock clock;
  const auto records = loop<Blind>(clock, 41);
  ProxyReplay replay = this->replay<Blind>();
  replay.place();
  EXPECT_TRUE(replay.follow(records)) << "that is what the loop did";
  // Its way goes down through the top face at 0.5 and the bottom one at -0.5.
  EXPECT_GE(replay.tally().crossings, 2u);
  EXPECT_GT(replay.tally().violations, replay.tally().crossings);
}

/// The tip rests in the middle of a cube, which is out of its way from the 20th step on, and far under it at
/// first. The ball begins beside the cube.
class ProxyReplayAmongBodies : public ProxyReplayTest {
 protected:
  ProxyReplayAmongBodies() {
    auto scene = std::make_shared<scenes::BodyScene>();
    scene->shapes.push_back(std::make_shared<const TriangleMesh>(workload_.mesh));
    scene->bodies.push_back({"cube", 0, {}});
    placed_ = scenes::placed(*scene);
    workload_.scene = std::move(scene);
    scenes::BodyMotion motion{{0}, [](std::uint32_t, double time) {
                                scenes::Placement at;
                                at.position.x() = time < 20 ? 0 : 8;
                                return at;
                              }};
    std::vector<double> times;
    for (auto& step : workload_.traces[0]) {
      step.probe.center = Vec3::Zero();
      times.push_back(static_cast<double>(times.size()));
    }
    workload_.schedules.push_back(scenes::schedule_of(motion, times));
    schedule_ = workload_.schedules[0].view();
    oracle_ = std::make_shared<proxies::WayOracle>(placed_, schedule_);
  }
  std::unique_ptr<contestants::Contestant> among_bodies() const {
    return contestants::scene_contestant(placed_, [](const scenes::PlacedScene& placed) {
      return contestants::OwnScene<BruteForce>(
          placed, contestants::OptionValues({}),
          [](const TriangleMesh&, const contestants::OptionValues&) { return BruteForce::Options(); });
    });
  }
  std::vector<workers::TickRecord> loop(std::unique_ptr<contestants::Contestant> contestant) const {
    SimulatedClock clock;
    contestants::GuidedProxy proxy(std::move(contestant), std::nullopt, coupling());
    proxy.place(beside);
    std::vector<workers::TickRecord> records(
        60);  // to the end of the motion, and back until the cube returns
    workers::PacedReplay pacer({}, workload_.traces[0].size(), clock, records);
    workers::step_paced(proxy, {workload::Query::nearest, workload_.traces[0], &schedule_}, pacer);
    return records;
  }
  static inline const Vec3 beside{0, 0, 2};

  scenes::PlacedScene placed_;
  scenes::ScheduleView schedule_;
};

TEST_F(ProxyReplayAmongBodies, JudgesEveryTickByWhereTheBodiesAreThen) {
  const auto records = loop(among_bodies());
  ProxyReplay replay(workload_, oracle_, among_bodies(), coupling(), beside);
  replay.place();
  EXPECT_TRUE(replay.follow(records));
  EXPECT_EQ(replay.tally().ticks, 60u);
  EXPECT_EQ(replay.tally().contact_ticks, 20u) << "before the cube leaves; then the ball is at its goal";
  EXPECT_EQ(replay.tally().stopped_short + replay.tally().missed_goals, 0u);
  EXPECT_EQ(replay.tally().crossings + replay.tally().violations, 0u);
}

TEST_F(ProxyReplayAmongBodies, FindsThatADetectorDoesNotSeeWhereBodiesAre) {
  const auto unmoved = [&] { return contestant<Blind>(); };
  const auto records = loop(unmoved());
  ProxyReplay replay(workload_, oracle_, unmoved(), coupling(), beside);
  replay.place();
  EXPECT_TRUE(replay.follow(records));
  EXPECT_EQ(replay.tally().crossings, 1u)
      << "it goes through the cube's top at once, and rests in its middle";
}

}  // namespace
}  // namespace touchmark::bench::experiments::servo
