// The force between two ticks of a proxy, against the ticks' own and against planes that are known.
#include "core/haptics/force_planes.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bench/support/random.h"
#include "core/haptics/force_shading.h"
#include "core/haptics/proxy.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/bench/oracle/corner_case_meshes.h"

namespace touchmark {
namespace {

using bench::support::Random;

constexpr double radius = 0.25, stiffness = 800;

/// Three squares that bound the corner where x, y and z are above 0.
TriangleMesh corner() {
  return {{{0, 0, 0}, {9, 0, 0}, {0, 9, 0}, {0, 0, 9}, {9, 9, 0}, {9, 0, 9}, {0, 9, 9}},
          {{0, 1, 2}, {1, 4, 2}, {0, 1, 3}, {1, 5, 3}, {0, 2, 3}, {2, 6, 3}}};
}

class ForceNow : public testing::Test {
 protected:
  void follow(const Coupling& coupling, const std::vector<Vec3>& goals) {
    proxy_.emplace(detector_, coupling, &mesh_);
    proxy_->place(goals.front());
    for (const Vec3& goal : goals) proxy_->step(goal, session_);
  }
  Vec3 force(const Vec3& goal) const { return proxy_->force_now(goal); }

  TriangleMesh mesh_ = corner();
  SphereCluster detector_ = SphereCluster::build(mesh_);
  SphereCluster::Session session_;
  std::optional<Proxy<SphereCluster>> proxy_;
};

static_assert(noexcept(std::declval<const ForcePlanes&>().force(std::declval<const Vec3&>())));

TEST(ForcePlanes, AtATicksOwnGoalAreItsForceToTheBit) {
  const TriangleMesh mesh = octasphere(2);
  const SphereCluster detector = SphereCluster::build(mesh);
  const ForceShading shading(mesh);
  Random random(23);
  for (const Coupling& coupling :
       {Coupling{.radius = 0.3}, Coupling{.radius = 0},
        Coupling{.radius = 0.3, .static_friction = 0.5, .dynamic_friction = 0.3},
        Coupling{.radius = 0.3, .damping = 2}, Coupling{.radius = 0.3, .shading = 1}}) {
    SphereCluster::Session session;
    Proxy proxy(detector, coupling, &mesh, &shading);
    proxy.place({0, 0, 3});
    Vec3 goal(0, 0, 3);
    int held = 0;
    for (int tick = 0; tick < 500; ++tick) {
      goal = tick % 7 == 0 ? Vec3(1.5 * random.unit() * random.direction())
                           : Vec3(goal + 0.02 * random.direction());
      const ProxyState& state = proxy.step(goal, session);
      EXPECT_EQ(proxy.force_now(goal), state.force) << tick;
      held += state.contacts > 0 ? 1 : 0;
    }
    EXPECT_GT(held, 100);
  }
}

TEST_F(ForceNow, IsThatOfTheSpringToTheNearestPlaceOffThePlanesThatHold) {
  Random random(29);
  for (const Vec3& to : {Vec3(3, 3, -0.5), Vec3(3, -0.25, -0.5), Vec3(-0.125, -0.25, -0.5)}) {
    follow({.radius = radius, .stiffness = stiffness}, {{3, 3, 3}, to});
    for (int i = 0; i < 200; ++i) {
      const Vec3 goal = to + 0.5 * random.unit() * random.direction();
      const Vec3 off = goal.cwiseMax(radius);
      EXPECT_LT((force(goal) - stiffness * (off - goal)).norm(), 1e-8) << goal.transpose();
    }
  }
}

TEST_F(ForceNow, IsNoStifferThanTheSpring) {
  Random random(31);
  follow({.radius = radius, .stiffness = stiffness}, {{3, 3, 3}, {-0.125, -0.25, -0.5}});
  Vec3 before(-0.125, -0.25, -0.5);
  for (int i = 0; i < 2000; ++i) {
    const Vec3 goal = before + std::ldexp(1.0, -static_cast<int>(random.below(40))) * random.direction();
    EXPECT_LE((force(goal) - force(before)).norm(), stiffness * (goal - before).norm() * (1 + 1e-9) + 1e-9);
    if (i % 10 == 0) before = Vec3::Constant(radius) + random.direction();
  }
}

TEST_F(ForceNow, IsNothingOnceTheGoalHasLeftThePlanesWhateverThereWasBesides) {
  for (const Coupling& coupling :
       {Coupling{.radius = radius}, Coupling{.radius = radius, .static_friction = 0.5, .damping = 3}}) {
    follow(coupling, {{3, 3, 3}, {3, 3, -0.5}, {3.125, 3, -0.5}});
    EXPECT_GT(force({3.125, 3, -0.5}).z(), 100);
    EXPECT_EQ(force({3.5, 3, radius + 0.125}), Vec3::Zero());
    EXPECT_LT(force({3.5, 3, radius - 1e-9}).norm(), 1e-5) << "and goes there steadily";
  }
}

TEST_F(ForceNow, HoldsByFrictionUntilTheSpringLeavesItsCone) {
  follow({.radius = radius, .stiffness = stiffness, .static_friction = 0.5, .dynamic_friction = 0.25},
         {{3, 3, 3}, {3, 3, radius - 1}});
  const Vec3 within = force({3.25, 3, radius - 1}), beyond = force({3.75, 3, radius - 1});
  EXPECT_NEAR(within.x(), -0.25 * stiffness, 1e-8);
  EXPECT_NEAR(beyond.x(), -0.25 * stiffness, 1e-8) << "a quarter of the normal force, which is that of 1";
  EXPECT_NEAR(within.z(), stiffness, 1e-8);
  EXPECT_NEAR(beyond.z(), stiffness, 1e-8);
}

TEST_F(ForceNow, IsWhatTheNextTickComesToWhileTheSamePlanesHold) {
  Random random(37);
  for (const double friction : {0.0, 0.3}) {
    follow(
        {.radius = radius, .stiffness = stiffness, .static_friction = friction, .dynamic_friction = friction},
        {{4, 4, 3}, {4, 4, -0.5}});
    Vec3 goal(4, 4, -0.5);
    for (int tick = 0; tick < 200; ++tick) {
      goal = {std::clamp(goal.x() + 0.1 * (random.unit() - 0.5), 3.0, 5.0), 4, -0.5 - 0.2 * random.unit()};
      const Vec3 now = force(goal);
      EXPECT_LT((now - proxy_->step(goal, session_).force).norm(), 1e-8) << tick;
    }
  }
}

TEST_F(ForceNow, IsNothingInFreeSpaceAndWhereTheGoalIsNoNumber) {
  const double nan = std::nan("");
  follow({.radius = radius}, {{3, 3, 3}, {3, 3, 2}});
  EXPECT_EQ(force({3, 3, -1}), Vec3::Zero()) << "no plane is known before the next tick";
  follow({.radius = radius}, {{3, 3, 3}, {3, 3, -0.5}});
  EXPECT_EQ(force({3, nan, -0.5}), Vec3::Zero());
  proxy_->place({3, 3, 3});
  EXPECT_EQ(force({3, 3, -0.5}), Vec3::Zero());
  EXPECT_EQ(ForcePlanes().force({1, 2, 3}), Vec3::Zero());
}

}  // namespace
}  // namespace touchmark
