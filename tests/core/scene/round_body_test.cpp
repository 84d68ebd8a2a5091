// Spheres and capsules of a scene against rational arithmetic, and square roots of a thousand digits.
#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gmpxx.h>
#include <gtest/gtest.h>

#include "bench/support/random.h"
#include "core/float_limits.h"
#include "core/scene/scene.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/core/scene/exact_scene.h"

namespace touchmark {
namespace {

using bench::support::Random;

constexpr mp_bitcnt_t bits = 4096;

using RoundScene = Scene<SphereCluster>;
using Real = mpf_class;

struct Body {
  TriangleMesh mesh;
  double radius;  // 0: the mesh
  Pose pose;
};

Real real(const exact_scene::Number& x) {
  return Real(Real(x.get_num(), bits) / Real(x.get_den(), bits), bits);
}

/// The distance to the axis of one triangle of a body.
Real to_axis(const Body& body, std::size_t triangle, const exact_scene::Point& p) {
  const exact_scene::Body as_body{0, &body.mesh, body.pose};
  return sqrt(real(exact_scene::squared_distance(exact_scene::triangle_of(as_body, triangle), p)));
}

Real distance_to(const Body& body, const exact_scene::Point& p) {
  Real least(1e300, bits);
  for (std::size_t i = 0; i < body.mesh.size(); ++i) {
    const Real one = abs(Real(to_axis(body, i, p) - body.radius, bits));
    if (one < least) least = one;
  }
  return least;
}

/// The largest difference of coordinates to the body's axis, and its radius.
double size_of(const Body& body, const Vec3& point) {
  double largest = 0;
  for (const Vec3& v : body.mesh.vertices())
    largest = std::max(largest, (image(body.pose, v) - point).cwiseAbs().maxCoeff());
  return largest + body.radius;
}

TriangleMesh axis(const Vec3& from, const Vec3& to) { return {{from, to}, {{0, 1, 1}}}; }

struct World {
  std::vector<Body> bodies;
  RoundScene scene;
  std::vector<BodyId> ids;

  void add(Body body) {
    const Shape<SphereCluster> shape =
        body.radius > 0
            ? Shape<SphereCluster>::round(body.mesh.vertices()[0], body.mesh.vertices()[1], body.radius)
            : Shape<SphereCluster>::build(body.mesh);
    ids.push_back(scene.add(scene.add_shape(shape), body.pose));
    bodies.push_back(std::move(body));
  }
  void sphere(const Vec3& center, double radius, const Pose& pose = Pose()) {
    add({axis(center, center), radius, pose});
  }
};

void expect_contact(const World& world, const BodyContact& found, const Vec3& point, const Real& distance) {
  const Body& body = world.bodies[found.body.index];
  const double bound = 32 * unit_roundoff * size_of(body, point);
  const Contact& contact = found.contact;
  EXPECT_LE(std::abs(Real(contact.distance - distance, bits).get_d()), bound);
  EXPECT_NEAR(contact.normal.norm(), 1, 1e-14);
  const double rounding =
      8 * unit_roundoff * (point.cwiseAbs().maxCoeff() + contact.point.cwiseAbs().maxCoeff());
  EXPECT_LE(std::abs(distance_to(body, exact_scene::exactly(contact.point)).get_d()), bound + 8 * rounding);
  EXPECT_LE((point - contact.point - contact.distance * contact.normal).norm(), bound + 8 * rounding);
}

/// Asks everything about the point, with what is remembered and without.
void check(const World& world, const Vec3& point, RoundScene::Session& session) {
  const exact_scene::Point p = exact_scene::exactly(point);
  Real least(1e300, bits);
  std::uint32_t nearest = 0;
  for (std::uint32_t i = 0; i < world.bodies.size(); ++i) {
    const Real one = distance_to(world.bodies[i], p);
    if (!(one < least)) continue;
    least = one;
    nearest = i;
  }
  const auto found = world.scene.nearest_body({point, 0}, infinity, session);
  ASSERT_TRUE(found);
  EXPECT_EQ(found->body.index, nearest);
  expect_contact(world, *found, point, least);
  const double told = least.get_d();
  for (const double radius :
       {std::nextafter(told, 0.0), told, std::nextafter(told, infinity), 0.5 * told, 2 * told}) {
    RoundScene::Session fresh;
    const bool within = least <= radius;
    EXPECT_EQ(world.scene.touches({point, radius}, session), within);
    EXPECT_EQ(world.scene.touches({point, radius}, fresh), within);
    const auto again = world.scene.nearest_body({point, 0}, radius, fresh);
    ASSERT_EQ(again.has_value(), within);
    if (again) {
      EXPECT_EQ(again->contact.distance, found->contact.distance);
    }
    std::size_t count = 0;
    for (const Body& body : world.bodies)
      for (std::size_t i = 0; i < body.mesh.size(); ++i)
        count += abs(Real(to_axis(body, i, p) - body.radius, bits)) <= radius ? 1 : 0;
    EXPECT_EQ(world.scene.contacts({point, 0}, radius, session, {}), count);
  }
}

/// Spheres, capsules and a box, anywhere within a few of their sizes.
World world_of(std::uint64_t seed, double scale, const Vec3& offset) {
  Random random(seed);
  World world;
  const auto pose = [&] {
    const Vec3 at = offset + random.point(2 * scale);
    return pose_of(at, random.between(-1, 1), random.between(-1, 1), random.between(-1, 1), 0.1);
  };
  for (int i = 0; i < 3; ++i) world.sphere(random.point(scale), random.between(0.1, 2) * scale, pose());
  for (int i = 0; i < 3; ++i)
    world.add({axis(random.point(scale), random.point(scale)), random.between(0.1, 2) * scale, pose()});
  world.add({TriangleMesh({scale * Vec3(1, 0, 0), scale * Vec3(0, 1, 0), scale * Vec3(0, 0, 1), Vec3::Zero()},
                          {{0, 1, 2}, {0, 2, 3}, {0, 3, 1}, {1, 3, 2}}),
             0, pose()});
  return world;
}

/// Some points anywhere, some on axes and some all but on surfaces.
std::vector<Vec3> points_of(const World& world, Random& random, double scale, const Vec3& offset) {
  std::vector<Vec3> points;
  for (int i = 0; i < 12; ++i) points.push_back(offset + random.point(5 * scale));
  for (const Body& body : world.bodies) {
    const Vec3 on_axis = image(body.pose, body.mesh.corner(0, 0));
    points.push_back(on_axis);
    points.push_back(on_axis + random.point(1).normalized() * body.radius);
    points.push_back(on_axis + random.point(1e-12 * scale));
  }
  return points;
}

class AtScale : public ::testing::TestWithParam<std::pair<double, Vec3>> {};

TEST_P(AtScale, AnswersAsRationalArithmeticDoes) {
  const auto [scale, offset] = GetParam();
  for (std::uint64_t seed = 1; seed <= 3; ++seed) {
    const World world = world_of(seed, scale, offset);
    Random random(100 + seed);
    RoundScene::Session session;
    for (const Vec3& point : points_of(world, random, scale, offset)) {
      SCOPED_TRACE(::testing::Message() << "seed " << seed << " point " << point.transpose());
      check(world, point, session);
    }
  }
}

/// Does the probe touch the body's surface anywhere on the way up to the part?
bool touches_by(const Body& body, const Sweep& sweep, double part) {
  const exact_scene::Point p = exact_scene::exactly(sweep.from);
  const exact_scene::Point q = p + exact_scene::Number(part) * (exact_scene::exactly(sweep.to) - p);
  const exact_scene::Body as_body{0, &body.mesh, body.pose};
  for (std::size_t i = 0; i < body.mesh.size(); ++i) {
    const auto triangle = exact_scene::triangle_of(as_body, i);
    const Real least = sqrt(real(exact_scene::squared_distance(triangle, p, q)));
    const Real farthest = std::max(to_axis(body, i, p), to_axis(body, i, q));
    if (least <= Real(body.radius, bits) + sweep.radius && farthest >= Real(body.radius, bits) - sweep.radius)
      return true;
  }
  return false;
}

void check_way(const World& world, const Sweep& sweep, RoundScene::Session& session) {
  const auto touched = [&](double part) {
    return std::ranges::any_of(world.bodies, [&](const Body& body) { return touches_by(body, sweep, part); });
  };
  const auto found = world.scene.first_hit_body(sweep, session);
  ASSERT_EQ(found.has_value(), touched(1));
  if (!found) return;
  const double fraction = found->impact.fraction;
  ASSERT_EQ(fraction == 0, touched(0));
  if (fraction == 0) return;
  EXPECT_FALSE(fraction > std::numeric_limits<double>::denorm_min() &&
               touched(std::nextafter(fraction, 0.0)));
  const Body& body = world.bodies[found->body.index];
  const exact_scene::Point p = exact_scene::exactly(sweep.from);
  const exact_scene::Point there = p + exact_scene::Number(fraction) * (exact_scene::exactly(sweep.to) - p);
  const double size = size_of(body, sweep.from) + (sweep.to - sweep.from).cwiseAbs().maxCoeff();
  // E31: far from the origin the axis is seen to 98 bits.
  const double far = 4 * 0x1p-98 * sweep.from.cwiseAbs().maxCoeff();
  EXPECT_LE(Real(distance_to(body, there) - sweep.radius, bits).get_d(), 384 * unit_roundoff * size + far);
}

TEST_P(AtScale, HitsOnWaysFromOutsideAndFromWithin) {
  const auto [scale, offset] = GetParam();
  const World world = world_of(9, scale, offset);
  Random random(7);
  RoundScene::Session session;
  for (const Vec3& from : points_of(world, random, scale, offset)) {
    for (const double radius : {0.0, 0.01 * scale}) {
      check_way(world, {from, from + random.point(0.2 * scale), radius}, session);
      check_way(world, {from, offset + random.point(4 * scale), radius}, session);
      check_way(world, {from, from, radius}, session);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(RoundBody, AtScale,
                         ::testing::Values(std::pair(1.0, Vec3(0, 0, 0)),
                                           std::pair(1.0, Vec3(0x1p50, 0, -0x1p50)),
                                           std::pair(0x1p-90, Vec3(0, 0, 0)),
                                           std::pair(0x1p180, Vec3(0, 0, 0)),
                                           std::pair(0x1p-20, Vec3(3, 4, 5))));

std::optional<BodyContact> nearest(const World& world, const Vec3& point) {
  RoundScene::Session session;
  return world.scene.nearest_body({point, 0}, infinity, session);
}

// 2.5 from both, whose roots are whole numbers; and from within the one and without the other 3.
TEST(RoundBody, OfSeveralAsFarTheFirstIsNamed) {
  for (const bool swapped : {false, true}) {
    World world;
    const auto add = [&](int which) { which == 0 ? world.sphere({0, 0, 0}, 1) : world.sphere({8, 0, 0}, 2); };
    add(swapped ? 1 : 0);
    add(swapped ? 0 : 1);
    EXPECT_EQ(nearest(world, {3.5, 0, 0})->body.index, 0U);
    World within;
    const auto place = [&](int which) {
      which == 0 ? within.sphere({0, 0, 0}, 10) : within.sphere({12, 0, 0}, 2);
    };
    place(swapped ? 1 : 0);
    place(swapped ? 0 : 1);
    EXPECT_EQ(nearest(within, {7, 0, 0})->body.index, 0U);
    EXPECT_EQ(nearest(within, {7, 0, 0})->contact.distance, 3);
  }
}

// Mirrored, as far by a root that is no double; a hair to the side the hair decides, also one that no double
// of the distance shows.
TEST(RoundBody, ARootThatIsNoDoubleTiesAsWell) {
  World world;
  world.sphere({1, 1, 0}, 0.25);
  world.sphere({-1, 1, 0}, 0.25);
  EXPECT_EQ(nearest(world, {0, 0, 0})->body.index, 0U);
  EXPECT_EQ(nearest(world, {-0x1p-1000, 0, 0})->body.index, 1U);
  EXPECT_EQ(nearest(world, {0x1p-1000, 0, 0})->body.index, 0U);
  // A triangle and a sphere at exactly the same distance, the sphere first and last.
  for (const bool first : {true, false}) {
    World mixed;
    const Body plate{TriangleMesh({{-9, -9, 5}, {9, -9, 5}, {0, 9, 5}}, {{0, 1, 2}}), 0, Pose()};
    if (!first) mixed.add(plate);
    mixed.sphere({0, 0, -4}, 1);
    if (first) mixed.add(plate);
    EXPECT_EQ(nearest(mixed, {0, 0, 1})->body.index, 0U);
  }
}

// The sum of both radii is no double, and decides all the same.
TEST(RoundBody, ASumOfRadiiIsNotRounded) {
  World world;
  world.sphere({0, 0, 0}, 1);
  const double hair = 0x1p-60;
  RoundScene::Session session;
  // sqrt(1 + 2^-58) is between 1 + 2^-59 - 2^-119 and 1 + 2^-59.
  const Vec3 point(1, 0x1p-29, 0);
  EXPECT_TRUE(world.scene.touches({point, 2 * hair}, session));
  EXPECT_FALSE(world.scene.touches({point, std::nextafter(2 * hair, 0) - 0x1p-112}, session));
  // From within: 1 - 2^-60 away from the axis there is no double, but a hair off the sphere there is.
  const Vec3 inside(1 - 0x1p-53, 0, 0);
  EXPECT_TRUE(world.scene.touches({inside, 0x1p-53}, session));
  EXPECT_FALSE(world.scene.touches({inside, std::nextafter(0x1p-53, 0)}, session));
}

TEST(RoundBody, TheNormalPointsToTheCentreFromEitherSide) {
  World world;
  world.add({axis({0, 0, -1}, {0, 0, 1}), 2, Pose()});
  const auto outside = nearest(world, {5, 0, 0}), inside = nearest(world, {1, 0, 0.5});
  EXPECT_EQ(outside->contact.normal, Vec3(1, 0, 0));
  EXPECT_EQ(outside->contact.point, Vec3(2, 0, 0));
  EXPECT_EQ(inside->contact.normal, Vec3(-1, 0, 0));
  EXPECT_EQ(inside->contact.distance, 1);
  const auto on_axis = nearest(world, {0, 0, 0.25});
  EXPECT_EQ(on_axis->contact.distance, 2);
  EXPECT_EQ(on_axis->contact.normal.z(), 0) << "the nearest points of the tube lie across its axis";
}

// From the very centre, where a direction is no direction, the way out is as long as the radius.
TEST(RoundBody, AWayFromTheCentreEndsAtTheSurface) {
  World world;
  world.sphere({0, 0, 0}, 4);
  world.add({axis({100, 0, -1}, {100, 0, 1}), 4, Pose()});
  RoundScene::Session session;
  const auto hit = world.scene.first_hit_body({{0, 0, 0}, {8, 0, 0}, 0}, session);
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->impact.fraction, 0.5, 1e-13);
  EXPECT_LE(hit->impact.fraction, 0.5);
  EXPECT_EQ(hit->impact.contact.normal, Vec3(-1, 0, 0));
  check_way(world, {{0, 0, 0}, {0x1p-200, 8, 0}, 1}, session);
  check_way(world, {{100, 0, 0.5}, {100, 0, 6}, 0.5}, session);
  check_way(world, {{100, 0, 0}, {100, 1, 0}, 0.5}, session);
}

TEST(RoundBody, RefusesWhatIsNoRoundShape) {
  RoundScene scene;
  using Of = Shape<SphereCluster>;
  for (const double radius : {-1.0, infinity, std::nan(""), 0x1p-130, 0x1p201})
    EXPECT_THROW(scene.add_shape(Of::round({0, 0, 0}, {1, 0, 0}, radius)), SceneError) << radius;
  Of of_a_face = Of::build(TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}}, {{0, 1, 2}}));
  of_a_face.radius = 1;
  EXPECT_THROW(scene.add_shape(of_a_face), SceneError);
  EXPECT_THROW(Of::round({0, 0, std::nan("")}, {1, 0, 0}, 1), MeshError);
  EXPECT_EQ(scene.shapes_built(), 0U);
}

}  // namespace
}  // namespace touchmark
