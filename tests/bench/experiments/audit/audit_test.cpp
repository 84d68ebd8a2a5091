/// The convex hull that audits tell cavities by, and the points that they ask at.
#include <algorithm>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "bench/experiments/audit/audit_points.h"
#include "bench/experiments/audit/convex_hull.h"
#include "bench/meshes/meshes.h"
#include "bench/support/random.h"

namespace touchmark::bench::experiments::audit {
namespace {

std::vector<Vec3> corners_of_a_box(const Vec3& half) {
  std::vector<Vec3> corners;
  for (int i = 0; i < 8; ++i)
    corners.push_back(
        {(i & 1 ? 1 : -1) * half.x(), (i & 2 ? 1 : -1) * half.y(), (i & 4 ? 1 : -1) * half.z()});
  return corners;
}

TEST(ConvexHull, OfABoxIsAsDeepAsTheNearestSide) {
  const Vec3 half(3, 2, 1);
  std::vector<Vec3> points = corners_of_a_box(half);
  support::Random random(7);
  for (int i = 0; i < 1000; ++i) points.push_back(random.point().cwiseProduct(half));  // within: no corners
  // A lattice on the sides: most points lie in a plane or on a line with others.
  for (int i = -4; i <= 4; ++i)
    for (int k = -4; k <= 4; ++k) points.push_back({3, i / 2.0, k / 4.0});
  const ConvexHull hull(points, 1e-6);
  for (int i = 0; i < 1000; ++i) {
    const Vec3 at = 1.5 * random.point().cwiseProduct(half);
    const Vec3 to_side = half - at.cwiseAbs();
    if (to_side.minCoeff() > 0) {
      EXPECT_NEAR(hull.depth(at), to_side.minCoeff(), 2e-6) << at.transpose();
    } else {  // no nearer than it says
      EXPECT_LT(hull.depth(at), to_side.minCoeff() + 2e-6) << at.transpose();
      EXPECT_GT(hull.depth(at), -to_side.cwiseMin(0).norm() - 2e-6) << at.transpose();
    }
  }
}

TEST(ConvexHull, HoldsAllPointsToWithinTheError) {
  const TriangleMesh torus = meshes::load_mesh("torus:40x30", false);
  for (const double error : {1e-3, 1e-5}) {
    const ConvexHull hull(torus.vertices(), error);
    ASSERT_FALSE(hull.empty());
    for (const Vec3& vertex : torus.vertices()) EXPECT_GE(hull.depth(vertex), -error);
    const Vec3 middle = 0.5 * (torus.bounds().min + torus.bounds().max);
    const double tube = 0.5 * (torus.bounds().max - torus.bounds().min).minCoeff();
    EXPECT_NEAR(hull.depth(middle), tube, error + 1e-3 * tube);  // flat lids over the hole
  }
}

TEST(ConvexHull, IsEmptyInAPlane) {
  std::vector<Vec3> square = corners_of_a_box({1, 1, 0});
  EXPECT_TRUE(ConvexHull(square, 1e-6).empty());
  EXPECT_LT(ConvexHull(square, 1e-6).depth({0, 0, 0}), 0);
  square.push_back({0, 0, 1e-3});
  EXPECT_FALSE(ConvexHull(square, 1e-6).empty());
}

TEST(AuditPoints, AreInEveryPlaceThatABodyHas) {
  const AuditLengths lengths{0.01, 0.002};
  const auto count = [&](const char* mesh, Place place) {
    const std::vector<AuditPoint> points = audit_points(meshes::load_mesh(mesh, true), lengths, 200, 1);
    return std::ranges::count(points, place, &AuditPoint::place);
  };
  for (const Place place : {Place::inside, Place::cavities, Place::near, Place::beyond})
    EXPECT_EQ(count("torus:40x30", place), 50) << name_of(place);
  EXPECT_EQ(count("icosphere:3", Place::cavities), 0);
  EXPECT_EQ(count("icosphere:3", Place::inside), 50);
}

TEST(AuditPoints, OfATorusAreWhereTheyAreSaidToBe) {
  const TriangleMesh torus = meshes::load_mesh("torus:80x60", true);
  const AuditLengths lengths{0.01, 0.002};
  const Vec3 size = torus.bounds().max - torus.bounds().min;
  int axis = 0;
  const double tube = 0.5 * size.minCoeff(&axis), ring = 0.5 * size.maxCoeff() - tube;
  for (const AuditPoint& point : audit_points(torus, lengths, 200, 3)) {
    Vec3 in_plane = point.center;
    in_plane[axis] = 0;
    const double away = std::hypot(in_plane.norm() - ring, point.center[axis]) - tube;
    EXPECT_NEAR(point.truth.high, std::abs(away), 0.002);  // facets for a tube
    if (point.place == Place::inside) {
      EXPECT_LT(away, 0.002);
    }
    if (point.place == Place::cavities) {
      EXPECT_TRUE(point.clear(lengths));
      EXPECT_LT(in_plane.norm(), ring + tube);
      EXPECT_LT(std::abs(point.center[axis]), tube);
    }
  }
}

}  // namespace
}  // namespace touchmark::bench::experiments::audit
