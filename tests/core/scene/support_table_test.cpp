// Bounds of how far points reach in a direction, against every point looked at.
#include "core/scene/round/support_table.h"

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include <gtest/gtest.h>

namespace touchmark {
namespace {

using Wide = Eigen::Matrix<long double, 3, 1>;

Vec3 random_vector(std::mt19937_64& engine) {
  std::normal_distribution<double> normal;
  return {normal(engine), normal(engine), normal(engine)};
}

/// The bound is never less, and not much more, in directions along axes and between them.
void expect_bounds(const std::vector<Vec3>& points, const Vec3& center, double beyond, double loose) {
  double radius = 0;
  for (const Vec3& point : points) radius = std::max(radius, (point - center).norm());
  radius *= 1 + 1e-14;
  const SupportTable table(points, center, radius, beyond);
  std::mt19937_64 engine(1);
  for (int i = 0; i < 2000; ++i) {
    Vec3 direction = random_vector(engine);
    if (i % 3 == 1) direction[i % 9 / 3] *= 1e-9;
    if (i % 5 == 1) direction = Vec3(i % 7 - 3, i % 11 - 5, i % 13 - 6);
    if (direction.isZero()) continue;
    direction.normalize();
    const Wide along = direction.cast<long double>();
    long double farthest = -1e4000L;
    for (const Vec3& point : points)
      farthest = std::max(farthest, along.dot(point.cast<long double>() - center.cast<long double>()));
    farthest += static_cast<long double>(beyond) * along.norm();
    EXPECT_GE(static_cast<long double>(table.along(direction)), farthest);
    EXPECT_LE(table.along(direction), static_cast<double>(farthest) + loose * (radius + beyond));
  }
}

std::vector<Vec3> points_about(const Vec3& center, double size) {
  std::mt19937_64 engine(2);
  std::vector<Vec3> points;
  for (int i = 0; i < 100; ++i) points.push_back(center + size * random_vector(engine));
  return points;
}

TEST(SupportTable, BoundsPointsAnywhere) {
  expect_bounds(points_about({1, 2, 3}, 1), {1, 2, 3}, 0, 0.2);
  expect_bounds(points_about({1e6, 2, -3e6}, 1e-3), {1e6, 2, -3e6}, 0, 0.2);
  expect_bounds(points_about(Vec3::Zero(), 1e-20), Vec3::Zero(), 0, 0.2);
}

TEST(SupportTable, BoundsPointsThatAreAllOnOneSideOfTheCentre) {
  expect_bounds(points_about({10, 0, 0}, 1), Vec3::Zero(), 0, 0.2);
}

TEST(SupportTable, BoundsOnePointAndABallAboutIt) {
  expect_bounds({{1, 2, 3}}, {1, 2, 3}, 0.5, 0.1);
  expect_bounds({{1, 2, 3}}, {1, 2, 3}, 0, 0.1);
}

TEST(SupportTable, BoundsASegmentAndWhatIsAboutIt) {
  expect_bounds({{0, 0, -1}, {0, 0, 1}}, Vec3::Zero(), 0.25, 0.1);
}

}  // namespace
}  // namespace touchmark
