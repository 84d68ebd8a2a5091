#include "core/geometry/smallest_sphere.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "bench/support/random.h"

namespace touchmark {
namespace {

bool holds_all(const Sphere& sphere, const std::vector<Vec3>& points) {
  for (const Vec3& p : points)
    if (!sphere.contains(p)) return false;
  return true;
}

TEST(SmallestSphere, OfOnePointIsThePoint) {
  const std::vector<Vec3> points = {{1, 2, 3}, {1, 2, 3}};
  EXPECT_EQ(smallest_sphere(points).center, Vec3(1, 2, 3));
  EXPECT_EQ(smallest_sphere(points).radius, 0);
}

TEST(SmallestSphere, OfTwoPointsHasThemAsDiameter) {
  const Sphere sphere = smallest_sphere(std::vector<Vec3>{{0, 0, 0}, {2, 0, 0}, {1, 0.5, 0}});
  EXPECT_NEAR((sphere.center - Vec3(1, 0, 0)).norm(), 0, 1e-14);
  EXPECT_NEAR(sphere.radius, 1, 1e-14);
}

TEST(SmallestSphere, OfAnAcuteTriangleIsItsCircumcircle) {
  const double h = std::sqrt(3.0) / 2;
  const Sphere sphere = smallest_sphere(std::vector<Vec3>{{1, 0, 5}, {-0.5, h, 5}, {-0.5, -h, 5}});
  EXPECT_NEAR((sphere.center - Vec3(0, 0, 5)).norm(), 0, 1e-14);
  EXPECT_NEAR(sphere.radius, 1, 1e-14);
}

TEST(SmallestSphere, OfACubesCornersIsAboutItsMiddle) {
  std::vector<Vec3> points;
  for (int i = 0; i < 8; ++i) points.emplace_back(i & 1, i >> 1 & 1, i >> 2 & 1);
  const Sphere sphere = smallest_sphere(points);
  EXPECT_NEAR((sphere.center - Vec3(0.5, 0.5, 0.5)).norm(), 0, 1e-13);
  EXPECT_NEAR(sphere.radius, std::sqrt(0.75), 1e-13);
}

TEST(SmallestSphere, OfPointsOnALineHasTheEndsAsDiameter) {
  std::vector<Vec3> points;
  for (int i = 0; i <= 10; ++i) points.push_back(Vec3(1, 2, 3) + 0.1 * i * Vec3(2, -1, 2));
  EXPECT_NEAR(smallest_sphere(points).radius, 1.5, 1e-13);
}

TEST(SmallestSphere, HoldsEveryPointForCertainAtAnyOffset) {
  bench::support::Random random(3);
  for (const double offset : {0.0, 1.0, 1e6, 1e12}) {
    for (int round = 0; round < 200; ++round) {
      std::vector<Vec3> points;
      for (int i = 0; i < 3 + round; ++i) points.push_back(random.point() + Vec3(offset, -offset, offset));
      ASSERT_TRUE(holds_all(smallest_sphere(points), points)) << offset << ' ' << round;
    }
  }
}

/// A sphere is the smallest iff its centre is in the hull of the points on it: no direction leads away from
/// all.
TEST(SmallestSphere, CannotMoveInAnyDirectionAndShrink) {
  bench::support::Random random(4);
  for (int round = 0; round < 200; ++round) {
    std::vector<Vec3> points;
    for (int i = 0; i < 4 + round; ++i) points.push_back(random.point());
    if (round % 3 == 0)
      for (Vec3& p : points) p.normalize();  // all on one sphere
    const Sphere sphere = smallest_sphere(points);
    for (int way = 0; way < 100; ++way) {
      const Vec3 moved = sphere.center + 1e-4 * random.point();
      double needed = 0;
      for (const Vec3& p : points) needed = std::max(needed, (p - moved).norm());
      ASSERT_GE(needed, sphere.radius * (1 - 1e-12)) << round;
    }
  }
}

}  // namespace
}  // namespace touchmark
