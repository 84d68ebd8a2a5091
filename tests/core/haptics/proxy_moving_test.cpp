// A proxy that bodies push within a tick. Both motions are replayed by samples: the ball's as the state tells
// it, the bodies' along their screws.
#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/support/random.h"
#include "core/haptics/proxy.h"
#include "core/scene/round/primitives.h"
#include "core/scene/scene.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/core/scene/moving_oracle.h"
#include "tests/core/scene/random_pose.h"
#include "tests/core/scene/square_bodies.h"

namespace touchmark {
namespace {

using test::at, test::Mover, test::Point, test::Random, test::Real, test::Screw;
using Bodies = Scene<SphereCluster>;
static_assert(SeesMotion<Bodies> && !SeesMotion<SphereCluster>);

/// A scene whose bodies each go along a screw in a tick, and a proxy among them.
class World {
 public:
  explicit World(double radius) : proxy_(scene_, {.radius = radius}) {}
  World(const World&) = delete;
  World& operator=(const World&) = delete;

  void add(const TriangleMesh& mesh, const Pose& pose) {
    movers_.push_back({{mesh}, pose, {}});
    ids_.push_back(scene_.add(scene_.add_shape(Shape<SphereCluster>::build(mesh)), pose));
  }
  void place(const Vec3& at) { proxy_.place(at); }
  const ProxyState& state() const { return proxy_.state(); }
  const Pose& pose(std::size_t body) const { return movers_[body].before; }

  /// One tick, in which each body goes along its screw, and then the proxy to its goal. Returns how near its
  /// centre came to a body meanwhile.
  Real tick(const std::vector<Screw>& screws, const Vec3& goal) {
    std::vector<MovingBody> moving;
    std::vector<std::size_t> body_of;
    for (std::size_t i = 0; i < movers_.size(); ++i) {
      movers_[i].screw = screws[i];
      if (screws[i].angle == 0 && screws[i].travel == 0) continue;
      const Pose after = screws[i].after(movers_[i].before);
      moving.emplace_back(ids_[i], movers_[i].before, after);
      body_of.push_back(i);
      scene_.move(ids_[i], after);
    }
    proxy_.bodies_moved(moving);
    const ProxyState& state = proxy_.step(goal, session_);
    Real least = std::numeric_limits<Real>::infinity();
    const auto look = [&](const Point& at, Real time) {
      for (const Mover& mover : movers_) least = std::min(least, mover.distance(at, time));
    };
    constexpr int samples = 40;
    // It rests until it is carried.
    const Real until = state.carried > 0 ? static_cast<Real>(state.carries[0].begin) : 1;
    for (int k = 0; k <= samples; ++k) look(state.way[0].cast<Real>(), until * k / samples);
    for (std::size_t i = 0; i < state.carried; ++i) {
      const ProxyState::Carry& carry = state.carries[i];
      const Real begin = static_cast<Real>(carry.begin), end = static_cast<Real>(carry.end);
      const Screw& screw = movers_[body_of[carry.body]].screw;
      const Point start = state.way[i].cast<Real>(), at_rest = screw.undone(start, begin);
      for (int k = 0; k <= samples; ++k) {
        const Real time = begin + (end - begin) * k / samples;
        look(screw(at_rest, time), time);
      }
      EXPECT_NEAR(static_cast<double>((screw(at_rest, end) - state.way[i + 1].cast<Real>()).norm()), 0,
                  1e-12);
      EXPECT_EQ(carry.end, i + 1 < state.carried ? state.carries[i + 1].begin : 1);
    }
    // The rest is among bodies that stand.
    for (std::size_t i = state.carried; i < state.pieces; ++i) {
      const Point from = state.way[i].cast<Real>(), way = state.way[i + 1].cast<Real>() - from;
      for (int k = 0; k <= samples; ++k) look(from + way * k / samples, 1);
    }
    for (Mover& mover : movers_) {
      mover.before = mover.screw.after(mover.before);
      mover.screw = {};
    }
    return least;
  }

 private:
  Bodies scene_;
  Bodies::Session session_;
  std::vector<Mover> movers_;
  std::vector<BodyId> ids_;
  Proxy<Bodies> proxy_;
};

Screw shift(double x, double y, double z) {
  const Vec3 by(x, y, z);
  if (by.norm() == 0) return {};
  return {by.cast<Real>().normalized(), Point::Zero(), 0, by.cast<Real>().norm()};
}
Screw turn(double angle) { return {Point::UnitZ(), Point::Zero(), static_cast<Real>(angle), 0}; }

TEST(MovedProxy, IsPushedByAPistonThatGoesThroughItInOneTick) {
  for (const double radius : {0.0, 0.1}) {
    World world(radius);
    world.add(box_mesh({4, 4, 0.1}), at(0, 0, -5));
    const Vec3 goal(0.3, 0.2, 0);
    world.place(goal);
    EXPECT_GE(world.tick({shift(0, 0, 8)}, goal), 0.999 * radius);
    EXPECT_NEAR(world.state().position.z(), 3.05 + radius, 1e-9);
    EXPECT_EQ(world.state().status, ProxyStatus::in_contact);
    EXPECT_EQ(world.state().carried, 1u);
    // It follows the piston back to its goal.
    world.tick({shift(0, 0, -8)}, goal);
    EXPECT_EQ(world.state().position, goal);
  }
}

TEST(MovedProxy, StaysInFrontOfABladeThatTurnsRoundAndRound) {
  for (const double radius : {0.02, 0.1}) {
    for (const double angle : {0.2, 0.7, 1.9}) {
      World world(radius);
      world.add(box_mesh({6, 0.01, 2}), at(0, 0, 0));
      const Vec3 goal(0.4, 0.5, 0.1);
      world.place(goal);
      double turned = 0;
      int pushed = 0;
      for (int k = 0; k < 60; ++k) {
        ASSERT_GE(world.tick({turn(angle)}, goal), 0.87 * radius) << angle << " " << k;
        turned += angle;
        pushed += world.state().carried > 0 ? 1 : 0;
        // Both wings of the blade reach beyond: what is in front of one stays there.
        const Vec3& p = world.state().position;
        const Vec3 in_blade = Eigen::AngleAxisd(-turned, Vec3::UnitZ()) * p;
        EXPECT_GT(in_blade.y(), 0) << angle << " " << k;
      }
      EXPECT_GT(pushed, 20);
    }
  }
}

TEST(MovedProxy, StaysBetweenTheJawsOfAGripperThatClosesOnIt) {
  for (const double radius : {0.05, 0.2}) {
    World world(radius);
    world.add(box_mesh({2, 2, 0.1}), at(0, 0, -1));
    world.add(box_mesh({2, 2, 0.1}), at(0, 0, 1));
    const Vec3 goal(0.1, 0.2, 0.3);
    world.place(goal);
    // As wide as the ball at first, then a fifth of that, and open again.
    ASSERT_GE(world.tick({shift(0, 0, 0.95 - 1.05 * radius), shift(0, 0, -0.95 + 1.05 * radius)}, goal),
              0.999 * radius);
    EXPECT_NE(world.state().status, ProxyStatus::stuck);
    ASSERT_GT(world.tick({shift(0, 0, 0.85 * radius), shift(0, 0, -0.85 * radius)}, goal), 0.05 * radius);
    EXPECT_EQ(world.state().status, ProxyStatus::stuck);
    EXPECT_LT(std::abs(world.state().position.z()), 0.2 * radius);
    world.tick({shift(0, 0, -0.9), shift(0, 0, 0.9)}, goal);
    world.tick({shift(0, 0, 0), shift(0, 0, 0)}, goal);
    EXPECT_EQ(world.state().position, goal);
  }
}

TEST(MovedProxy, IsMetByBodiesThatPassItsPlaceInOneTick) {
  Random random(5);
  for (int k = 0; k < 300; ++k) {
    const double radius = 0.05;
    World world(radius);
    const Vec3 goal = random.point(0.2), way = 3 * random.direction();
    world.add(box_mesh({1, 0.6, 0.4}), test::random_pose(random, -way));
    world.place(goal);
    Screw screw = shift(2 * way.x(), 2 * way.y(), 2 * way.z());
    if (k % 2 == 0) screw.angle = static_cast<Real>(random.between(-1.5, 1.5));
    ASSERT_GE(world.tick({screw}, goal), 0.87 * radius) << k;
  }
}

// One moves at a time: where two close on it until nothing is left between them, no side is right.
TEST(MovedProxy, IsNeverOnTheOtherSideOfWhatMovesAtRandom) {
  Random random(11);
  int pushed = 0;
  for (int run = 0; run < 20; ++run) {
    const double radius = 0.04;
    World world(radius);
    world.add(box_mesh({6, 6, 0.2}), at(0, 0, -4));  // stands
    world.add(run % 2 == 0 ? box_mesh({1, 0.3, 0.3}) : box_mesh({0.05, 1, 1}), at(1.5, 0, 0));
    world.place({0, 0, 0});
    for (int k = 0; k < 40; ++k) {
      // Towards the middle, so that it meets the ball often.
      const Vec3 to = random.point(0.5) - world.pose(1).translation;
      Screw screw = shift(to.x(), to.y(), to.z());
      screw.through = world.pose(1).translation.cast<Real>();
      screw.angle = static_cast<Real>(random.between(-1, 1));
      ASSERT_GE(world.tick({{}, screw}, random.point(0.8)), 0.87 * radius) << run << " " << k;
      pushed += world.state().carried > 0 ? 1 : 0;
    }
  }
  EXPECT_GT(pushed, 80);
}

}  // namespace
}  // namespace touchmark
