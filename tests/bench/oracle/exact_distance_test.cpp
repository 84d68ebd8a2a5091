#include "bench/oracle/exact/exact_distance.h"

#include <cmath>
#include <limits>
#include <random>

#include <gtest/gtest.h>

#include "bench/oracle/float_limits.h"

namespace touchmark::bench::oracle {
namespace {

const Triangle right_angle = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};

ExactNearest nearest(const Vec3& point, const Triangle& triangle) {
  return nearest_exactly(point, {&triangle, 1});
}

TEST(ExactDistance, OverTheFaceItIsTheHeight) {
  const ExactNearest above = nearest({1, 1, 3}, right_angle);
  EXPECT_EQ(above.high, 3);
  EXPECT_EQ(above.low, 0);
  EXPECT_EQ(above.point, Vec3(1, 1, 0));
  EXPECT_EQ(above.direction, Vec3(0, 0, 1));
  EXPECT_EQ(nearest({1, 1, -3}, right_angle).direction, Vec3(0, 0, -1));
}

TEST(ExactDistance, BesideAnEdgeItIsTheDistanceToTheEdge) {
  const ExactNearest beside = nearest({2, -3, 4}, right_angle);
  EXPECT_EQ(beside.high, 5);
  EXPECT_EQ(beside.point, Vec3(2, 0, 0));
  EXPECT_NEAR(beside.direction.y(), -0.6, 1e-15);
  EXPECT_NEAR(beside.direction.z(), 0.8, 1e-15);
}

TEST(ExactDistance, BeyondACornerItIsTheDistanceToTheCorner) {
  const ExactNearest beyond = nearest({-2, -1, 2}, right_angle);
  EXPECT_EQ(beyond.high, 3);
  EXPECT_EQ(beyond.point, Vec3(0, 0, 0));
}

TEST(ExactDistance, OnTheTriangleItIsZeroAndWithoutDirection) {
  for (const Vec3& point : {Vec3(1, 1, 0), Vec3(2, 0, 0), Vec3(2, 2, 0), Vec3(4, 0, 0)}) {
    const ExactNearest on = nearest(point, right_angle);
    EXPECT_EQ(on.high, 0);
    EXPECT_EQ(on.point, point);
    EXPECT_EQ(on.direction, Vec3(0, 0, 0));
  }
}

TEST(ExactDistance, OneUnitOfTheLastPlaceAboveAFaceIsNotZero) {
  const double least = std::numeric_limits<double>::denorm_min();
  EXPECT_EQ(nearest({1, 1, least}, right_angle).high, least);
  EXPECT_EQ(compare_distance({1, 1, least}, right_angle, 0), std::strong_ordering::greater);
}

TEST(ExactDistance, ZeroAreaIsASegmentOrAPoint) {
  EXPECT_EQ(nearest({6, 3, 4}, {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(8, 0, 0)}).high, 5);
  EXPECT_EQ(nearest({6, 3, 4}, {Vec3(4, 0, 0), Vec3(8, 0, 0), Vec3(0, 0, 0)}).high, 5);
  EXPECT_EQ(nearest({1, 3, 1}, {Vec3(1, 1, 1), Vec3(1, 1, 1), Vec3(1, 1, 1)}).high, 2);
  EXPECT_EQ(nearest({2, 0, 2}, {Vec3(0, 0, 0), Vec3(0, 0, 0), Vec3(4, 0, 0)}).high, 2);
}

TEST(ExactDistance, TheRootIsGivenToTwiceTheDigitsOfADouble) {
  const ExactNearest diagonal = nearest({-1, -1, 0}, right_angle);  // sqrt(2)
  EXPECT_EQ(diagonal.high, std::sqrt(2.0));
  EXPECT_EQ(diagonal.low, -9.667293313452913e-17);  // sqrt(2) less that, from its decimal expansion
}

TEST(ExactDistance, NothingOverflowsOrVanishes) {
  const auto scaled = [](double s) -> Triangle {
    return {Vec3(0, 0, 0), Vec3(4 * s, 0, 0), Vec3(0, 4 * s, 0)};
  };
  EXPECT_EQ(nearest({2e300, -3e300, 4e300}, scaled(1e300)).high, 5e300);
  EXPECT_EQ(nearest({0x2p-1000, -0x3p-1000, 0x4p-1000}, scaled(0x1p-1000)).high, 0x5p-1000);
  EXPECT_EQ(nearest({1.7e308, 1.7e308, 1.7e308}, scaled(-1e307)).high, infinity);
  EXPECT_EQ(nearest({1e-300, 1, 1e300}, scaled(1)).high, 1e300);
}

TEST(ExactDistance, OfExactTiesTheFirstIsNamed) {
  const std::vector<Triangle> triangles = {{Vec3(0, 0, 5), Vec3(4, 0, 5), Vec3(0, 4, 5)},
                                           {Vec3(0, 0, 1), Vec3(4, 0, 1), Vec3(0, 4, 1)},
                                           {Vec3(0, 0, -1), Vec3(4, 0, -1), Vec3(0, 4, -1)}};
  EXPECT_EQ(nearest_exactly({1, 1, 0}, triangles).which, 1U);
  EXPECT_EQ(nearest_exactly({1, 1, -0x1p-1074}, triangles).which, 2U);
}

TEST(ExactDistance, TheRadiusIsComparedExactly) {
  EXPECT_EQ(compare_distance({2, -3, 4}, right_angle, 5), std::strong_ordering::equal);
  EXPECT_EQ(compare_distance({2, -3, 4}, right_angle, std::nextafter(5, 0)), std::strong_ordering::greater);
  EXPECT_EQ(compare_distance({2, -3, 4}, right_angle, std::nextafter(5, 9)), std::strong_ordering::less);
  EXPECT_EQ(compare_distance({2, -3, 4}, right_angle, infinity), std::strong_ordering::less);
}

}  // namespace
}  // namespace touchmark::bench::oracle
