/// The courses of the proxy suite and the published algorithms on them.
#include <algorithm>
#include <atomic>
#include <iterator>
#include <memory>
#include <set>
#include <string>
#include <thread>
#include <vector>

#include <gtest/gtest.h>
#include <sched.h>

#include "bench/contestants/built_in.h"
#include "bench/experiments/proxy/proxy_run.h"
#include "bench/support/system/own_time.h"

namespace touchmark::bench::experiments::proxy {
namespace {

constexpr std::size_t ticks = 600;

TEST(ProxyCourses, StartWhereTheBallIsFree) {
  for (const Family& family : families()) {
    for (std::uint64_t seed = 1; seed < 4; ++seed) {
      for (const Course& course : family.make(seed, ticks)) {
        const proxies::WayOracle oracle(course.mesh);
        EXPECT_FALSE(oracle.is_within(course.start, course.start, course.radius))
            << family.name << ": " << course.name;
        EXPECT_GE(course.goals.size(), 50U) << family.name << ": " << course.name;
      }
    }
  }
}

TEST(ProxyCourses, OfEverySeedHaveBallsAndBarePoints) {
  for (const Family& family : families()) {
    std::set<bool> kinds;
    for (const Course& course : family.make(1, ticks)) kinds.insert(course.radius > 0);
    EXPECT_EQ(kinds.size(), 2U) << family.name;
  }
}

TEST(ProxyCourses, AreTheSameForTheSameSeedAndOthersForAnother) {
  for (const Family& family : families()) {
    const std::vector<Course> one = family.make(5, ticks), again = family.make(5, ticks),
                              other = family.make(6, ticks);
    ASSERT_EQ(one.size(), again.size());
    bool differs = false;
    for (std::size_t i = 0; i < one.size(); ++i) {
      EXPECT_EQ(one[i].goals, again[i].goals) << family.name;
      differs = differs || one[i].goals != other[i].goals;
    }
    EXPECT_TRUE(differs) << family.name;
  }
}

TEST(ProxyCourses, KnowTheOptimumOfEveryTickWhereFreeSpaceIsConvex) {
  for (const char* name : {"thin-plates", "wedges-inside", "corners", "rooms"}) {
    for (const Course& course : family_named(name).make(2, ticks)) {
      const std::vector<Vec3> optima = optima_of(course);
      ASSERT_EQ(optima.size(), course.goals.size()) << name << ": " << course.name;
      const proxies::WayOracle oracle(course.mesh);
      for (const Vec3& optimum : optima)
        EXPECT_LE(oracle.shortfall(optimum, course.radius), 1e-15) << name << ": " << course.name;
    }
  }
}

/// No rounding is between a body that is moved and the mesh that the oracle sees.
TEST(ProxyCourses, AmongBodiesHaveTheMovedBodiesForTheirMesh) {
  std::vector<Course> courses = family_named("moving-bodies").make(3, ticks);
  std::ranges::move(family_named("passing-bodies").make(4, ticks), std::back_inserter(courses));
  for (const Course& course : courses) {
    for (const std::size_t change : {0, 1, 17}) {
      const TriangleMesh mesh = course.moved(change);
      const std::vector<Vec3> places = course.places(change);
      ASSERT_EQ(places.size(), course.bodies.size());
      std::size_t at = 0;
      for (std::size_t body = 0; body < places.size(); ++body)
        for (const auto& corners : course.bodies[body].triangles()) {
          for (std::size_t k = 0; k < 3; ++k)
            for (int axis = 0; axis < 3; ++axis)
              EXPECT_EQ(static_cast<long double>(mesh.corner(at, k)[axis]),
                        static_cast<long double>(course.bodies[body].vertices()[corners[k]][axis]) +
                            static_cast<long double>(places[body][axis]));
          ++at;
        }
      EXPECT_EQ(at, mesh.size());
    }
  }
}

/// Every score of one method over all families.
std::vector<Score> scores_of(const std::string& method, const std::string& detector = "sphere-cluster") {
  ProxyRequest request;
  for (const Family& family : families()) request.families.push_back(&family);
  request.methods.push_back(proxies::method_named(method));
  request.ticks = ticks * families().size();
  request.detector = detector;
  request.replays = 1;
  ProxyRun run(contestants::roster(), request);
  run.run([](const std::string&) {});
  return run.scores();
}

TEST(ProxyMethods, WithoutAProxyEveryFamilyIsCrossed) {
  for (const Score& score : scores_of("penalty")) {
    EXPECT_GT(score.tally.crossings, 0U) << score.family;
    EXPECT_EQ(score.tally.missed_goals, 0U) << score.family << ": the device is where its goal is";
    EXPECT_FALSE(score.broken()) << "it does not claim anything";
  }
}

TEST(ProxyMethods, RuspinisBallComesTooNearByRoundingOnlyAndNeverPops) {
  for (const Score& score : scores_of("virtual-proxy")) {
    if (score.point || score.family == "deforming" || score.family.ends_with("-bodies") ||
        score.family == "passing-sheets")
      continue;
    EXPECT_EQ(score.tally.pops, 0U) << score.family;
    EXPECT_LT(score.tally.max_shortfall, 1e-9) << score.family;
  }
}

TEST(ProxyMethods, TheGodObjectIsAtTheOptimumOfPlanes) {
  for (const Score& score : scores_of("god-object")) {
    if (score.family != "wedges-inside" && score.family != "corners") continue;
    EXPECT_LT(score.tally.max_optimum_error, 1e-9) << score.family;
  }
}

TEST(ProxyMethods, OverExactSweepsNothingIsCrossedWithAnyDetector) {
  for (const char* detector : {"brute-force", "aabb-tree", "grid-group", "sphere-cluster"}) {
    for (const Score& score : scores_of("certified", detector)) {
      EXPECT_TRUE(score.method.info->claims);
      EXPECT_FALSE(score.broken()) << detector << ", " << score.family << ": " << score.first_fault;
      EXPECT_EQ(score.tally.violations, 0U) << detector << ", " << score.family;
      EXPECT_LT(score.tally.max_optimum_error, 1e-10) << detector << ", " << score.family;
    }
  }
}

TEST(ProxyMethods, BodiesThatMoveHoldTheProxyAndAreMovedOntoIt) {
  for (const Score& score : scores_of("certified")) {
    if (score.family != "moving-bodies") continue;
    EXPECT_GT(score.tally.contact_ticks, 0U);
    if (!score.point) {
      EXPECT_GT(score.tally.stuck_ticks, 0U);
    }
    EXPECT_EQ(score.tally.missed_goals, 0U);
  }
}

/// All of it leaves room, so a detector that sees how the mesh moves finds a way out but in a few ticks.
TEST(ProxyMethods, SheetsThatPassPushTheProxyAheadAndCrossWhatDoesNotSeeThem) {
  for (const Score& score : scores_of("certified")) {
    if (score.family != "passing-sheets") continue;
    EXPECT_GT(score.tally.contact_ticks, score.tally.ticks / 4);
    EXPECT_LT(score.tally.stuck_ticks, score.tally.ticks / 20);
  }
  for (const Score& score : scores_of("virtual-proxy")) {
    if (score.family == "passing-sheets") {
      EXPECT_GT(score.tally.crossings, score.tally.ticks / 20);
    }
  }
}

TEST(ProxyMethods, OverFclsSamplesThinPlatesAreJumpedThrough) {
  std::uint64_t pops = 0;
  for (const Score& score : scores_of("fcl-ccd")) {
    if (!score.point && (score.family == "thin-plates" || score.family == "stabs")) pops += score.tally.pops;
  }
  EXPECT_GT(pops, 0U) << "ten poses along a sweep see nothing between them";
}

TEST(ProxyMethods, KeepAnEpsilonWhereTheyAreSaidTo) {
  for (const Score& score : scores_of("finger-proxy")) {
    if (score.point || score.family != "corners") continue;
    EXPECT_EQ(score.tally.violations, 0U);
  }
}

TEST(ProxyMethods, RefuseWhatIsNoMethodOrOption) {
  EXPECT_THROW(proxies::method_named("god-objects"), std::invalid_argument);
  EXPECT_THROW(proxies::method_named("penalty:epsilon=1"), std::invalid_argument);
  EXPECT_THROW(proxies::method_named("finger-proxy:epsilon=-1"), std::invalid_argument);
  EXPECT_EQ(proxies::method_named("finger-proxy:epsilon=1e-3").values.number("epsilon"), 1e-3);
}

/// Follows its goal anywhere. The first so many that are made lose their core in each step.
class Disturbed : public proxies::ProxyMethod {
 public:
  static inline int left = 0;

  void place(const Vec3& position) override { position_ = position; }
  void update(const TriangleMesh& mesh) override { static_cast<void>(mesh); }
  void step(const Vec3& goal, Step& step) override {
    step.begin(position_);
    step.go(position_ = goal);
    const long before = support::preemptions_so_far();
    while (is_disturbed_ && support::preemptions_so_far() == before) {
    }
  }
  std::uint64_t work() const override { return 1; }

 private:
  Vec3 position_ = Vec3::Zero();
  const bool is_disturbed_ = left-- > 0;
};

TEST(ProxyRun, ATicksTimeIsTheLeastOfItsReplaysAndThatOfOneAlwaysPreemptedIsCounted) {
  cpu_set_t allowed, core;
  ASSERT_EQ(sched_getaffinity(0, sizeof allowed, &allowed), 0);
  CPU_ZERO(&core);
  CPU_SET(static_cast<unsigned>(sched_getcpu()), &core);
  ASSERT_EQ(sched_setaffinity(0, sizeof core, &core), 0);
  std::atomic<bool> ends{false};
  std::thread other([&] {  // on the same core
    while (!ends) {
    }
  });
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  const Course course{"straight", mesh, 0, 0, {0, 0, 1}, std::vector<Vec3>(5, {0, 0, 2})};
  const proxies::MethodInfo info{
      .name = "disturbed",
      .meaning = "",
      .options = {},
      .rests_on = "",
      .make = [](const proxies::MethodRequest&) {
        return std::unique_ptr<proxies::ProxyMethod>(std::make_unique<Disturbed>());
      }};
  const auto run = [&](int disturbed, std::uint64_t replays) {
    Disturbed::left = disturbed;
    Tally tally;
    run_course(contestants::roster(), course, {}, {&info, "", proxies::MethodOptions({})}, {}, "", tally,
               nullptr, replays);
    return tally;
  };
  const Tally always = run(3, 3), once = run(2, 3);
  ends = true;
  other.join();
  sched_setaffinity(0, sizeof allowed, &allowed);
  EXPECT_EQ(always.preempted, 5U);
  EXPECT_LT(once.preempted, 5U);
  EXPECT_LT(once.times.percentile(0.5), always.times.percentile(0.5) / 10);
  EXPECT_EQ(once.ticks, 5U);
  EXPECT_EQ(once.work, 1U);
}

}  // namespace
}  // namespace touchmark::bench::experiments::proxy
