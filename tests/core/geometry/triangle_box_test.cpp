#include "core/geometry/triangle_box.h"

#include <cmath>

#include <gtest/gtest.h>

#include "bench/support/random.h"

namespace touchmark {
namespace {

const Aabb unit{{0, 0, 0}, {1, 1, 1}};

TEST(TriangleBox, ATriangleInsideOverlaps) {
  EXPECT_TRUE(overlaps({Vec3(.2, .2, .2), Vec3(.4, .2, .2), Vec3(.2, .4, .3)}, unit));
}

TEST(TriangleBox, ATriangleAroundTheBoxOverlaps) {
  EXPECT_TRUE(overlaps({Vec3(-9, -9, .5), Vec3(9, -9, .5), Vec3(0, 9, .5)}, unit));
}

TEST(TriangleBox, TouchingOverlaps) {
  EXPECT_TRUE(overlaps({Vec3(1, .2, .2), Vec3(2, .2, .2), Vec3(2, .4, .3)}, unit));
  EXPECT_TRUE(overlaps({Vec3(1, 1, 1), Vec3(2, 1, 1), Vec3(1, 2, 3)}, unit));
}

TEST(TriangleBox, EachKindOfAxisSeparates) {
  // A box axis; the face's plane cutting off a corner; an edge passing an edge.
  EXPECT_FALSE(overlaps({Vec3(1.01, .2, .2), Vec3(2, .2, .2), Vec3(2, .4, .3)}, unit));
  EXPECT_FALSE(overlaps({Vec3(3.1, 0, 0), Vec3(0, 3.1, 0), Vec3(0, 0, 3.1)}, unit));
  EXPECT_FALSE(overlaps({Vec3(1.6, .5, .5), Vec3(.5, 1.6, .5), Vec3(1.6, 1.6, .5)}, unit));
}

TEST(TriangleBox, DegenerateTrianglesAreSegmentsAndPoints) {
  EXPECT_TRUE(overlaps({Vec3(-1, .5, .5), Vec3(2, .5, .5), Vec3(-1, .5, .5)}, unit));
  EXPECT_TRUE(overlaps({Vec3(.5, .5, .5), Vec3(.5, .5, .5), Vec3(.5, .5, .5)}, unit));
  EXPECT_FALSE(overlaps({Vec3(1.5, 0, .5), Vec3(0, 1.6, .5), Vec3(1.5, 0, .5)}, {{0, 0, 0}, {.7, .7, 1}}));
  EXPECT_FALSE(overlaps({Vec3(2, 2, 2), Vec3(2, 2, 2), Vec3(2, 2, 2)}, unit));
}

TEST(TriangleBox, NeverMissesAPointOfTheTriangleInTheBox) {
  bench::support::Random random(5);
  for (const double offset : {0.0, 1e6}) {
    const Vec3 shift(offset, -offset, 2 * offset);
    for (int round = 0; round < 20000; ++round) {
      const std::array<Vec3, 3> corner = {random.point() + shift, random.point() + shift,
                                          random.point() + shift};
      const double a = std::abs(random.between(-1, 1)), b = std::abs(random.between(-1, 1));
      const Vec3 inside = bench::support::point_in_triangle(corner[0], corner[1], corner[2], a, b);
      const Vec3 half = round % 2 == 0 ? Vec3::Zero() : Vec3(1e-3 * random.point().cwiseAbs());
      ASSERT_TRUE(overlaps(corner, {inside - half, inside + half}));
    }
  }
}

TEST(TriangleBox, SeparatesWhatSamplingOnTheTriangleSaysIsFar) {
  // A triangle whose every sample is farther from the box than the samples' spacing misses it.
  bench::support::Random random(6);
  int missed = 0;
  for (int round = 0; round < 3000; ++round) {
    const std::array<Vec3, 3> corner = {3 * random.point(), 3 * random.point(), 3 * random.point()};
    double nearest = 1e9;
    constexpr int steps = 40;
    for (int i = 0; i <= steps; ++i) {
      for (int j = 0; i + j <= steps; ++j) {
        const Vec3 sample =
            corner[0] + (corner[1] - corner[0]) * i / steps + (corner[2] - corner[0]) * j / steps;
        nearest = std::min(nearest, std::sqrt(unit.squared_distance(sample)));
      }
    }
    const bool overlapping = overlaps(corner, unit);
    if (nearest > 0.5) {
      EXPECT_FALSE(overlapping);
      ++missed;
    }
    if (nearest == 0) {
      EXPECT_TRUE(overlapping);
    }
  }
  EXPECT_GT(missed, 100);
}

}  // namespace
}  // namespace touchmark
