// Decisions of core/geometry against the oracle's, which share no code: whole numbers of fixed size against
// those of a library that takes what it needs.
#include "core/exact/distance_predicates.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "bench/oracle/exact/exact_distance.h"
#include "bench/support/random.h"
#include "core/float_limits.h"
#include "tests/bench/oracle/corner_case_triangles.h"

namespace touchmark {
namespace {

using Corners = CornerCases::Corners;

constexpr double largest = std::numeric_limits<double>::max();
constexpr double smallest = std::numeric_limits<double>::denorm_min();

/// The distance, rounded, an ulp to each side, and what is far from it.
std::vector<double> radii(double distance) {
  return {distance, std::nextafter(distance, 0.0), std::nextafter(distance, infinity), 0, 2 * distance,
          infinity};
}

bool within_by_oracle(const CornerCase& c, double radius) {
  return radius >= 0 && bench::oracle::compare_distance(c.point, c.triangle, radius) <= 0;
}

void expect_oracle_agrees(const CornerCase& c) {
  const bench::oracle::ExactNearest truth = bench::oracle::nearest_exactly(c.point, {&c.triangle, 1});
  for (const double radius : radii(std::min(truth.high, largest)))
    ASSERT_EQ(within_exactly(c.triangle, c.point, radius), within_by_oracle(c, radius)) << radius;
  const ClosestPoint closest = closest_point_exactly(c.triangle, c.point);
  ASSERT_EQ(closest.distance.high, truth.high);
  if (std::isinf(truth.high)) return;
  if (truth.high > 1e-250) {
    ASSERT_NEAR(closest.distance.low, truth.low, 0x1p-96 * truth.high);
  }
  ASSERT_NEAR((closest.direction - truth.direction).norm(), 0, 1e-15);
  // The offset is the direction times the distance, as far as doubles can tell.
  const double scale = std::clamp(truth.high, 0x1p-1000, 0x1p1000);
  if (scale == truth.high) {
    ASSERT_NEAR((closest.offset / scale - truth.direction).norm(), 0, 1e-15);
  }
}

class ExactDecision : public testing::TestWithParam<CornerCaseFamily> {};

/// Ways to the point from another case's, at the radii where their distance may begin to be within.
TEST_P(ExactDecision, OfPartsOfAWayIsTheOracles) {
  CornerCases cases(62);
  std::size_t within = 0, beyond = 0;
  for (int i = 0; i < 1000; ++i) {
    const CornerCase c = placed(GetParam(), cases, i);
    const Vec3 from = i % 3 == 0 ? c.point : Vec3(c.triangle[0] + 3 * (c.triangle[1] - c.point));
    if (!from.allFinite()) continue;
    const double fraction = i % 2 == 0 ? 1 : std::round(cases.fraction() * 0x1p53) / 0x1p53;
    const double distance = bench::oracle::nearest_exactly(c.point, {&c.triangle, 1}).high;
    for (const double radius : radii(std::min(distance, largest))) {
      const bool expected =
          bench::oracle::compare_part_distance(from, c.point, fraction, c.triangle, radius) <= 0;
      ASSERT_EQ(path_within_exactly(c.triangle, from, c.point, fraction, radius), expected)
          << "case " << i << ", radius " << radius << ", fraction " << fraction;
      ++(expected ? within : beyond);
      if (fraction == 1) {
        ASSERT_EQ(bench::oracle::compare_segment_distance(from, c.point, c.triangle, radius) <= 0, expected);
      }
    }
  }
  EXPECT_GT(within, 500U);
  EXPECT_GT(beyond, 20U);
}

/// On a small grid ways go through corners and edges, end on them, lie in the plane, and triangles have no
/// area.
TEST(ExactDecisionOfABarePoint, IsTheOraclesOnASmallGrid) {
  bench::support::Random random(63);
  const auto place = [&] {
    return Vec3(static_cast<double>(random.below(4)), static_cast<double>(random.below(4)),
                static_cast<double>(random.below(4)));
  };
  std::size_t met = 0, told = 0;
  for (int i = 0; i < 20000; ++i) {
    const TriangleCorners triangle{place(), place(), place()};
    const Vec3 from = place(), to = place();
    const bool expected = bench::oracle::compare_segment_distance(from, to, triangle, 0) <= 0;
    ASSERT_EQ(path_within_exactly(triangle, from, to, 1, 0), expected) << "case " << i;
    ASSERT_EQ(within_exactly(triangle, to, 0), bench::oracle::compare_distance(to, triangle, 0) <= 0);
    const std::optional<bool> meets = meets_by_sides(triangle, from, to);
    ASSERT_EQ(meets.value_or(expected), expected) << "case " << i;
    if (meets != true) continue;
    ++met;
    if (within_exactly(triangle, from, 0)) continue;
    const double fraction = first_meeting_exactly(triangle, from, to);
    const auto order = [&](double part) {
      return bench::oracle::compare_part_distance(from, to, part, triangle, 0);
    };
    ASSERT_TRUE(order(fraction) > 0) << "case " << i << " is late";
    ASSERT_TRUE(order(std::min(fraction + 0x1p-51, 1.0)) <= 0) << "case " << i << " is early";
    ++told;
  }
  EXPECT_GT(met, 1000U);
  EXPECT_GT(told, 500U);
}

TEST_P(ExactDecision, IsTheOracles) {
  CornerCases cases(60);
  for (int i = 0; i < 4000; ++i) {
    ASSERT_NO_FATAL_FAILURE(expect_oracle_agrees(placed(GetParam(), cases, i))) << "case " << i;
  }
}

TEST_P(ExactDecision, IsTheOraclesWhereverInTheRangeOfDouble) {
  CornerCases cases(61);
  for (int i = 0; i < 1000; ++i) {
    CornerCase c{GetParam().triangle(cases), Vec3::Zero()};
    c.point = cases.point_near(c.triangle);
    // At either end, or each corner at a size of its own.
    const double common = i % 3 == 0 ? 0x1p1000 : 0x1p-1060;
    for (Vec3* v : c.vectors()) *v *= i % 3 == 2 ? cases.magnitude(-300, 300) : common;
    ASSERT_NO_FATAL_FAILURE(expect_oracle_agrees(c)) << "case " << i;
  }
}

TEST_P(ExactDecision, OrdersTrianglesAsTheOracleDoes) {
  CornerCases cases(62);
  for (int i = 0; i < 2000; ++i) {
    const Corners a = GetParam().triangle(cases);
    // Beside each other, so that ties are common, or anything.
    const Corners b = i % 2 == 0 ? Corners{a[1], a[0], cases.lattice()} : GetParam().triangle(cases);
    const Vec3 point = cases.point_near(a);
    const std::array<bench::oracle::Triangle, 2> forward = {a, b}, backward = {b, a};
    const std::size_t first = bench::oracle::nearest_exactly(point, forward).which;
    const std::size_t second = bench::oracle::nearest_exactly(point, backward).which;
    const auto order = first == 1    ? std::strong_ordering::greater
                       : second == 1 ? std::strong_ordering::less
                                     : std::strong_ordering::equal;
    ASSERT_TRUE(compare_exactly(a, b, point) == order) << i;
  }
}

INSTANTIATE_TEST_SUITE_P(Families, ExactDecision, testing::ValuesIn(corner_case_families()),
                         [](const auto& family) { return family.param.name; });

TEST(ExactDecisions, TheWholeRangeOfDoubleAtOnce) {
  const Corners triangle = {Vec3(largest, smallest, 0), Vec3(-largest, largest, smallest),
                            Vec3(smallest, -largest, largest)};
  for (const Vec3& point : {Vec3(0, 0, 0), Vec3(smallest, smallest, smallest), Vec3(-largest, 1, largest)})
    expect_oracle_agrees({triangle, point});
}

TEST(ExactDecisions, OnTheTriangleTheDistanceIsZeroAndHasNoDirection) {
  const Corners triangle = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
  for (const Vec3& point : {Vec3(1, 1, 0), Vec3(2, 0, 0), Vec3(0, 4, 0)}) {
    EXPECT_TRUE(within_exactly(triangle, point, 0));
    EXPECT_EQ(closest_point_exactly(triangle, point).distance.high, 0);
    EXPECT_EQ(closest_point_exactly(triangle, point).direction, Vec3::Zero());
  }
  EXPECT_FALSE(within_exactly(triangle, {1, 1, smallest}, 0));
  EXPECT_TRUE(within_exactly(triangle, {1, 1, smallest}, smallest));
}

TEST(ExactDecisions, WhatIsNotFiniteOrNegativeIsNotWithin) {
  const Corners triangle = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
  const double nan = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(within_exactly(triangle, {nan, 0, 0}, 1));
  EXPECT_FALSE(within_exactly(triangle, {infinity, 0, 0}, infinity));
  EXPECT_FALSE(within_exactly(triangle, {1, 1, 0}, -1));
  EXPECT_FALSE(within_exactly(triangle, {1, 1, 0}, nan));
}

TEST(ExactDecisions, TheNormalOfACapAsThinAsCoordinatesAllow) {
  const Vec3 normal = normal_exactly({Vec3(1, 1, 1), Vec3(-1, -1, 1), Vec3(0x1p-50, -0x1p-50, 1)});
  EXPECT_EQ(normal, Vec3(0, 0, 1));
  EXPECT_EQ(normal_exactly({Vec3(1, 1, 1), Vec3(3, 3, 3), Vec3(2, 2, 2)}), Vec3::Zero());
}

}  // namespace
}  // namespace touchmark
