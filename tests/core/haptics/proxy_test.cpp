// The proxy's promises, each against the oracle's exact arithmetic or geometry that is known: it never comes
// as near as its radius, reaches what is free, rests, and pushes back as its coupling says.
#include "core/haptics/proxy.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bench/oracle/exact/constrained_optimum.h"
#include "bench/oracle/oracle.h"
#include "bench/oracle/triangle.h"
#include "bench/support/random.h"
#include "core/aabb_tree/aabb_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/grid_group/grid_group.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/bench/oracle/corner_case_meshes.h"
#include "tests/core/sphere_cluster/test_meshes.h"

namespace touchmark {
namespace {

using bench::support::Random;

static_assert(GuidesProxy<BruteForce> && GuidesProxy<AabbTree> && GuidesProxy<GridGroup> &&
              GuidesProxy<SphereCluster>);

/// A detector with a session, a proxy over it, and the oracle that watches every tick.
template <class D>
struct Watched {
  TriangleMesh mesh;
  bench::oracle::Oracle oracle;
  D detector;
  typename D::Session session;
  Proxy<D> proxy;

  Watched(TriangleMesh given, const Coupling& coupling)
      : mesh(std::move(given)), oracle(mesh, 1), detector(D::build(mesh)), proxy(detector, coupling, &mesh) {}
  Watched(const Watched&) = delete;
  Watched& operator=(const Watched&) = delete;

  /// One tick; every piece of its way must be free, and what it tells must agree with itself.
  const ProxyState& follow(const Vec3& goal, const std::string& where) {
    const double radius = proxy.coupling().radius;
    const ProxyState before = proxy.state();
    const ProxyState& state = proxy.step(goal, session);
    EXPECT_EQ(state.way[0], before.position) << where;
    EXPECT_EQ(state.way[state.pieces], state.position) << where;
    for (std::size_t i = 0; i < state.pieces; ++i) {
      EXPECT_NE(state.way[i], state.way[i + 1]) << where;
      EXPECT_FALSE(oracle.segment_within(state.way[i], state.way[i + 1], radius)) << where << ", piece " << i;
    }
    if (state.position == goal) {
      EXPECT_EQ(state.contacts, 0u) << where;
      EXPECT_EQ(state.force, Vec3::Zero()) << where;
      EXPECT_EQ(state.status, ProxyStatus::free) << where;
    } else if (state.unfinished) {
      EXPECT_GE(state.contacts, 1u) << where;
    } else {
      EXPECT_EQ(state.status, ProxyStatus::in_contact) << where;
      EXPECT_GE(state.contacts, 1u) << where;
      EXPECT_LE(state.contacts, 3u) << where;
      EXPECT_TRUE(oracle.segment_within(before.position, goal, radius)) << where << ": the goal was free";
      if (radius > 0) {
        const double beside_rounding =
            std::max(1e-3 * radius, 0x1p-32 * before.position.cwiseAbs().maxCoeff());
        const Vec3 on = state.position + beside_rounding * (goal - state.position).normalized();
        EXPECT_TRUE(oracle.segment_within(state.position, on, radius)) << where << ": it could go on";
      }
    }
    const double rounding = 1e-12 * ((before.position - goal).norm() + before.position.norm());
    EXPECT_LE((state.position - goal).norm(), (before.position - goal).norm() + rounding) << where;
    return state;
  }
};

/// A free position off the mesh.
Vec3 start_of(const TriangleMesh& mesh, double radius) {
  const Aabb box = mesh.bounds();
  return box.max + Vec3::Constant(2 * radius + 0.1 * box.diagonal());
}

/// Goals in and about the mesh: far ones, near ones, small steps, rests, and corners of its triangles.
template <class D>
void explore(const TriangleMesh& mesh, double radius, std::uint64_t seed, const std::string& name,
             Coupling coupling = {}, int ticks = 60, bool limits_work = false) {
  coupling.radius = radius;
  Watched<D> watched(mesh, coupling);
  Random random(seed);
  const double size = mesh.diagonal();
  const Vec3 middle = mesh.bounds().center();
  watched.proxy.place(start_of(mesh, radius));
  Vec3 goal = watched.proxy.state().position;
  for (int tick = 0; tick < ticks; ++tick) {
    if (limits_work) watched.proxy.limit_work(std::uint64_t{1} << random.below(14));
    switch (random.below(6)) {
      case 0:
        goal = middle + 0.7 * size * random.unit() * random.direction();
        break;
      case 1:
        goal = mesh.corner(random.below(mesh.size()), static_cast<int>(random.below(3)));
        break;
      case 2:
        goal = middle + 100 * size * random.direction();
        break;
      case 3:
        break;
      default:
        goal += 0.02 * size * random.direction();
    }
    watched.follow(goal, name + ", tick " + std::to_string(tick));
    if (testing::Test::HasFailure()) return;
  }
}

TEST(Proxy, NeverComesAsNearAsItsRadiusOnMeshesThatAreHard) {
  std::uint64_t seed = 1;
  for (const NamedMesh& named : corner_case_meshes()) {
    const double size = named.mesh.diagonal();
    if (!(size < 1e100)) continue;
    for (const double radius : {0.0, 0.02 * size, 0.5 * size}) {
      const std::string where = named.name + ", radius " + std::to_string(radius);
      explore<AabbTree>(named.mesh, radius, ++seed, where + ", aabb tree");
      explore<GridGroup>(named.mesh, radius, ++seed, where + ", grid group");
      explore<SphereCluster>(named.mesh, radius, ++seed, where + ", sphere cluster");
      if (HasFailure()) return;
    }
  }
}

/// Each tick within another limit of work, from one look up.
TEST(Proxy, NeverComesAsNearWithinALimitOfWork) {
  std::uint64_t seed = 500;
  for (const NamedMesh& named : corner_case_meshes()) {
    const double size = named.mesh.diagonal();
    if (!(size < 1e100)) continue;
    for (const double radius : {0.0, 0.02 * size, 0.5 * size}) {
      const std::string where = named.name + ", radius " + std::to_string(radius);
      explore<GridGroup>(named.mesh, radius, ++seed, where + ", grid group", {}, 60, true);
      explore<SphereCluster>(named.mesh, radius, ++seed, where + ", sphere cluster", {}, 60, true);
      if (HasFailure()) return;
    }
  }
}

/// What the limit leaves open is not known to be free, neither in that tick nor in the next.
TEST(Proxy, IsStuckWhereItsLimitLeavesThePlaceOpen) {
  const TriangleMesh ball = octasphere(40);
  const SphereCluster detector = SphereCluster::build(ball);
  SphereCluster::Session session;
  Proxy<SphereCluster> proxy(detector, {.radius = 0.05, .max_work = 1}, &ball);
  const Vec3 start(0, 0, 1.0499), goal(0, 0, 1.5);
  proxy.place(start);
  EXPECT_TRUE(proxy.step(goal, session).unfinished);
  EXPECT_EQ(proxy.state().status, ProxyStatus::stuck);
  EXPECT_EQ(proxy.state().position, start);
  proxy.limit_work(0);
  EXPECT_EQ(proxy.step({0, 0, 1}, session).status, ProxyStatus::stuck);
  EXPECT_EQ(proxy.step(goal, session).position, goal);
}

/// The largest bound is none, however much the session has looked at before.
TEST(Proxy, IsNotEndedByTheLargestLimit) {
  const TriangleMesh ball = octasphere(40);
  const SphereCluster detector = SphereCluster::build(ball);
  SphereCluster::Session session;
  Proxy<SphereCluster> proxy(detector, {.radius = 0.05, .max_work = LimitedWork::unlimited}, &ball);
  proxy.place({0, 0, 1.06});
  EXPECT_EQ(proxy.step({0, 0, 0.9}, session).status, ProxyStatus::in_contact);
  ASSERT_GT(session.work.spent(), 0U);
  EXPECT_FALSE(proxy.step({0.1, 0, 0.9}, session).unfinished);
  EXPECT_EQ(proxy.step({0, 0, 1.5}, session).position, Vec3(0, 0, 1.5));
}

/// A goal that stays is reached over some ticks, the same place as at once.
TEST(Proxy, GoesOnWhereItsLimitEndedATick) {
  const TriangleMesh ball = octasphere(40);
  const SphereCluster detector = SphereCluster::build(ball);
  SphereCluster::Session session, free_session;
  Proxy<SphereCluster> limited(detector, {.radius = 0.05, .max_work = 300}, &ball),
      free(detector, {.radius = 0.05}, &ball);
  Random random(2);
  limited.place({0, 0, 1.2});
  free.place({0, 0, 1.2});
  int unfinished = 0;
  Vec3 goal(0, 0, 1.2);
  for (int tick = 0; tick < 600; ++tick) {
    if (tick % 20 == 0)
      goal = (0.9 + 0.2 * random.unit()) * (goal.normalized() + 0.1 * random.direction()).normalized();
    const ProxyState& state = limited.step(goal, session);
    unfinished += state.unfinished ? 1 : 0;
    EXPECT_FALSE(state.unfinished && state.position == goal) << tick;
    free.step(goal, free_session);
    EXPECT_TRUE(tick % 20 < 19 || (state.position - free.state().position).norm() < 1e-6) << tick;
  }
  EXPECT_GT(unfinished, 0);
}

/// A tick's last slide can leave the ball off the edge's curve, with the straight way on to the goal free.
TEST(Proxy, GoesAroundAnEdgeAndEndsEveryTickOnTheSurface) {
  Watched<SphereCluster> watched(octasphere(1), {.radius = 0.4});
  watched.proxy.place({0, 0, 3});
  Random random(11);
  for (int tick = 0; tick < 200; ++tick) {
    const Vec3 goal = random.unit() * random.direction();
    watched.follow(goal, "tick " + std::to_string(tick));
  }
}

TEST(Proxy, NeverComesAsNearAtOtherScalesAndFarFromTheOrigin) {
  std::uint64_t seed = 100;
  const TriangleMesh ball = octasphere(5);
  for (const double scale : {1e-6, 1.0, 1e6}) {
    for (const double offset : {0.0, 1e3, 0x1p40}) {
      const TriangleMesh mesh = ball.transformed(scale, Vec3::Constant(offset));
      if (scale < 0x1p-40 * offset) continue;  // nothing would be left of its shape
      for (const double radius : {0.0, 0.05 * scale, 3 * scale})
        explore<SphereCluster>(mesh, radius, ++seed,
                               "scale " + std::to_string(scale) + ", offset " + std::to_string(offset));
      if (HasFailure()) return;
    }
  }
}

TEST(Proxy, WithFrictionAndDampingIsAsSafe) {
  for (const double friction : {0.2, 1.0, 5.0}) {
    const Coupling coupling{
        .stiffness = 500, .static_friction = friction, .dynamic_friction = 0.7 * friction, .damping = 3};
    explore<GridGroup>(octasphere(6), 0.04, 7, "friction", coupling, 300);
    explore<BruteForce>(octasphere(3), 0, 8, "friction, point", coupling, 150);
  }
}

/// A corner of three planes about the origin, its inside the positive octant, as parts of large triangles.
TriangleMesh octant(double size) {
  const double a = size, b = -0.2 * size;
  return {{{b, b, 0}, {a, b, 0}, {b, a, 0}, {b, 0, b}, {a, 0, b}, {b, 0, a}, {0, b, b}, {0, a, b}, {0, b, a}},
          {{0, 1, 2}, {3, 5, 4}, {6, 7, 8}}};
}

template <class D>
class ProxyOver : public testing::Test {};

using Detectors = testing::Types<BruteForce, AabbTree, GridGroup, SphereCluster>;
TYPED_TEST_SUITE(ProxyOver, Detectors);

TYPED_TEST(ProxyOver, IsAtTheOptimumOfACornerInTheSameTick) {
  for (const double radius : {0.0, 0.125}) {
    Watched<TypeParam> watched(octant(4), {.radius = radius});
    Random random(3);
    watched.proxy.place({0.7, 0.7, 0.7});
    for (int tick = 0; tick < 200; ++tick) {
      const Vec3 goal = Vec3(random.unit(), random.unit(), random.unit()) - Vec3::Constant(0.5);
      const ProxyState& state = watched.follow(goal, "tick " + std::to_string(tick));
      const Vec3 optimum = goal.cwiseMax(radius);
      EXPECT_LT((state.position - optimum).norm(), 1e-11) << "radius " << radius << ", tick " << tick;
      EXPECT_EQ(state.contacts, static_cast<std::size_t>((goal.array() < radius).count()));
      const Vec3 force = 1000 * (state.position - goal);
      EXPECT_EQ(state.force, state.contacts > 0 ? force : Vec3(Vec3::Zero()));
      for (std::size_t i = 0; i < state.contacts; ++i)
        EXPECT_NEAR(state.normals[i].maxCoeff(), 1, 1e-9) << "one of the three planes";
    }
  }
}

TYPED_TEST(ProxyOver, DoesNotGoWhereItWouldJustTouch) {
  // A closed contact: at a quarter above the plane a ball of a quarter touches, and so does a point on it.
  for (const double radius : {0.0, 0.25}) {
    Watched<TypeParam> watched(octant(4), {.radius = radius});
    watched.proxy.place({1, 1, 1});
    EXPECT_GT(watched.follow({1, 1, radius}, "onto the plane").position.z(), radius);
    EXPECT_GT(watched.follow({1.5, 1.25, radius}, "along the plane").position.z(), radius);
  }
}

/// A groove along y, its two sides `half_angle` off the vertical, as high as 1.
TriangleMesh groove(double half_angle) {
  const double side = std::tan(half_angle);
  return {{{0, -1, 0}, {0, 1, 0}, {-side, -1, 1}, {-side, 1, 1}, {side, -1, 1}, {side, 1, 1}},
          {{0, 2, 1}, {1, 2, 3}, {0, 1, 4}, {1, 5, 4}}};
}

TYPED_TEST(ProxyOver, IsAtTheOptimumOfAGrooveOfOneDegree) {
  constexpr double half_angle = 0.5 / 180 * 3.141592653589793;
  const TriangleMesh mesh = groove(half_angle);
  const std::vector<bench::oracle::Triangle> sides{bench::oracle::triangle_of(mesh, 0),
                                                   bench::oracle::triangle_of(mesh, 2)};
  // Off each plane by 2^-43 of the coordinates and as much again by rounding, so over the sine off the edge.
  const double bound = 8 * 0x1p-43 / std::sin(half_angle);
  for (const double radius : {0.0, 0.001}) {
    Watched<TypeParam> watched(mesh, {.radius = radius});
    Random random(50);
    const Vec3 start(0, 0, 0.75);
    const bench::oracle::ConvexFreeSpace space(sides, start, radius);
    watched.proxy.place(start);
    for (int tick = 0; tick < 150; ++tick) {
      // Below the edge, beyond either side, and between them.
      const Vec3 goal(0.02 * (random.unit() - 0.5), random.unit() - 0.5, 0.9 * random.unit() - 0.2);
      const ProxyState& state = watched.follow(goal, "tick " + std::to_string(tick));
      EXPECT_LT((state.position - space.nearest(goal).value()).norm(), bound)
          << "radius " << radius << ", tick " << tick;
    }
  }
}

TYPED_TEST(ProxyOver, GivesBackNoEnergyWhereFreeSpaceIsConvex) {
  // Each step is along an axis on a lattice that the radius belongs to, so that what holds the proxy changes
  // between two steps only. During one the force is linear, and the mean of its ends is exact.
  constexpr double step = 0x1p-5, stiffness = 1000;
  Watched<TypeParam> watched(octant(4), {.radius = 4 * step, .stiffness = stiffness});
  Random random(12);
  Vec3 goal(1, 1, 1), force = Vec3::Zero();
  watched.proxy.place(goal);
  double energy = 0, longest = 0;
  const auto go = [&](const Vec3& to) {
    const ProxyState& state = watched.follow(to, "around");
    energy += (state.force + force).dot(to - goal) / 2;
    longest += (to - goal).norm();
    force = state.force;
    goal = to;
  };
  const auto go_along = [&](int axis, double to) {
    while (goal[axis] != to) {
      Vec3 next = goal;
      next[axis] += to > goal[axis] ? step : -step;
      go(next);
    }
  };
  for (int corner = 0; corner < 12; ++corner)
    go_along(static_cast<int>(random.below(3)), step * (static_cast<double>(random.below(40)) - 16));
  for (int axis = 0; axis < 3; ++axis) go_along(axis, 1);
  ASSERT_EQ(force, Vec3::Zero()) << "the way is closed and ends free";
  // Each force is off by the stiffness times what the proxy stays off its planes.
  EXPECT_LT(std::abs(energy), stiffness * longest * 16 * 0x1p-43 * 4);
  EXPECT_GT(longest, 4) << "far enough for an energy to be seen";
}

TYPED_TEST(ProxyOver, ASweepBelievesNothingOfBeforeAnUpdate) {
  const TriangleMesh mesh = octasphere(6);
  TypeParam detector = TypeParam::build(mesh);
  typename TypeParam::Session session;
  std::array<Contact, 4> around;
  Vec3 at(0, 0, 1.25);
  // Slow enough for what is near to be worth listing.
  for (int tick = 0; tick < 8; ++tick) {
    const Vec3 to = at + Vec3(0x1p-10, 0, 0);
    EXPECT_FALSE(detector.first_hit({at, to, 0.05}, session)) << "a quarter above the top";
    EXPECT_EQ(detector.contacts({to, 0}, 0.05, session, around), 0u);
    EXPECT_GT(detector.contacts({to, 0}, 0.3, session, around), 0u);
    at = to;
  }
  detector.update(mesh.transformed(1, {0, 0, 0.25}));
  const std::optional<Impact> impact = detector.first_hit({at, at + Vec3(0x1p-10, 0, 0), 0.05}, session);
  ASSERT_TRUE(impact) << "the top is at its height now";
  EXPECT_EQ(impact->fraction, 0);
}

TYPED_TEST(ProxyOver, RestsBitForBitWithinTenTicksOfItsGoal) {
  const TriangleMesh mesh = octasphere(6);
  for (const double radius : {0.0, 0.3}) {
    Watched<TypeParam> watched(mesh, {.radius = radius});
    Random random(4);
    watched.proxy.place({2, 2, 2});
    for (int rest = 0; rest < 20; ++rest) {
      const Vec3 goal = 1.1 * random.unit() * random.direction();
      for (int tick = 0; tick < 10; ++tick) watched.follow(goal, "approach");
      const Vec3 at = watched.proxy.state().position;
      for (int tick = 0; tick < 5; ++tick) EXPECT_EQ(watched.follow(goal, "rest").position, at);
    }
  }
}

TYPED_TEST(ProxyOver, IsStuckWhereItWasPutTooNearAndLeavesWithoutAJump) {
  Watched<TypeParam> watched(octant(4), {.radius = 0.5});
  watched.proxy.place({1, 1, 0.25});
  EXPECT_EQ(watched.proxy.step({1, 1, -1}, watched.session).status, ProxyStatus::stuck);
  EXPECT_GT(watched.proxy.state().position.z(), 0) << "it comes no nearer";
  EXPECT_LT((watched.proxy.state().position - Vec3(1, 1, 0.25)).norm(), 0.07) << "an eighth of the radius";
  const ProxyState& state = watched.proxy.step({1, 1, 0.75}, watched.session);
  EXPECT_EQ(state.position, Vec3(1, 1, 0.75)) << "it leaves for a goal that is free";
  EXPECT_EQ(watched.proxy.step({1, 1, 0.75}, watched.session).status, ProxyStatus::free);
}

TYPED_TEST(ProxyOver, FollowsAnUpdateOfTheMesh) {
  Watched<TypeParam> watched(octant(4), {.radius = 0.25});
  watched.proxy.place({1, 1, 1});
  watched.follow({1, 1, 0}, "before");
  const TriangleMesh raised = octant(4).transformed(1, {0, 0, 0.125});
  watched.detector.update(raised);
  watched.proxy.surface_moved(&raised);
  const ProxyState stuck = watched.proxy.step({1, 1, 0}, watched.session);
  EXPECT_EQ(stuck.status, ProxyStatus::stuck) << "the surface was moved onto it";
  EXPECT_NEAR(stuck.position.z(), 0.25, 0.04);
  EXPECT_EQ(watched.proxy.step({1, 1, 0.5}, watched.session).position, Vec3(1, 1, 0.5));
  const ProxyState& again = watched.proxy.step({1, 1, 0}, watched.session);
  EXPECT_NEAR(again.position.z(), 0.375, 1e-11);
  EXPECT_GT(again.position.z(), 0.375);
}

TYPED_TEST(ProxyOver, StaysWhereAGoalIsNoNumber) {
  Watched<TypeParam> watched(octant(4), {.radius = 0.25});
  watched.proxy.place({1, 1, 1});
  watched.follow({1, 1, 0}, "before");
  const Vec3 at = watched.proxy.state().position;
  constexpr double nan = std::numeric_limits<double>::quiet_NaN();
  const ProxyState& state = watched.proxy.step({nan, 1, 0}, watched.session);
  EXPECT_EQ(state.status, ProxyStatus::unanswered);
  EXPECT_EQ(state.position, at);
  EXPECT_EQ(state.force, Vec3::Zero());
  EXPECT_EQ(watched.follow({1, 1, 0}, "after").position, at);
}

TEST(Proxy, SticksWithinItsFrictionConeAndSlidesBeyond) {
  Watched<SphereCluster> watched(octant(8),
                                 {.radius = 0.25, .static_friction = 0.5, .dynamic_friction = 0.25});
  watched.proxy.place({2, 2, 0.5});
  watched.follow({2, 2, -0.75}, "down");
  const Vec3 pressed = watched.proxy.state().position;
  EXPECT_NEAR(pressed.z(), 0.25, 1e-11);
  EXPECT_EQ(watched.follow({2.45, 2, -0.75}, "within the cone").position, pressed);
  const ProxyState& slid = watched.follow({3, 2, -0.75}, "beyond it");
  EXPECT_NEAR(slid.position.x(), 3 - 0.25, 1e-9) << "short of the goal by the dynamic coefficient times 1";
}

/// A ridge along y whose sides fall by half a unit a unit: the normal of its edge is straight up.
TriangleMesh ridge() {
  return {{{0, -8, 0}, {0, 8, 0}, {-8, -8, -4}, {-8, 8, -4}, {8, -8, -4}, {8, 8, -4}},
          {{0, 1, 2}, {1, 3, 2}, {0, 4, 1}, {1, 4, 5}}};
}

TEST(Proxy, ShadingTurnsTheForceAndNotTheWay) {
  const TriangleMesh mesh = ridge();
  const SphereCluster detector = SphereCluster::build(mesh);
  const ForceShading shading(mesh);
  SphereCluster::Session sessions[3];
  Proxy plain(detector, {.radius = 0.25}, &mesh);
  Proxy shaded(detector, {.radius = 0.25, .shading = 1}, &mesh, &shading);
  Proxy off(detector, {.radius = 0.25}, &mesh, &shading);
  for (Proxy<SphereCluster>* proxy : {&plain, &shaded, &off}) proxy->place({-4, 0, 2});
  struct Turns {
    double steepest = 0;
    Vec3 last = Vec3::Zero();
    void add(const Vec3& force) {
      const Vec3 direction = force.normalized();
      if (last != Vec3::Zero()) steepest = std::max(steepest, (direction - last).norm());
      last = direction;
    }
  } turns, turns_shaded;
  for (int tick = 0; tick <= 200; ++tick) {
    // A fifth above the ridge, so a little too near for the ball, over its edge and on.
    const double x = -3 + 0.03 * tick;
    const Vec3 goal(x, 0.1, -0.5 * std::abs(x) + 0.2);
    const ProxyState& as_it_is = plain.step(goal, sessions[0]);
    const ProxyState& turned = shaded.step(goal, sessions[1]);
    EXPECT_EQ(turned.position, as_it_is.position);
    EXPECT_EQ(off.step(goal, sessions[2]).force, as_it_is.force) << "a share of 0";
    EXPECT_NEAR(turned.force.norm(), as_it_is.force.norm(), 1e-2 * as_it_is.force.norm());
    turns.add(as_it_is.force);
    turns_shaded.add(turned.force);
  }
  EXPECT_GT(turns.steepest, 0.1) << "the normals of the sides are 53 degrees apart, for a seventh of a unit";
  EXPECT_LT(turns_shaded.steepest, 0.02) << "over all six units";
}

TEST(Proxy, ShadingLeavesAForceBetweenTwoFacesAsItIs) {
  const TriangleMesh mesh = octant(4);
  const ForceShading shading(mesh);
  const BruteForce detector = BruteForce::build(mesh);
  BruteForce::Session session;
  Proxy proxy(detector, {.radius = 0.25, .shading = 1}, &mesh, &shading);
  proxy.place({1, 1, 1});
  const ProxyState& state = proxy.step({0, 0, 1}, session);
  ASSERT_EQ(state.contacts, 2u);
  EXPECT_EQ(state.force, Vec3(1000 * (state.position - Vec3(0, 0, 1))));
}

TEST(Proxy, DampsTheGoalsMotionInContactAlone) {
  Watched<AabbTree> watched(octant(8), {.radius = 0.25, .damping = 2, .tick_s = 0.5});
  watched.proxy.place({2, 2, 3});
  EXPECT_EQ(watched.follow({2, 2, 2}, "free").force, Vec3::Zero());
  watched.follow({2, 2, 0}, "in contact");
  const ProxyState& state = watched.follow({2, 2, -0.25}, "deeper");
  EXPECT_NEAR(state.force.z(), 1000 * 0.5 + 2 / 0.5 * 0.25, 1e-6);
}

/// A detector that counts all contacts.
struct CountsAll {
  using Session = SphereCluster::Session;
  SphereCluster of;

  bool touches(const Probe& probe, Session& session) const noexcept { return of.touches(probe, session); }
  std::optional<Impact> first_hit(const Sweep& sweep, Session& session) const noexcept {
    return of.first_hit(sweep, session);
  }
  std::size_t contacts(const Probe& probe, double reach, Session& session,
                       std::span<Contact> into) const noexcept {
    return of.contacts(probe, reach, session, into);
  }
};

TEST(Proxy, GoesTheSameWayWhereAllContactsAreCounted) {
  static_assert(GuidesProxy<CountsAll>);
  Random random(12);
  // Far more facets of the ball are in sight than fit, nearly all as near.
  const TriangleMesh mesh = test::bumpy_sphere(24, 0, 1);
  const CountsAll counts{SphereCluster::build(mesh)};
  for (const double radius : {0.5, 0.9, 0.97}) {
    Proxy nearest(counts.of, {.radius = radius, .stiffness = 1}, &mesh);
    Proxy all(counts, {.radius = radius, .stiffness = 1}, &mesh);
    SphereCluster::Session session, other;
    nearest.place(Vec3::Zero());
    all.place(Vec3::Zero());
    Vec3 goal = Vec3::Zero();
    for (int tick = 0; tick < 400; ++tick) {
      goal += 0.05 * random.point();
      if (goal.norm() > 1) goal *= 0.9;
      const ProxyState &one = nearest.step(goal, session), &two = all.step(goal, other);
      ASSERT_EQ(one.position, two.position) << radius << ", tick " << tick;
      ASSERT_EQ(one.force, two.force) << radius << ", tick " << tick;
      ASSERT_EQ(one.contacts, two.contacts) << radius << ", tick " << tick;
    }
  }
}

TEST(WhatAProxyAsks, TheNearestContactsAreTheFirstOfAll) {
  Random random(13);
  const TriangleMesh mesh = test::bumpy_sphere(24, 0, 1);
  const auto detector = SphereCluster::build(mesh);
  SphereCluster::Session session, other;
  for (int i = 0; i < 300; ++i) {
    const Probe probe{0.6 * random.point(), 0};
    const double reach = random.between(0.1, 1.5);
    std::array<Contact, 16> nearest;
    std::vector<Contact> all(mesh.size());
    const std::size_t count = detector.nearest_contacts(probe, reach, session, nearest);
    ASSERT_EQ(count, std::min(nearest.size(), detector.contacts(probe, reach, other, all))) << i;
    for (std::size_t k = 0; k < count; ++k) ASSERT_EQ(nearest[k].triangle, all[k].triangle) << i << ", " << k;
  }
}

/// A ball that comes down on a plate far more slowly than it slides, and touches it just before the end.
TEST(WhatAProxyAsks, ATouchByAHairIsFoundAmongManyTriangles) {
  Random random(14);
  for (int i = 0; i < 60; ++i) {
    const Vec3 up = random.direction(), along = up.unitOrthogonal(), across = up.cross(along);
    const TriangleMesh flat = test::plate(24);
    std::vector<Vec3> vertices;
    for (const Vec3& vertex : flat.vertices())
      vertices.push_back(0.12 * (vertex.x() * along + vertex.y() * across));
    const TriangleMesh mesh(std::move(vertices), {flat.triangles().begin(), flat.triangles().end()});
    const auto ours = SphereCluster::build(mesh);
    const auto all = BruteForce::build(mesh);
    BruteForce::Session plain;
    SphereCluster::Session lists, fresh;
    for (int k = 0; k < 20; ++k) {
      const auto anywhere = [&] {
        return Vec3(random.between(-0.05, 0.05) * along + random.between(-0.05, 0.05) * across);
      };
      const double radius = random.between(0.1, 0.3), hair = radius * std::ldexp(1, -40);
      const Sweep sweep{anywhere() + (radius + hair) * up, anywhere() + (radius - hair) * up, radius};
      std::array<Contact, 16> around;
      for (int twice = 0; twice < 2; ++twice) ours.contacts({sweep.from, 0}, 1.001 * radius, lists, around);
      const std::optional<Impact> hit = all.first_hit(sweep, plain);
      ASSERT_TRUE(hit) << i << ", " << k;
      for (SphereCluster::Session* session : {&lists, &fresh}) {
        const std::optional<Impact> found = ours.first_hit(sweep, *session);
        ASSERT_TRUE(found) << i << ", " << k;
        ASSERT_EQ(found->fraction, hit->fraction) << i << ", " << k;
        ASSERT_EQ(found->contact.triangle, hit->contact.triangle) << i << ", " << k;
      }
    }
  }
}

TEST(Proxy, IsTheSameForTheSameGoals) {
  std::vector<Vec3> ways[2];
  for (std::vector<Vec3>& way : ways) {
    Watched<GridGroup> watched(octasphere(6), {.radius = 0.05});
    Random random(9);
    watched.proxy.place({2, 2, 2});
    for (int tick = 0; tick < 100; ++tick)
      way.push_back(watched.follow(1.2 * random.unit() * random.direction(), "").position);
  }
  EXPECT_EQ(ways[0], ways[1]);
}

}  // namespace
}  // namespace touchmark
