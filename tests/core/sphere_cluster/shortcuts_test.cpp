// Answers without a descent: by the mesh's box, by sampled distances, and by the planes of the last triangle.
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/core/sphere_cluster/test_meshes.h"

namespace touchmark {
namespace {

TriangleMesh moved(const TriangleMesh& mesh, double scale, const Vec3& by) {
  std::vector<Vec3> vertices;
  for (const Vec3& vertex : mesh.vertices()) vertices.push_back(scale * vertex + by);
  return {std::move(vertices), {mesh.triangles().begin(), mesh.triangles().end()}};
}

/// Two triangles in the plane z = by.z, edge 2 scale.
TriangleMesh square(double scale, const Vec3& by) {
  return moved({{{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}}}, scale, by);
}

/// Asks all queries of both detectors, the same session at each place, and returns how many answers differ.
class Comparison {
 public:
  Comparison(const TriangleMesh& mesh, const SphereCluster::Options& options)
      : ours_(SphereCluster::build(mesh, options)), all_(BruteForce::build(mesh)) {}

  std::size_t differences(const Vec3& from, const Vec3& to, double radius, std::uint64_t kind) {
    const Probe probe{to, radius};
    switch (kind % 4) {
      case 0:
        return ours_.touches(probe, session_) != all_.touches(probe, plain_) ? 1 : 0;
      case 1:
        return differ(ours_.nearest(probe, radius, session_), all_.nearest(probe, radius, plain_));
      case 2:
        return differ(ours_.nearest(probe, infinity, session_), all_.nearest(probe, infinity, plain_));
      default: {
        const auto a = ours_.first_hit({from, to, radius}, session_),
                   b = all_.first_hit({from, to, radius}, plain_);
        if (!a || !b) return a.has_value() != b.has_value() ? 1 : 0;
        return a->fraction != b->fraction || differ(a->contact, b->contact) > 0 ? 1 : 0;
      }
    }
  }

 private:
  static std::size_t differ(const std::optional<Contact>& a, const std::optional<Contact>& b) {
    if (!a || !b) return a.has_value() != b.has_value() ? 1 : 0;
    return a->triangle != b->triangle || a->distance != b->distance || a->point != b->point ||
                   a->normal != b->normal
               ? 1
               : 0;
  }

  SphereCluster ours_;
  BruteForce all_;
  SphereCluster::Session session_;
  BruteForce::Session plain_;
};

/// A way whose steps are of all sizes, from a thousandth of the mesh to three times it, so that memories
/// serve, fail and lie far back, with radii of as many sizes.
void expect_brute_force_on_a_wild_way(const TriangleMesh& mesh, double size, const Vec3& middle,
                                      const SphereCluster::Options& options) {
  test::Random random(29);
  Comparison comparison(mesh, options);
  std::size_t wrong = 0;
  Vec3 at = middle;
  for (int i = 0; i < 4000; ++i) {
    const double step = size * std::pow(2, random.between(-10, 1.6));
    Vec3 next = at + random.point(step);
    if (!((next - middle).norm() < 4 * size)) next = middle + random.point(size);
    const double radius = i % 9 == 0 ? 0 : size * std::pow(2, random.between(-10, 1));
    wrong += comparison.differences(at, next, radius, random.below(4));
    at = next;
  }
  EXPECT_EQ(wrong, 0U);
}

TEST(SphereClusterShortcuts, TakeNothingFromTheAnswersOnAWildWay) {
  const TriangleMesh sphere = test::bumpy_sphere(12, 0.05, 1), soup = test::soup(300, 0.4, 2);
  for (const auto& options : {SphereCluster::Options{}, SphereCluster::Options{.widest = Simd::portable},
                              SphereCluster::Options{.construction = SphereCluster::Construction::lazy}}) {
    expect_brute_force_on_a_wild_way(sphere, 1, Vec3::Zero(), options);
    expect_brute_force_on_a_wild_way(soup, 1, Vec3::Zero(), options);
  }
}

TEST(SphereClusterShortcuts, TakeNothingFarFromTheOriginAndOnFlatTinyAndHugeMeshes) {
  const TriangleMesh sphere = test::bumpy_sphere(8, 0.05, 1);
  const SphereCluster::Options usual;
  const Vec3 far(0x1p50, -0x1p50, 0x1p49), near_by(1e9, 2e9, -3e9);
  expect_brute_force_on_a_wild_way(moved(sphere, 64, far), 64, far, usual);
  expect_brute_force_on_a_wild_way(moved(sphere, 1, near_by), 1, near_by, usual);
  expect_brute_force_on_a_wild_way(square(1, Vec3::Zero()), 1, Vec3::Zero(), usual);
  expect_brute_force_on_a_wild_way(moved(sphere, 0x1p-40, Vec3::Zero()), 0x1p-40, Vec3::Zero(), usual);
  expect_brute_force_on_a_wild_way(moved(sphere, 0x1p60, Vec3::Zero()), 0x1p60, Vec3::Zero(), usual);
}

/// The box of a square is as flat as the square, so over it the distance to both is z.
TEST(SphereClusterShortcuts, ContactIsClosedWhereTheBoxAnsweredLast) {
  const SphereCluster detector = SphereCluster::build(square(1, Vec3::Zero()));
  SphereCluster::Session session;
  for (const double radius : {0.0, 0x1p-30, 0.1, 0.7, 3.0}) {
    SCOPED_TRACE(radius);
    const double beyond = std::nextafter(radius, infinity);
    for (const double sign : {-1.0, 1.0}) {
      const Vec3 out(0.1, 0.2, sign * (radius + 1)), on(0.1, 0.2, sign * radius),
          off(0.1, 0.2, sign * beyond);
      EXPECT_FALSE(detector.touches({out, radius}, session));
      EXPECT_FALSE(detector.touches({off, radius}, session));
      EXPECT_TRUE(detector.touches({on, radius}, session));
      EXPECT_FALSE(detector.nearest({out, 0}, radius, session));
      EXPECT_FALSE(detector.nearest({off, 0}, radius, session));
      EXPECT_TRUE(detector.nearest({on, 0}, radius, session));
      EXPECT_FALSE(detector.first_hit({out, out + Vec3(9, 0, 0), radius}, session));
      const auto impact = detector.first_hit({out, on, radius}, session);
      ASSERT_TRUE(impact);
      EXPECT_NEAR(impact->contact.distance, radius, 1e-12);
    }
  }
}

TEST(SphereClusterShortcuts, LookAtNothing) {
  const SphereCluster detector = SphereCluster::build(test::bumpy_sphere(24, 0.01, 1));
  SphereCluster::Session session;
  for (const double z : {1.1, 2.0, 3.5, 20.0})  // beyond the box, whatever the step
    EXPECT_FALSE(detector.touches({Vec3(0, 0, z), 0.05}, session));
  EXPECT_FALSE(detector.first_hit({Vec3(-9, 0, 2), Vec3(9, 0, 2), 0.5}, session));
  // Well within the radius: the middle of a sample's cube is near, and so is the mesh to that.
  EXPECT_TRUE(detector.touches({Vec3(0, 0, 1), 0.5}, session));
  EXPECT_EQ(session.work.total(), 0U);
}

/// A search in vain leaves no triangle to begin with, and a touch that samples tell names none either.
TEST(SphereClusterShortcuts, ATouchBySamplesMayFollowASearchInVain) {
  const TriangleMesh mesh = test::bumpy_sphere(24, 0.01, 1);
  const SphereCluster detector = SphereCluster::build(mesh);
  const BruteForce all = BruteForce::build(mesh);
  BruteForce::Session plain;
  test::Random random(31);
  for (int i = 0; i < 500; ++i) {
    const Vec3 center = random.direction() * random.between(1.02, 1.1);
    const double distance = all.nearest({center, 0}, infinity, plain)->distance;
    const double short_of = random.between(0.8, 0.999) * distance;
    SphereCluster::Session session;
    EXPECT_FALSE(detector.nearest({center, 0}, short_of, session));
    EXPECT_TRUE(detector.touches({center, 0.8}, session));
    EXPECT_FALSE(detector.touches({center, short_of}, session));
    EXPECT_TRUE(detector.touches({center, 0.8}, session));
    EXPECT_TRUE(detector.touches({center, 1.001 * distance}, session));
  }
}

/// Straight away from what was near the distance grows by all that the point moves: the shortcut by that is
/// at its end just where contact is.
TEST(SphereClusterShortcuts, ATouchThatMovesStraightAwayEndsWhereTheDistanceDoes) {
  test::Random random(32);
  for (int i = 0; i < 300; ++i) {
    const double scale = std::ldexp(1.0, i % 61 - 30);
    const Vec3 by = scale * (i % 4 == 0 ? random.point(std::ldexp(1.0, i % 40)) : Vec3::Zero());
    const TriangleMesh mesh = moved(test::soup(3, 1, static_cast<std::uint32_t>(i)), scale, by);
    const SphereCluster detector = SphereCluster::build(mesh);
    const BruteForce all = BruteForce::build(mesh);
    BruteForce::Session plain;
    for (int k = 0; k < 20; ++k) {
      const Vec3 from = by + scale * random.point(2);
      const auto near = all.nearest({from, 0}, infinity, plain);
      SphereCluster::Session session;
      EXPECT_TRUE(detector.touches({from, near->distance * (1 + 1e-12)}, session));
      const Vec3 to = from + random.between(0, 1e-3) * (from - near->point);
      const double distance = all.nearest({to, 0}, infinity, plain)->distance;
      for (const double radius : {distance, std::nextafter(distance, 0), std::nextafter(distance, infinity),
                                  distance * (1 - 1e-14), distance * (1 + 1e-9)})
        EXPECT_EQ(detector.touches({to, radius}, session), all.touches({to, radius}, plain))
            << i << ", " << k;
    }
  }
}

/// Two squares far from each other are asked with one session, slowly moving and not, in box and clearance.
TEST(SphereClusterShortcuts, WhatTheBoxToldOneMeshIsNotBelievedOfAnother) {
  const std::array<Vec3, 2> middle = {Vec3::Zero(), Vec3(100, 0, 0)};
  const std::array<SphereCluster, 2> detectors = {SphereCluster::build(square(1, middle[0])),
                                                  SphereCluster::build(square(1, middle[1]))};
  constexpr double radius = 0.5;
  test::Random random(33);
  SphereCluster::Session session;
  std::size_t touches = 0;
  for (int course = 0; course < 400; ++course) {
    const double step = course % 2 == 0 ? 1e-3 : 1;
    const auto over = static_cast<std::size_t>(course % 3 == 0);
    double z = random.between(-20, 20);
    for (int i = 0; i < 100; ++i) {
      z += step * random.between(-1, 1);
      if (i % 37 == 36) z = random.between(-1, 1);
      const std::size_t asked = random.between(0, 1) < 0.2 ? 1 - over : over;
      const Probe probe{middle[over] + Vec3(0.1, 0.2, z), radius};
      const bool expected = asked == over && std::abs(z) <= radius;
      touches += expected ? 1 : 0;
      const SphereCluster& detector = detectors[asked];
      if (i % 2 == 0)
        ASSERT_EQ(detector.touches(probe, session), expected) << course << ", " << i << ", " << z;
      else
        ASSERT_EQ(detector.nearest(probe, radius, session).has_value(), expected) << course << ", " << i;
    }
  }
  EXPECT_GT(touches, 1000U);
}

TEST(SphereClusterShortcuts, TheBoxIsThatOfTheUpdatedMesh) {
  const TriangleMesh before = test::bumpy_sphere(8, 0, 1);
  std::vector<Vec3> vertices(before.vertices().begin(), before.vertices().end());
  for (Vec3& vertex : vertices)
    if (vertex.z() > 0.99) vertex.z() = 1.04;
  const TriangleMesh after(vertices, {before.triangles().begin(), before.triangles().end()});
  SphereCluster detector = SphereCluster::build(before);
  SphereCluster::Session session;
  const Probe over_the_pole{Vec3(0, 0, 1.05), 0.02};
  EXPECT_FALSE(detector.touches(over_the_pole, session));
  EXPECT_FALSE(detector.touches(over_the_pole, session));
  detector.update(after);
  EXPECT_TRUE(detector.touches(over_the_pole, session));
}

}  // namespace
}  // namespace touchmark
