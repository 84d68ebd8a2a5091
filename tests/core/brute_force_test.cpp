#include "core/brute_force/brute_force.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/float_limits.h"
#include "core/geometry/sphere_triangle_sweep.h"

namespace touchmark {
namespace {

static_assert(AnswersTouches<BruteForce> && AnswersNearest<BruteForce> && AnswersSweep<BruteForce>);

TriangleMesh two_triangles() {
  return TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}});
}

TEST(BruteForce, FindsTheTriangleBelowTheProbe) {
  const BruteForce detector = BruteForce::build(two_triangles());
  BruteForce::Session session;
  const auto contact = detector.nearest({{0.75, 0.75, 2}, 0}, infinity, session);
  ASSERT_TRUE(contact);
  EXPECT_EQ(contact->triangle, 1u);
  EXPECT_EQ(contact->distance, 2);
  EXPECT_EQ(contact->normal, Vec3(0, 0, 1));
  EXPECT_EQ(contact->point, Vec3(0.75, 0.75, 0));
}

TEST(BruteForce, GivesTheLowestIdOnASharedEdge) {
  const BruteForce detector = BruteForce::build(two_triangles());
  BruteForce::Session session;
  EXPECT_EQ(detector.nearest({{0.5, 0.5, 0.25}, 0}, infinity, session)->triangle, 0u);
}

TEST(BruteForce, ContactIsClosed) {
  const BruteForce detector = BruteForce::build(two_triangles());
  BruteForce::Session session;
  EXPECT_TRUE(detector.touches({{0.25, 0.25, 0.5}, 0.5}, session));
  EXPECT_FALSE(detector.touches({{0.25, 0.25, 0.5}, std::nextafter(0.5, 0)}, session));
}

TEST(BruteForce, FindsNothingBeyondTheReach) {
  const BruteForce detector = BruteForce::build(two_triangles());
  BruteForce::Session session;
  EXPECT_TRUE(detector.nearest({{0.25, 0.25, 0.5}, 0}, 0.5, session));
  EXPECT_FALSE(detector.nearest({{0.25, 0.25, 0.5}, 0}, 0.49, session));
}

TEST(BruteForce, LooksAtEveryTriangle) {
  const BruteForce detector = BruteForce::build(two_triangles());
  BruteForce::Session session;
  detector.nearest({{0.25, 0.25, 0.5}, 0}, 1, session);
  EXPECT_EQ(session.work.triangles, 2u);
}

TEST(BruteForce, ReportsTheIdsOfTheFile) {
  const BruteForce detector = BruteForce::build(
      TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}, {7, 7}));
  BruteForce::Session session;
  EXPECT_EQ(detector.nearest({{0.75, 0.75, 2}, 0}, infinity, session)->triangle, 7u);
}

TEST(BruteForce, AProbeThatIsNotANumberTouchesNothing) {
  const BruteForce detector = BruteForce::build(two_triangles());
  BruteForce::Session session;
  const Vec3 nan = Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
  EXPECT_FALSE(detector.nearest({nan, 1}, infinity, session));
  EXPECT_FALSE(detector.touches({nan, 1}, session));
  // The largest of several differences forgets a NaN that is not the first of them.
  for (int axis = 0; axis < 3; ++axis) {
    Vec3 center(5, 5, 5);
    center[axis] = std::numeric_limits<double>::quiet_NaN();
    for (const double radius : {1.0, 1e300, infinity})
      EXPECT_FALSE(detector.touches({center, radius}, session));
  }
}

TEST(BruteForce, ASweepStopsAtTheFirstOfTwoLayers) {
  const BruteForce detector = BruteForce::build(TriangleMesh(
      {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 1}, {4, 0, 1}, {0, 4, 1}}, {{0, 1, 2}, {3, 4, 5}}));
  BruteForce::Session session;
  const auto impact = detector.first_hit({{1, 1, 5}, {1, 1, -3}, 0.5}, session);
  ASSERT_TRUE(impact);
  EXPECT_EQ(impact->contact.triangle, 1u);
  EXPECT_LE(impact->fraction, 3.5 / 8);
  EXPECT_GE(impact->fraction, 3.5 / 8 - 0x1p-50);
  EXPECT_NEAR(impact->contact.distance, 0.5, 1e-12);
}

TEST(BruteForce, ASweepThatStartsTouchingGivesTheNearestTriangleThere) {
  const BruteForce detector = BruteForce::build(TriangleMesh(
      {{0, 0, 0}, {4, 0, 0}, {0, 4, 0}, {0, 0, 1}, {4, 0, 1}, {0, 4, 1}}, {{0, 1, 2}, {3, 4, 5}}));
  BruteForce::Session session;
  const auto impact = detector.first_hit({{1, 1, 0.75}, {1, 1, -3}, 2}, session);
  ASSERT_TRUE(impact);
  EXPECT_EQ(impact->fraction, 0);
  EXPECT_EQ(impact->contact.triangle, 1u);
  EXPECT_EQ(impact->contact.distance, 0.25);
}

}  // namespace
}  // namespace touchmark
