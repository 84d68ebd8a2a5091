#include "core/geometry/point_triangle.h"

#include <cmath>

#include <gtest/gtest.h>

namespace touchmark {
namespace {

double distance(const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& p) {
  return std::sqrt(squared_distance(prepare(a, b, c, 0), p));
}

const Vec3 a(0, 0, 0), b(4, 0, 0), c(0, 4, 0);

TEST(PointTriangle, OverTheFaceItIsTheHeight) {
  EXPECT_EQ(distance(a, b, c, {1, 1, 3}), 3);
  EXPECT_EQ(distance(a, b, c, {1, 1, -3}), 3);
}

TEST(PointTriangle, BesideAnEdgeItIsTheDistanceToTheEdge) { EXPECT_EQ(distance(a, b, c, {2, -3, 4}), 5); }

TEST(PointTriangle, BeyondACornerItIsTheDistanceToTheCorner) { EXPECT_EQ(distance(a, b, c, {-2, -1, 2}), 3); }

TEST(PointTriangle, OnTheTriangleItIsZero) {
  EXPECT_EQ(distance(a, b, c, {1, 1, 0}), 0);
  EXPECT_EQ(distance(a, b, c, {2, 0, 0}), 0);
  EXPECT_EQ(distance(a, b, c, b), 0);
}

TEST(PointTriangle, ANeedleOnWhichTheRegionMethodFails) {
  // Ericson's region method gives 0.7529 here.
  EXPECT_NEAR(distance({.76, -.46, .23}, {-.74, .54, .23}, {-.740000003, .539999997, .23}, {-.11, .12, -.41}),
              0.64, 1e-15);
}

TEST(PointTriangle, ZeroAreaIsASegmentOrAPoint) {
  EXPECT_EQ(distance({0, 0, 0}, {4, 0, 0}, {8, 0, 0}, {6, 3, 4}), 5);
  EXPECT_EQ(distance({1, 1, 1}, {1, 1, 1}, {1, 1, 1}, {1, 3, 1}), 2);
  EXPECT_EQ(distance({0, 0, 0}, {0, 0, 0}, {4, 0, 0}, {2, 0, 2}), 2);
}

TEST(PointTriangle, AFarOffsetCostsNothing) {
  const Vec3 far(1e6, -1e6, 1e6);
  EXPECT_EQ(distance(a + far, b + far, c + far, Vec3(1, 1, 3) + far), 3);
}

TEST(PointTriangle, TheOrderOfTheCornersDoesNotChangeTheEdgesDistance) {
  const Vec3 p(0.3, 0.1, -0.7), q(1.9, 0.77, 0.13), point(1.1, -0.4, 0.2);
  const double forward = squared_distance(prepare(p, q, Vec3(1, 5, 1), 0), point);
  EXPECT_EQ(forward, squared_distance(prepare(q, p, Vec3(2, 6, -1), 1), point));
}

TEST(PointTriangle, AnEdgeTooShortForItsDistanceIsNotContinuedTowardsThePoint) {
  const Vec3 p(-0.25132986622926817, -0.18260183637346161, -0.95611562806773853);
  const Vec3 q(-1.1647083184890926e-16, -3.7843667304341438e-17, -1);
  const Vec3 r(-9.9076007261709184e-17, -7.1982932780599651e-17, -1);
  const Vec3 point(30, -80, 50);
  EXPECT_NEAR(distance(p, q, r, point), (point - p).norm(), 1e-13);
}

TEST(PointTriangle, TheNormalOfAContactOnTheFaceIsTheFaces) {
  const Contact contact = contact_on(prepare(a, b, c, 0), {1, 1, 0}, 0);
  EXPECT_EQ(contact.distance, 0);
  EXPECT_EQ(contact.normal, Vec3(0, 0, 1));
}

TEST(PointTriangle, AContactOnAPointStillHasAUnitNormal) {
  EXPECT_EQ(contact_on(prepare(a, a, a, 0), a, 0).normal.norm(), 1);
  EXPECT_NEAR(contact_on(prepare(a, b, b, 0), a, 0).normal.norm(), 1, 1e-15);
}

}  // namespace
}  // namespace touchmark
