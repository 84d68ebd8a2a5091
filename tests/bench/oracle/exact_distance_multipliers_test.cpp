// The oracle's integers and intervals against optimality conditions solved in rationals.
#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "bench/oracle/exact/exact_distance.h"
#include "bench/oracle/exact/interval_distance.h"
#include "bench/oracle/float_limits.h"
#include "tests/bench/oracle/corner_case_triangles.h"
#include "tests/bench/oracle/rational_hull.h"

namespace touchmark::bench::oracle {

namespace stress = experiments::stress;

namespace {

struct Case {
  Vec3 from, to;
  Triangle triangle;
};

Case corner_case(stress::CornerCases& cases, int number) {
  Triangle t;
  switch (number % 6) {
    case 0:
      t = cases.needle();
      break;
    case 1:
      t = cases.cap();
      break;
    case 2:
      t = cases.collinear();
      break;
    case 3:
      t = cases.coincident();
      break;
    case 4:
      t = cases.plain();
      break;
    default:
      t = cases.on_lattice();
  }
  Case result{cases.point_near(t), cases.point_near(t), t};
  if (number % 6 == 5 && cases.below(2) == 0) result.from = cases.lattice(), result.to = cases.lattice();
  if (cases.below(4) == 0) {
    const double scale = cases.magnitude(-9, 9);
    const Vec3 offset = cases.magnitude(-9, 9) * cases.vector();
    for (Vec3* v : {&result.from, &result.to, &result.triangle[0], &result.triangle[1], &result.triangle[2]})
      *v = scale * *v + offset;
  }
  return result;
}

/// Is high + low the root of a rational, to 2^-100 of it or to the smallest double?
bool is_root(double high, double low, const mpq_class& square) {
  const mpq_class root = mpq_class(high) + mpq_class(low);
  const mpq_class error = root * mpq_class(0x1p-100) + mpq_class(std::numeric_limits<double>::denorm_min());
  const mpq_class least = root > error ? mpq_class(root - error) : mpq_class(0), most = root + error;
  return least * least <= square && square <= most * most;
}

mpq_class squared(double x) { return mpq_class(x) * mpq_class(x); }

TEST(ExactDistance, EqualsTheOptimumByMultipliers) {
  stress::CornerCases cases(1);
  for (int i = 0; i < 6000; ++i) {
    const Case c = corner_case(cases, i);
    const mpq_class expected = squared_distance_by_multipliers(c.from, c.triangle);
    const ExactNearest found = nearest_exactly(c.from, {&c.triangle, 1});
    ASSERT_TRUE(is_root(found.high, found.low, expected)) << i;
    const mpq_class to_point = inner(difference(found.point, c.from), difference(found.point, c.from));
    const double rounding = 8 * 0x1p-53 * (found.point.norm() + c.from.norm());
    EXPECT_NEAR(std::sqrt(to_point.get_d()), found.high, rounding) << i;
    for (const double r : {found.high, std::nextafter(found.high, 0), std::nextafter(found.high, infinity)})
      ASSERT_EQ(compare_distance(c.from, c.triangle, r) <= 0, expected <= squared(r)) << i;
  }
}

TEST(ExactDistance, TheDirectionIsThatOfTheVectorFromTheNearestPoint) {
  stress::CornerCases cases(2);
  for (int i = 0; i < 2000; ++i) {
    const Triangle t = cases.plain();
    const Vec3 p = 2 * cases.vector();
    const ExactNearest found = nearest_exactly(p, {&t, 1});
    EXPECT_NEAR((p - found.point - found.high * found.direction).norm(), 0, 1e-15) << i;
    EXPECT_NEAR(found.direction.norm(), 1, 1e-15);
  }
}

TEST(ExactSegmentDistance, EqualsTheOptimumByMultipliers) {
  stress::CornerCases cases(3);
  int crossing = 0;
  for (int i = 0; i < 900; ++i) {
    const Case c = corner_case(cases, i);
    const mpq_class expected = squared_segment_distance_by_multipliers(c.from, c.to, c.triangle);
    const double distance = std::sqrt(expected.get_d());
    if (expected == 0) ++crossing;
    for (const double r : {0.0, distance, std::nextafter(distance, 0), std::nextafter(distance, infinity)})
      ASSERT_EQ(compare_segment_distance(c.from, c.to, c.triangle, r), cmp(expected, squared(r)) <=> 0) << i;
  }
  EXPECT_GT(crossing, 30);
}

TEST(IntervalDistance, HoldsTheExactDistance) {
  stress::CornerCases cases(4);
  for (int i = 0; i < 30000; ++i) {
    const Case c = corner_case(cases, i);
    const Interval interval = distance_interval(c.from, c.triangle);
    ASSERT_LE(interval.lo, interval.hi);
    ASSERT_TRUE(compare_distance(c.from, c.triangle, interval.lo) >= 0) << i;
    ASSERT_TRUE(compare_distance(c.from, c.triangle, interval.hi) <= 0) << i;
  }
}

TEST(IntervalDistance, HoldsTheExactDistanceOfASegment) {
  stress::CornerCases cases(5);
  for (int i = 0; i < 9000; ++i) {
    const Case c = corner_case(cases, i);
    const Interval interval = segment_distance_interval(c.from, c.to, c.triangle);
    ASSERT_LE(interval.lo, interval.hi);
    ASSERT_TRUE(compare_segment_distance(c.from, c.to, c.triangle, interval.lo) >= 0) << i;
    ASSERT_TRUE(compare_segment_distance(c.from, c.to, c.triangle, interval.hi) <= 0) << i;
  }
}

TEST(IntervalDistance, HoldsTheExactDistanceAtEveryMagnitude) {
  stress::CornerCases cases(6);
  for (int i = 0; i < 4000; ++i) {
    const double scale = cases.magnitude(-320, 307);
    const Triangle t = {scale * cases.vector(), scale * cases.vector(), scale * cases.vector()};
    const Vec3 p = scale * cases.vector();
    const Interval interval = distance_interval(p, t);
    ASSERT_TRUE(compare_distance(p, t, interval.lo) >= 0) << scale;
    ASSERT_TRUE(compare_distance(p, t, interval.hi) <= 0) << scale;
  }
}

TEST(IntervalDistance, IsNarrowOnOrdinaryTriangles) {
  stress::CornerCases cases(7);
  for (int i = 0; i < 5000; ++i) {
    // Sides and heights of the order of one, the point no nearer than that.
    const Triangle t = {Vec3(0, 0, 0), Vec3(cases.between(1, 2), 0, 0),
                        Vec3(cases.between(0, 1), cases.between(1, 2), 0)};
    const Vec3 p = 4 * cases.vector() + Vec3(0, 0, 5);
    const Interval interval = distance_interval(p, t);
    EXPECT_LE(interval.hi - interval.lo, 64 * 0x1p-53 * 10);
  }
}

}  // namespace
}  // namespace touchmark::bench::oracle
