// The nearest point in 106 bits against the oracle, which shares no code with it.
#include "core/exact/precise_closest_point.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "bench/oracle/exact/exact_distance.h"
#include "tests/bench/oracle/corner_case_triangles.h"

namespace touchmark {
namespace {

using Corners = CornerCases::Corners;

class CloseFeet : public testing::TestWithParam<CornerCaseFamily> {};

TEST_P(CloseFeet, KeepTheErrorTheyState) {
  CornerCases cases(80);
  for (int i = 0; i < 8000; ++i) {
    const CornerCase c = placed(GetParam(), cases, i);
    const std::optional<PreciseClosestPoint> close = precise_closest_point(c.triangle, c.point);
    if (!close) continue;
    const ClosestPoint& closest = close->closest;
    ASSERT_LE(closest.error, 0x1p-60 * c.largest_difference()) << i;
    const bench::oracle::ExactNearest truth = bench::oracle::nearest_exactly(c.point, {&c.triangle, 1});
    const double off = (closest.distance.high - truth.high) + (closest.distance.low - truth.low);
    ASSERT_LE(std::abs(off), closest.error + 0x1p-98 * truth.high) << i;  // what the oracle rounds, too
    // The nearest point is one, so the offset is the oracle's, as far as doubles can tell.
    const Vec3 offset = truth.high * truth.direction;
    ASSERT_LE((closest.offset - offset).norm(), 2 * closest.error + 0x1p-50 * truth.high) << i;
  }
}

TEST_P(CloseFeet, OfTheSameFeatureAreTies) {
  CornerCases cases(81);
  int ties = 0;
  for (int i = 0; i < 4000; ++i) {
    const Corners a = GetParam().triangle(cases);
    const Corners b = {a[1], a[0], cases.vector()};
    const Vec3 point = cases.point_near(a);
    const std::optional<PreciseClosestPoint> first = precise_closest_point(a, point),
                                             second = precise_closest_point(b, point);
    if (!first || !second || !on_same_feature(*first, *second)) continue;
    ++ties;
    ASSERT_TRUE(compare_exactly(a, b, point) == 0) << i;
  }
  if (GetParam().name == "plain") {
    EXPECT_GT(ties, 400);
  }
}

TEST_P(CloseFeet, OverLevelFacesAreExact) {
  CornerCases cases(83);
  int on_border = 0;
  for (int i = 0; i < 4000; ++i) {
    Corners t = GetParam().triangle(cases);
    const Eigen::Index axis = i % 3;
    const auto k = static_cast<std::size_t>(i / 3 % 3);
    for (const std::size_t other : {(k + 1) % 3, (k + 2) % 3}) t[other][axis] = t[k][axis];
    // Over the middle of a side, or beside it by a rounding; anywhere else.
    Vec3 point = i % 2 == 0 ? Vec3(0.5 * (t[0] + t[1])) : cases.point_near(t);
    point[axis] = cases.point_near(t)[axis];
    const std::optional<PreciseClosestPoint> close = precise_closest_point(t, point);
    if (!close || close->feature) continue;
    const bench::oracle::ExactNearest truth = bench::oracle::nearest_exactly(point, {&t, 1});
    if (i % 2 == 0) ++on_border;
    ASSERT_EQ(close->closest.error, 0) << i;
    ASSERT_EQ(close->closest.distance.high, truth.high) << i;
    ASSERT_EQ(close->closest.distance.low, truth.low) << i;
    ASSERT_EQ(compare_exactly(t, {t[2], t[0], t[1]}, point), std::strong_ordering::equal);
  }
  if (GetParam().name == "plain") {
    EXPECT_GT(on_border, 400);
  }
}

INSTANTIATE_TEST_SUITE_P(Families, CloseFeet, testing::ValuesIn(corner_case_families()),
                         [](const auto& family) { return family.param.name; });

TEST(CloseFoot, TellsNearlyAlwaysWhatIsNearestToAPlainTriangle) {
  CornerCases cases(82);
  int unknown = 0;
  for (int i = 0; i < 10000; ++i) {
    const Corners t = cases.plain();
    const double part = cases.fraction();
    const Vec3 on_edge = (1 - part) * t[0] + part * t[1];
    if (!precise_closest_point(t, on_edge + cases.magnitude(-17, 0) * cases.vector())) ++unknown;
  }
  EXPECT_LE(unknown, 2);
}

TEST(CloseFoot, DoesNotTellOverABorderOrWithoutAnArea) {
  const Corners triangle = {Vec3(0, 0, 0), Vec3(4, 0, 4), Vec3(0, 4, 0)};
  EXPECT_FALSE(precise_closest_point(triangle, {1, 0, 3}));  // over an edge: face or edge?
  EXPECT_FALSE(precise_closest_point({Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(2, 2, 2)}, {1, 0, 0}));
  EXPECT_TRUE(precise_closest_point(triangle, {1, 1, 1}));
}

TEST(CloseFoot, IsACornerWhereItsEdgeBegins) {
  const Corners triangle = {Vec3(0.1, 0.1, 0.3), Vec3(4.1, 0.1, 4.3), Vec3(0.1, 4.1, 0.3)};
  for (const Vec3& beside : {Vec3(0.1, -0.3, 0.3), Vec3(0.6, -0.2, -0.2)}) {
    const std::optional<PreciseClosestPoint> close = precise_closest_point(triangle, beside);
    ASSERT_TRUE(close && close->feature) << beside.transpose();
    EXPECT_EQ(close->feature->front(), triangle[0]);
    EXPECT_EQ(close->feature->back(), triangle[0]);
  }
}

/// Two triangles of one edge, all but in one plane, or bent; and a point over the edge but for rounding.
struct Hinge {
  Corners a, b;
  Vec3 point;

  Hinge(CornerCases& cases, int i) {
    const Vec3 p = cases.vector(), q = cases.vector(), r = cases.vector();
    const Vec3 other = p + q - r;
    const double bend = i % 3 == 0 ? 0.0 : cases.magnitude(i % 3 == 1 ? -17 : -4, 0);
    const Vec3 normal = (q - p).cross(r - p).normalized();
    a = {p, q, r};
    b = {q, p, other + bend * normal};
    const double part = cases.fraction();
    point =
        (1 - part) * p + part * q + cases.fraction() * normal + cases.magnitude(-18, -15) * cases.vector();
  }
};

TEST(CloseFoot, TellsWhichOfTwoFacesThatShareAnEdgeIsNearer) {
  CornerCases cases(84);
  int inside = 0, told_inside = 0, told_by_edge = 0;
  for (int i = 0; i < 6000; ++i) {
    const Hinge hinge(cases, i);
    const std::optional<PreciseClosestPoint> a = precise_closest_point(hinge.a, hinge.point),
                                             b = precise_closest_point(hinge.b, hinge.point);
    if (!a || !b) continue;
    const std::strong_ordering truth = compare_exactly(hinge.a, hinge.b, hinge.point);
    if (is_nearer_inside(*a, hinge.a, *b)) {
      ++told_by_edge;
      ASSERT_TRUE(truth < 0) << i;
    }
    if (is_nearer_inside(*b, hinge.b, *a)) {
      ++told_by_edge;
      ASSERT_TRUE(truth > 0) << i;
    }
    if (!a->inside || !b->inside) continue;
    ++inside;
    const std::partial_ordering told = compare_inside(hinge.a, hinge.b, hinge.point);
    if (told == std::partial_ordering::unordered) continue;
    ++told_inside;
    ASSERT_TRUE(told == truth) << i;
  }
  EXPECT_GT(told_by_edge, 500);
  EXPECT_GT(inside, 200);
  EXPECT_GT(told_inside, 0.9 * inside);
}

TEST(CloseFoot, TellsNothingOfFacesThatShareNoEdge) {
  const Corners a = {Vec3(0, 0, 0), Vec3(4, 0, 4), Vec3(0, 4, 0)},
                b = {Vec3(9, 0, 0), Vec3(4, 0, 4), Vec3(9, 4, 0)};
  EXPECT_TRUE(compare_inside(a, b, {1, 1, 1}) == std::partial_ordering::unordered);
}

TEST(CloseFoot, TellsOverTheBorderOfALevelFaceWhateverItRoundsTo) {
  // 0.3 and 0.1 are no multiples of each other's last place: no difference of theirs is a double.
  const Corners lower = {Vec3(0.1, 0.1, 0.7), Vec3(3.3, 0.1, 0.7), Vec3(3.3, 3.3, 0.7)};
  const Corners upper = {Vec3(0.1, 0.1, 0.7), Vec3(3.3, 3.3, 0.7), Vec3(0.1, 3.3, 0.7)};
  for (const double x : {0.3, 1.0 / 3, 2.2, 3.1}) {
    const std::optional<PreciseClosestPoint> a = precise_closest_point(lower, {x, x, 0.3}),
                                             b = precise_closest_point(upper, {x, x, 0.3});
    ASSERT_TRUE(a && b) << x;
    EXPECT_TRUE(compare(a->closest, b->closest) == 0) << x;
    EXPECT_EQ(a->closest.distance.high, 0.7 - 0.3) << x;
    // A rounding beside the border one of them is nearer, by less than 106 bits: nothing is known.
    const double beyond = std::nextafter(x, 4);
    const std::optional<PreciseClosestPoint> over = precise_closest_point(lower, {beyond, x, 0.3});
    const std::optional<PreciseClosestPoint> beside = precise_closest_point(upper, {beyond, x, 0.3});
    ASSERT_TRUE(over && beside) << x;
    EXPECT_FALSE(over->feature) << x;
    EXPECT_TRUE(beside->feature) << x;
    EXPECT_TRUE(compare_exactly(lower, upper, {beyond, x, 0.3}) < 0) << x;
    EXPECT_FALSE(compare(over->closest, beside->closest) > 0) << x;
  }
}

TEST(CloseFoot, HasNoLevelFaceWithoutAnArea) {
  const Corners collinear = {Vec3(0, 0, 1), Vec3(1, 1, 1), Vec3(3, 3, 1)};
  EXPECT_FALSE(precise_closest_point(collinear, {2, 0, 1}));
  EXPECT_FALSE(precise_closest_point(collinear, {1, 1, 3}));
}

TEST(CloseFoot, DoesNotTellWhereDoubleDoublesLoseTheirLowerHalves) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Corners triangle = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
  EXPECT_FALSE(precise_closest_point(triangle, {nan, 0, 0}));
  EXPECT_FALSE(precise_closest_point(triangle, {1e100, 0, 0}));
  EXPECT_FALSE(
      precise_closest_point({Vec3(0, 0, 0), Vec3(1e-100, 0, 0), Vec3(0, 1e-100, 0)}, {0, 0, 1e-100}));
}

}  // namespace
}  // namespace touchmark
