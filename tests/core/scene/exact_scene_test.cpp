#include "tests/core/scene/exact_scene.h"

#include <algorithm>
#include <cmath>
#include <memory>
#include <vector>

#include <gtest/gtest.h>

#include "core/aabb_tree/aabb_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "core/grid_group/grid_group.h"
#include "core/scene/scene.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/core/scene/random_pose.h"

namespace touchmark {
namespace {

using test::Random, test::random_pose;

TriangleMesh box(const Vec3& half, const Vec3& center = Vec3::Zero()) {
  std::vector<Vec3> v;
  for (int i = 0; i < 8; ++i)
    v.push_back(center +
                half.cwiseProduct(Vec3((i & 1) != 0 ? 1 : -1, (i & 2) != 0 ? 1 : -1, (i & 4) != 0 ? 1 : -1)));
  return TriangleMesh(v, {{0, 2, 1},
                          {1, 2, 3},
                          {4, 5, 6},
                          {5, 7, 6},
                          {0, 1, 4},
                          {1, 5, 4},
                          {2, 6, 3},
                          {3, 6, 7},
                          {0, 4, 2},
                          {2, 4, 6},
                          {1, 3, 5},
                          {3, 7, 5}});
}

/// An octahedron, whose ids say that each of four polygons was cut into two triangles.
TriangleMesh octahedron() {
  return TriangleMesh(
      {{1, 0, 0}, {0, 1, 0}, {-1, 0, 0}, {0, -1, 0}, {0, 0, 1}, {0, 0, -1}},
      {{0, 1, 4}, {1, 2, 4}, {2, 3, 4}, {3, 0, 4}, {1, 0, 5}, {2, 1, 5}, {3, 2, 5}, {0, 3, 5}},
      {3, 3, 4, 4, 8, 8, 9, 9});
}

/// Triangles of all sizes, some without area.
TriangleMesh soup(std::uint64_t seed) {
  Random random(seed);
  std::vector<Vec3> v;
  std::vector<TriangleMesh::Corners> t;
  for (std::uint32_t i = 0; i < 16; ++i) {
    const Vec3 a = random.point(1);
    const double size = std::pow(10.0, random.between(-6, 0));
    v.insert(v.end(), {a, a + random.point(size), i % 5 == 0 ? a : Vec3(a + random.point(size))});
    t.push_back({3 * i, 3 * i + 1, 3 * i + 2});
  }
  return TriangleMesh(v, t);
}

/// A scene beside its exact double.
template <class D>
struct Twin {
  Scene<D> scene;
  std::vector<std::shared_ptr<const TriangleMesh>> meshes;
  std::vector<ShapeId> shapes;
  std::vector<exact_scene::Body> bodies;  // by index
  std::vector<BodyId> ids;
  typename Scene<D>::Session session;
  std::uint64_t asked = 0;

  void shape(TriangleMesh mesh) {
    meshes.push_back(std::make_shared<const TriangleMesh>(std::move(mesh)));
    shapes.push_back(
        scene.add_shape({std::make_shared<const D>(D::build(*meshes.back(), {})), meshes.back()}));
  }
  void add(std::size_t which, const Pose& pose) {
    const BodyId id = scene.add(shapes[which], pose);
    const auto at = std::ranges::find_if(bodies, [&](const auto& body) { return body.index > id.index; });
    ids.insert(ids.begin() + (at - bodies.begin()), id);
    bodies.insert(at, {id.index, meshes[which].get(), pose});
  }
  void move(std::size_t i, const Pose& pose) {
    scene.move(ids[i], pose);
    bodies[i].pose = pose;
  }
  void remove(std::size_t i) {
    scene.remove(ids[i]);
    bodies.erase(bodies.begin() + static_cast<std::ptrdiff_t>(i));
    ids.erase(ids.begin() + static_cast<std::ptrdiff_t>(i));
  }

  /// Asks everything about the point, with what is remembered and without, and compares with what is exact.
  void check(const Vec3& point) {
    ++asked;
    const auto truth = exact_scene::nearest(bodies, point);
    const auto found = scene.nearest_body({point, 0}, infinity, session);
    ASSERT_EQ(found.has_value(), truth.has_value());
    if (!truth) return;
    EXPECT_EQ(found->body.index, truth->body);
    EXPECT_EQ(found->contact.triangle, truth->triangle);
    expect_contact(*found, *truth, point);
    const double distance = std::sqrt(truth->squared.get_d());
    for (double radius : {std::nextafter(distance, 0.0), distance, std::nextafter(distance, 1e300),
                          0.5 * distance, 2 * distance}) {
      const bool within = truth->squared <= exact_scene::Number(radius) * exact_scene::Number(radius);
      typename Scene<D>::Session fresh;
      EXPECT_EQ(scene.touches({point, radius}, session), within) << radius - distance;
      EXPECT_EQ(scene.touches({point, radius}, fresh), within);
      if (asked % 3 == 0) {
        EXPECT_EQ(scene.contacts({point, 0}, radius, session, {}),
                  exact_scene::count_within(bodies, point, radius));
      }
      const auto near = scene.nearest_body({point, 0}, radius, session);
      ASSERT_EQ(near.has_value(), within);
      if (near) {
        EXPECT_EQ(near->body, found->body);
        EXPECT_EQ(near->contact.distance, found->contact.distance);
        EXPECT_EQ(near->contact.point, found->contact.point);
      }
    }
    check_sweep(point, distance);
  }

  void expect_contact(const BodyContact& found, const exact_scene::Nearest& truth, const Vec3& point) {
    double largest = 0;
    const auto body = std::ranges::find_if(bodies, [&](const auto& b) { return b.index == truth.body; });
    for (std::size_t i = 0; i < body->mesh->size(); ++i) {
      if (body->mesh->id(i) != truth.triangle) continue;
      for (const exact_scene::Point& corner : exact_scene::triangle_of(*body, i)) {
        const exact_scene::Point way = corner - exact_scene::exactly(point);
        largest =
            std::max({largest, std::abs(way.x.get_d()), std::abs(way.y.get_d()), std::abs(way.z.get_d())});
      }
    }
    const exact_scene::Number reported(found.contact.distance), allowed(32 * unit_roundoff * largest);
    const exact_scene::Number low =
        reported > allowed ? exact_scene::Number(reported - allowed) : exact_scene::Number(0);
    const exact_scene::Number high = reported + allowed;
    EXPECT_LE(low * low, truth.squared);
    EXPECT_GE(high * high, truth.squared);
    EXPECT_NEAR(found.contact.normal.norm(), 1, 1e-14);
  }

  void check_sweep(const Vec3& point, double distance) {
    Random random(asked);
    const Vec3 to = point + random.point(1.5 * distance + 1e-3);
    const double radius = random.below(3) == 0 ? 0 : random.between(0, 1.1) * distance;
    const Sweep sweep{point, to, radius};
    const exact_scene::Number exact_radius(radius);
    const bool within = exact_scene::comes_within(bodies, point, to, 1, exact_radius);
    const auto hit = scene.first_hit_body(sweep, session);
    ASSERT_EQ(hit.has_value(), within);
    if (!hit) return;
    const double fraction = hit->impact.fraction;
    EXPECT_EQ(fraction == 0, exact_scene::comes_within(bodies, point, to, 0, exact_radius));
    if (fraction == 0) return;
    // Never late, since nothing touches before there; and hardly early, since something nearly touches there.
    // What the rotations stretch is told by the bound, too.
    double rigid = 0;
    for (const exact_scene::Body& body : bodies) rigid = std::max(rigid, rigid_error(body.pose.rotation));
    const double slack = (1e-13 + 8 * rigid) * (largest_number(point, to) + radius);
    EXPECT_FALSE(exact_scene::comes_within(bodies, point, to, std::nextafter(fraction, 0.0), exact_radius));
    EXPECT_TRUE(exact_scene::comes_within(bodies, point, to, fraction, exact_radius + slack));
  }

  /// Of all bodies' poses and meshes, and of the way.
  double largest_number(const Vec3& from, const Vec3& to) const {
    double largest = std::max(from.cwiseAbs().maxCoeff(), to.cwiseAbs().maxCoeff());
    for (const exact_scene::Body& body : bodies) {
      largest = std::max(largest, body.pose.translation.cwiseAbs().maxCoeff());
      for (const Vec3& vertex : body.mesh->vertices())
        largest = std::max(largest, vertex.cwiseAbs().maxCoeff());
    }
    return largest;
  }
};

template <class D>
class ExactScene : public testing::Test {};
using Detectors = testing::Types<BruteForce, AabbTree, GridGroup, SphereCluster>;
TYPED_TEST_SUITE(ExactScene, Detectors);

/// Points near the bodies, near their corners, at their corners and anywhere.
template <class D>
void check_points(Twin<D>& twin, Random& random, int count, double spread) {
  for (int i = 0; i < count && !testing::Test::HasFailure(); ++i) {
    if (twin.bodies.empty()) return;
    const exact_scene::Body& body = twin.bodies[random.below(twin.bodies.size())];
    const Vec3 corner = image(body.pose, body.mesh->vertices()[random.below(body.mesh->vertices().size())]);
    const double off = std::pow(10.0, random.between(-17, 0)) * spread;
    twin.check(i % 4 == 0 ? corner : Vec3(corner + random.point(off)));
  }
}

TYPED_TEST(ExactScene, OfBodiesThatMoveTeleportComeAndGoIsRight) {
  Random random(1);
  Twin<TypeParam> twin;
  twin.shape(box({1, 0.5, 0.25}));
  twin.shape(octahedron());
  twin.shape(soup(7));
  for (int i = 0; i < 12; ++i) twin.add(random.below(3), random_pose(random, random.point(4)));
  for (int tick = 0; tick < 16 && !this->HasFailure(); ++tick) {
    for (std::size_t i = 0; i < twin.bodies.size(); i += 1 + random.below(2)) {
      Pose pose = twin.bodies[i].pose;
      pose.rotation =
          (pose_of({0, 0, 0}, 1, 1e-9, random.between(-1e-3, 1e-3), 0).rotation * pose.rotation).eval();
      pose.translation += random.point(1e-3);
      twin.move(i, random.below(20) == 0 ? random_pose(random, random.point(4)) : pose);
    }
    if (tick % 5 == 1) twin.remove(random.below(twin.bodies.size()));
    if (tick % 5 == 3) twin.add(random.below(3), random_pose(random, random.point(4)));
    check_points(twin, random, 3, 1);
  }
}

TYPED_TEST(ExactScene, OfBodiesAtOnePlaceNamesTheLowest) {
  Random random(2);
  Twin<TypeParam> twin;
  twin.shape(box({1, 1, 1}));
  twin.shape(octahedron());
  const Pose pose = random_pose(random, {0.3, 0.2, 0.1});
  for (int i = 0; i < 20; ++i) twin.add(i == 0 || i > 3 ? 1 : 0, pose);
  check_points(twin, random, 8, 1);
  twin.remove(0);
  twin.remove(1);
  check_points(twin, random, 8, 1);
}

TYPED_TEST(ExactScene, OfNestedBodiesIsRight) {
  Random random(3);
  Twin<TypeParam> twin;
  for (int i = 1; i <= 6; ++i) twin.shape(box(0.25 * i * Vec3(1, 1, 1)));
  for (std::size_t i = 0; i < 6; ++i) twin.add(i, Pose());
  check_points(twin, random, 12, 0.1);
  twin.check({0, 0, 0});  // six walls as far
  for (std::size_t i = 0; i < 6; ++i) twin.move(i, random_pose(random, {0, 0, 0}));
  check_points(twin, random, 12, 0.1);
  twin.check({0, 0, 0});
}

TYPED_TEST(ExactScene, FarFromTheOriginIsRight) {
  for (const double offset : {0x1p20, 0x1p40, 0x1p50}) {
    Random random(4);
    Twin<TypeParam> twin;
    twin.shape(box({1, 2, 1}));
    twin.shape(octahedron());
    const Vec3 far(offset, -offset, 0.5 * offset);
    for (int i = 0; i < 6; ++i) twin.add(random.below(2), random_pose(random, far + random.point(4)));
    check_points(twin, random, 8, 1);
  }
}

TYPED_TEST(ExactScene, OfMeshesFarFromTheirOwnOriginIsRight) {
  Random random(5);
  Twin<TypeParam> twin;
  const Vec3 far(0x1p40, 3e11, -1e12);
  twin.shape(box({1, 2, 1}, far));
  twin.shape(box({3, 1, 1}, far + Vec3(7, 0, 0)));
  const Pose turn = random_pose(random, {0, 0, 0});
  for (int i = 0; i < 4; ++i)
    twin.add(random.below(2), {turn.rotation, -(turn.rotation * far) + random.point(5)});
  check_points(twin, random, 12, 1);
}

TYPED_TEST(ExactScene, TurnedByAlmostNothingIsRight) {
  Random random(6);
  Twin<TypeParam> twin;
  twin.shape(box({1, 1, 1}));
  for (const double angle : {0.0, 1e-9, -1e-9, 1e-16, 1e-300})
    twin.add(0, pose_of({0, 0, 0}, 1, angle, 2 * angle, -angle));
  check_points(twin, random, 12, 1);
  twin.check({0, 0, 0});
  twin.check({3, 0, 0});
}

TYPED_TEST(ExactScene, OfMatricesOffOrthonormalByRoundingIsRight) {
  Random random(7);
  Twin<TypeParam> twin;
  twin.shape(box({1, 1, 1}));
  twin.shape(soup(3));
  for (int i = 0; i < 6; ++i) {
    Pose pose = random_pose(random, random.point(1.5));
    for (double& entry : pose.rotation.reshaped()) entry *= 1 + random.between(-1, 1) * 0x1p-36;
    twin.add(random.below(2), pose);
  }
  check_points(twin, random, 20, 1);
}

TYPED_TEST(ExactScene, OfAnySizeIsRight) {
  for (const double size : {1e-280, 1e-150, 1e-9, 1e9, 1e150}) {
    Random random(8);
    Twin<TypeParam> twin;
    twin.shape(box({size, size, 0.5 * size}));
    for (int i = 0; i < 3; ++i) twin.add(0, random_pose(random, random.point(2 * size)));
    check_points(twin, random, 3, size);
  }
}

}  // namespace
}  // namespace touchmark
