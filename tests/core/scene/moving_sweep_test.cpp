// What moves within a tick, against dense samples of both motions in long double.
#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/support/random.h"
#include "core/brute_force/brute_force.h"
#include "core/scene/round/primitives.h"
#include "core/scene/scene.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/core/scene/moving_oracle.h"
#include "tests/core/scene/random_pose.h"

namespace touchmark {
namespace {

using test::Random, test::random_pose, test::Real, test::Point, test::Screw, test::Solid, test::Mover;
using Moving = std::vector<MovingBody>;

/// Bodies and a probe in a tick, as the scene answers and as samples have it.
class Tick {
 public:
  explicit Tick(const Sweep& sweep) : sweep_(sweep) {}

  void add(const Mover& mover) {
    movers_.push_back(mover);
    const BodyId id = scene_.add(scene_.add_shape(mover.solid.shape()), mover.before);
    if (mover.screw.angle != 0 || mover.screw.travel != 0)
      moving_.emplace_back(id, mover.before, mover.screw.after(mover.before));
  }
  std::optional<BodyImpact> answer() {
    Scene<SphereCluster>::Session session;
    return scene_.first_hit_moving(sweep_, moving_, session);
  }
  Real gap(Real time) const {
    const Point from = sweep_.from.cast<Real>(), way = sweep_.to.cast<Real>() - from;
    Real least = std::numeric_limits<Real>::infinity();
    for (const Mover& m : movers_) least = std::min(least, m.distance(from + time * way, time));
    return least - static_cast<Real>(sweep_.radius);
  }
  /// The least gap up to a time, by samples and by thirds about the least of them.
  Real least_gap(Real until) const {
    constexpr int samples = 200;
    Real least = gap(0), best = 0;
    for (int i = 1; i <= samples; ++i)
      if (const Real g = gap(until * i / samples); g < least) least = g, best = until * i / samples;
    Real low = std::max<Real>(best - until / samples, 0), high = std::min(best + until / samples, until);
    for (int i = 0; i < 40; ++i) {
      const Real a = low + (high - low) / 3, b = high - (high - low) / 3;
      if (gap(a) < gap(b))
        high = b;
      else
        low = a;
    }
    return std::min(least, gap(low));
  }
  /// The longest way of the probe in the frame of a body, by samples of its speed.
  Real relative_way() const {
    Real longest = 0;
    const Point from = sweep_.from.cast<Real>(), way = sweep_.to.cast<Real>() - from;
    for (const Mover& m : movers_) {
      for (const Real time : {Real(0), Real(1)}) {
        const Point place = from + time * way;
        longest = std::max(longest, (way - m.screw.angle * m.screw.axis.cross(place - m.screw.through) -
                                     m.screw.travel * m.screw.axis)
                                        .norm());
      }
    }
    return longest;
  }
  const Sweep& sweep() const { return sweep_; }

 private:
  Sweep sweep_;
  std::vector<Mover> movers_;
  Moving moving_;
  Scene<SphereCluster> scene_;
};

TriangleMesh tetrahedron(double size) {
  return {{{size, size, size}, {size, -size, -size}, {-size, size, -size}, {-size, -size, size}},
          {{0, 1, 2}, {0, 3, 1}, {0, 2, 3}, {1, 3, 2}}};
}

Screw random_screw(Random& random, double most) {
  return {random.direction().cast<Real>().normalized(), random.point().cast<Real>(),
          static_cast<Real>(random.between(-most, most)), static_cast<Real>(random.between(-2, 2))};
}

TEST(MovingSweep, IsNeverLateAndEarlyByItsBound) {
  Random random(33);
  int hits = 0, passed = 0;
  for (int round = 0; round < 2000; ++round) {
    const Vec3 from = random.point(), to = from + random.point(round % 3 == 0 ? 0.01 : 2);
    Tick tick({from, to, round % 4 == 0 ? 0 : random.between(0, 0.2)});
    const double turn = std::array{0.0, 0.01, 0.5, 1.99}[random.below(4)];
    const std::size_t bodies = 1 + random.below(3);
    for (std::size_t k = 0; k < bodies; ++k) {
      Solid solid{tetrahedron(random.between(0.2, 0.8))};
      if (random.below(4) == 0)
        solid = {TriangleMesh({random.point(0.5), random.point(0.5)}, {{0, 1, 1}}),
                 random.between(0.05, 0.3)};
      tick.add({solid, random_pose(random, random.point(1.2)), random_screw(random, turn)});
    }
    const std::optional<BodyImpact> answer = tick.answer();
    constexpr Real rounding = 1e-13L;
    const Real until = answer ? static_cast<Real>(answer->impact.fraction) : 1;
    if (until > 0) {
      ASSERT_GE(tick.least_gap(until), -rounding) << round;
    }
    if (!answer) continue;
    ++hits;
    const Real told = tick.gap(until);
    ASSERT_LE(told, 0x1p-19L * tick.relative_way() + rounding) << round;
    if (until > 0) {
      ++passed;
      const Contact& contact = answer->impact.contact;
      const Vec3 center = tick.sweep().from + answer->impact.fraction * (tick.sweep().to - tick.sweep().from);
      EXPECT_NEAR(contact.distance, static_cast<double>(told) + tick.sweep().radius, 1e-5) << round;
      EXPECT_NEAR((contact.point + contact.distance * contact.normal - center).norm(), 0, 1e-5) << round;
    }
  }
  EXPECT_GT(hits, 250);
  EXPECT_GT(passed, 150);
}

/// A rectangle in the plane y = 0 from the z-axis on.
TriangleMesh blade() {
  return TriangleMesh({{0, 0, -1}, {2, 0, -1}, {2, 0, 1}, {0, 0, 1}}, {{0, 1, 2}, {0, 2, 3}});
}

std::optional<BodyImpact> hit_of(const TriangleMesh& mesh, const Sweep& sweep,
                                 const std::vector<Pose>& before, const std::vector<Pose>& after,
                                 const TickPart& part = TickPart()) {
  Scene<BruteForce> scene;
  const ShapeId shape = scene.add_shape(Shape<BruteForce>::build(mesh));
  Moving moving;
  for (std::size_t i = 0; i < before.size(); ++i)
    moving.emplace_back(scene.add(shape, after[i]), before[i], after[i]);
  Scene<BruteForce>::Session session;
  return scene.first_hit_moving(sweep, moving, session, part);
}

Pose turned(double angle) {
  return {Eigen::AngleAxisd(angle, Vec3::UnitZ()).toRotationMatrix(), Vec3::Zero()};
}

TEST(MovingSweep, FindsWhereATurningBladeMeetsABallThatRests) {
  for (const double angle : {0.3, 0.8, 1.4}) {
    const double radius = 0.1, far = 1.5;
    const Vec3 center(far * std::cos(angle), far * std::sin(angle), 0.2);
    const auto hit = hit_of(blade(), {center, center, radius}, {turned(0)}, {turned(1.5)});
    ASSERT_TRUE(hit);
    const double expected = (angle - std::asin(radius / far)) / 1.5;
    EXPECT_LE(hit->impact.fraction, expected);
    EXPECT_NEAR(hit->impact.fraction, expected, 0x1p-18);
    const double then = 1.5 * expected;
    EXPECT_NEAR(hit->impact.contact.normal.dot(Vec3(-std::sin(then), std::cos(then), 0)), 1, 1e-9);
  }
}

TEST(MovingSweep, FindsAPistonThatGoesThroughAllOfTheBall) {
  const TriangleMesh face({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  const auto at = [](double z) { return Pose{Eigen::Matrix3d::Identity(), {0, 0, z}}; };
  // The ball comes down by 1, the piston up by 7: they close in by 8 where 3.75 is between them.
  const auto hit = hit_of(face, {{0, 0, 1}, {0, 0, 0}, 0.25}, {at(-3)}, {at(4)});
  ASSERT_TRUE(hit);
  EXPECT_LE(hit->impact.fraction, 3.75 / 8);
  EXPECT_NEAR(hit->impact.fraction, 3.75 / 8, 1e-12);
  // No hit is told for a part of the tick in which they do not meet.
  EXPECT_FALSE(hit_of(face, {{0, 0, 1}, {0, 0, 0.75}, 0.25}, {at(-3)}, {at(4)}, {0, 0.25}));
  const auto later = hit_of(face, {{0, 0, 1}, {0, 0, 0.5}, 0.25}, {at(-3)}, {at(4)}, {0.25, 0.75});
  ASSERT_TRUE(later);
  // From then on 2 are between them, and they close in by 4.
  EXPECT_NEAR(later->impact.fraction, 0.5, 1e-12);
}

TEST(MovingSweep, NamesTheJawOfAGripperThatComesFirst) {
  const TriangleMesh jaw = box_mesh({1, 1, 0.1});
  const auto at = [](double z) { return Pose{Eigen::Matrix3d::Identity(), {0, 0, z}}; };
  const auto hit = hit_of(jaw, {{0, 0, 0.2}, {0, 0, 0.2}, 0.1}, {at(-1), at(1)}, {at(-0.05), at(0.05)});
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->body.index, 1u);
  EXPECT_NEAR(hit->impact.fraction, (1 - 0.05 - 0.3) / 0.95, 1e-12);
  EXPECT_NEAR(hit->impact.contact.normal.z(), -1, 1e-14);
}

TEST(MovingSweep, SeesABodyThatIsFarBeforeTheTickAndFarAfterIt) {
  const TriangleMesh box = box_mesh({0.1, 0.1, 0.1});
  const auto at = [](double x) { return Pose{Eigen::Matrix3d::Identity(), {x, 0, 0}}; };
  Scene<SphereCluster> scene;
  const BodyId id = scene.add(scene.add_shape(Shape<SphereCluster>::build(box)), at(-100));
  Scene<SphereCluster>::Session session;
  EXPECT_FALSE(scene.nearest({Vec3::Zero(), 0.01}, 1, session));  // which the session remembers
  const Moving moving{MovingBody(id, at(-100), at(100))};
  const auto hit = scene.first_hit_moving({Vec3::Zero(), Vec3::Zero(), 0.01}, moving, session);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->impact.fraction, (100 - 0.06) / 200, 1e-12);
}

TEST(MovingSweep, AnswersOfStandingBodiesAsAlways) {
  Random random(7);
  Scene<SphereCluster> scene;
  const ShapeId shape = scene.add_shape(Shape<SphereCluster>::build(tetrahedron(0.3)));
  for (int i = 0; i < 20; ++i) scene.add(shape, random_pose(random, random.point(2)));
  Scene<SphereCluster>::Session one, other;
  int hits = 0;
  for (int i = 0; i < 500; ++i) {
    const Sweep sweep{random.point(2), random.point(2), 0.02};
    const auto expected = scene.first_hit_body(sweep, one), hit = scene.first_hit_moving(sweep, {}, other);
    ASSERT_EQ(expected.has_value(), hit.has_value());
    if (!hit || expected->impact.fraction == 0) continue;
    ++hits;
    EXPECT_EQ(hit->body, expected->body);
    EXPECT_EQ(hit->impact.fraction, expected->impact.fraction);
  }
  EXPECT_GT(hits, 100);
}

TEST(MovingSweep, EndsAtALimitOfWorkAsTouched) {
  const TriangleMesh mesh = tetrahedron(0.5);
  Scene<SphereCluster> scene;
  const BodyId id = scene.add(scene.add_shape(Shape<SphereCluster>::build(mesh)), Pose());
  const Moving moving{MovingBody(id, turned(0), turned(1))};
  Scene<SphereCluster>::Session session;
  session.work.limit = 1;
  const auto hit = scene.first_hit_moving({{0, 0, 0.1}, {0.1, 0, 0.1}, 0.1}, moving, session);
  ASSERT_TRUE(hit);
  EXPECT_EQ(hit->impact.fraction, 0);
  EXPECT_TRUE(session.work.undecided);
}

TEST(MovingSweep, RefusesATurnThatIsTooFarByName) {
  MovingBody({}, turned(0), turned(1.999));
  try {
    MovingBody({5, 0}, turned(0), turned(2.5));
    FAIL() << "was taken";
  } catch (const PoseError& error) {
    EXPECT_EQ(std::string(error.what()), "body 5 turns by 2.500000 in a tick, which is more than 2.000000");
  }
  EXPECT_THROW(MovingBody({}, turned(0), turned(std::numbers::pi)), PoseError);
  Pose scaled;
  scaled.rotation *= 1.01;
  EXPECT_THROW(MovingBody({}, Pose(), scaled), PoseError);
}

}  // namespace
}  // namespace touchmark
