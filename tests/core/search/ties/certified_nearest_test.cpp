// Every exact detector against the oracle at thresholds where doubles do not tell: the radius is the distance
// or an ulp off it, the centre on the surface, the mesh degenerate, far away, tiny, huge.
#include "core/search/ties/certified_nearest.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "bench/oracle/oracle.h"
#include "core/aabb_tree/aabb_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "core/grid_group/grid_group.h"
#include "core/grid_group/published/published_grid_group.h"
#include "core/sphere_cluster/published/published_sphere_cluster.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/bench/oracle/corner_case_meshes.h"

namespace touchmark {
namespace {

std::vector<NamedMesh> meshes() {
  std::vector<NamedMesh> all = corner_case_meshes();
  CornerCases cases(70);
  std::vector<CornerCases::Corners> soup;
  for (int i = 0; i < 40; ++i) soup.push_back(i % 2 == 0 ? cases.plain() : cases.needle());
  for (const int exponent : {-1060, -500, -131, -100, 199, 230, 500, 1000})
    all.push_back(
        {"soup by 2^" + std::to_string(exponent),
         mesh_of(soup).transformed(1, Vec3::Zero()).transformed(std::ldexp(1.0, exponent), Vec3::Zero())});
  all.push_back({"ids of a file",
                 TriangleMesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 0}}, {{0, 1, 2}, {1, 3, 2}}, {7, 9})});
  return all;
}

std::uint64_t bits(double x) { return std::bit_cast<std::uint64_t>(x); }

bool same(const std::optional<Contact>& a, const std::optional<Contact>& b) {
  if (a.has_value() != b.has_value()) return false;
  if (!a) return true;
  bool equal = a->triangle == b->triangle && bits(a->distance) == bits(b->distance);
  for (int k = 0; k < 3; ++k)
    equal = equal && bits(a->point[k]) == bits(b->point[k]) && bits(a->normal[k]) == bits(b->normal[k]);
  return equal;
}

/// One mesh, probed where it is hard.
struct Exam {
  const NamedMesh& named;
  bench::oracle::Oracle oracle;
  BruteForce reference;
  std::vector<Vec3> points;
  std::vector<bench::oracle::GroundTruth> truths;

  explicit Exam(const NamedMesh& mesh, int count)
      : named(mesh), oracle(mesh.mesh), reference(BruteForce::build(mesh.mesh)) {
    CornerCases cases(71);
    points = corner_case_points(mesh.mesh, cases, count);
    for (const Vec3& point : points) truths.push_back(oracle.solve(point));
  }

  static std::vector<double> radii(double distance) {
    return {distance,
            std::nextafter(distance, 0.0),
            std::nextafter(distance, infinity),
            0,
            0.5 * distance,
            2 * distance,
            infinity};
  }

  template <class D>
  void examine(const D& detector, const std::string& form) const {
    EXPECT_TRUE(detector.accuracy().decides_exactly);
    typename D::Session used;
    for (std::size_t i = 0; i < points.size(); ++i) {
      if (!truths[i].defined || std::isinf(truths[i].high)) continue;
      for (const double radius : radii(truths[i].high)) {
        const std::string where =
            named.name + ", " + form + ", point " + std::to_string(i) + ", radius " + std::to_string(radius);
        const bool expected = oracle.within(truths[i], points[i], radius);
        typename D::Session fresh;
        ASSERT_EQ(detector.touches({points[i], radius}, fresh), expected) << where;
        ASSERT_EQ(detector.touches({points[i], radius}, used), expected) << where << ", used";
        const auto contact = detector.nearest({points[i], 0}, radius, used);
        ASSERT_EQ(contact.has_value(), expected) << where;
        BruteForce::Session plain;
        ASSERT_TRUE(same(contact, reference.nearest({points[i], 0}, radius, plain))) << where;
        if (!contact) continue;
        ASSERT_LE(contact->distance, radius) << where;
        const double error = std::abs((contact->distance - truths[i].high) - truths[i].low);
        ASSERT_LE(error, 16 * unit_roundoff * truths[i].largest_difference) << where;
      }
    }
  }
};

TEST(CertifiedNearest, BruteForceDecidesAsTheOracleDoes) {
  for (const NamedMesh& mesh : meshes()) Exam(mesh, 80).examine(BruteForce::build(mesh.mesh), "");
}

TEST(CertifiedNearest, AabbTreeDecidesAsTheOracleDoes) {
  for (const NamedMesh& mesh : meshes()) Exam(mesh, 80).examine(AabbTree::build(mesh.mesh), "");
}

TEST(CertifiedNearest, GridGroupDecidesAsTheOracleDoes) {
  using Shape = PublishedGridGroup::Shape;
  for (const NamedMesh& mesh : meshes()) {
    const Exam exam(mesh, 40);
    exam.examine(GridGroup::build(mesh.mesh), "direct");
    exam.examine(PublishedGridGroup::build(mesh.mesh), "scan cube");
    exam.examine(PublishedGridGroup::build(mesh.mesh, {.shape = Shape::sphere}), "scan sphere");
  }
}

TEST(CertifiedNearest, SphereClusterDecidesAsTheOracleDoes) {
  for (const NamedMesh& mesh : meshes()) {
    const Exam exam(mesh, 40);
    exam.examine(SphereCluster::build(mesh.mesh), "tree");
    exam.examine(SphereCluster::build(mesh.mesh, {.widest = Simd::portable}), "portable tree");
    exam.examine(PublishedSphereCluster::build(mesh.mesh), "scan");
  }
}

TEST(CertifiedNearest, AtTheVeryDistanceTheExactlyNearestOfManyIsFound) {
  CornerCases cases(72);
  std::vector<CornerCases::Corners> fan;
  const Vec3 tip = cases.vector();
  for (int i = 0; i < 50; ++i) fan.push_back({tip, tip + cases.vector(), tip + cases.vector()});
  const TriangleMesh mesh = mesh_of(fan);
  const bench::oracle::Oracle oracle(mesh);
  const AabbTree detector = AabbTree::build(mesh);
  AabbTree::Session session;
  for (int i = 0; i < 2000; ++i) {
    const auto& t = fan[cases.below(fan.size())];
    const Vec3 point = i % 2 == 0 ? Vec3(tip + cases.magnitude(-17, -14) * cases.vector())
                                  : cases.point_near({t[0], t[1], t[2]});
    const bench::oracle::GroundTruth truth = oracle.solve(point);
    const double reach = truth.low > 0 ? std::nextafter(truth.high, infinity) : truth.high;
    const auto contact = detector.nearest({point, 0}, reach, session);
    ASSERT_TRUE(contact);
    EXPECT_EQ(contact->triangle, truth.triangle) << i;
    EXPECT_NEAR(contact->distance, truth.high, 0x1p-52 * truth.high + 0x1p-59 * truth.largest_difference)
        << i;
  }
}

TEST(CertifiedNearest, OnTheSurfaceButForRoundingNeedsNoExactDecision) {
  const TriangleMesh mesh = plate(6);
  const AabbTree detector = AabbTree::build(mesh);
  AabbTree::Session session;
  for (const double height : {0.0, 0x1p-53, -0x1p-53}) {
    const auto contact = detector.nearest({{1.3, 2.4, height}, 0}, 0.5, session);
    ASSERT_TRUE(contact);
    EXPECT_NEAR(contact->distance, std::abs(height), 16 * unit_roundoff * 2.4);
  }
  detector.nearest({{1.3, 2.4, 1e-14}, 0}, 0.5, session);
  EXPECT_EQ(session.work.exact_decisions, 0U);
}

TEST(CertifiedNearest, ReachesAFaceAtExactlyItsDistance) {
  AabbTree::Session session;
  const AabbTree level = AabbTree::build(plate(6));
  EXPECT_TRUE(level.nearest({{1.3, 2.4, 1e-14}, 0}, 1e-14, session));
  EXPECT_FALSE(level.nearest({{1.3, 2.4, 1e-14}, 0}, std::nextafter(1e-14, 0), session));
  EXPECT_EQ(session.work.exact_decisions, 0U) << "that height is a coordinate";
  const AabbTree oblique = AabbTree::build(TriangleMesh({{0, 0, 0}, {8, 0, 6}, {0, 9, 0}}, {{0, 1, 2}}));
  EXPECT_TRUE(oblique.nearest({{-1, 2, 5.5}, 0}, 5, session));
  EXPECT_EQ(session.work.exact_decisions, 1U);
  EXPECT_FALSE(oblique.nearest({{-1, 2, 5.5}, 0}, std::nextafter(5, 0), session));
}

TEST(CertifiedNearest, AtTheSmallestHeightsOverABorderTheNormalIsTheFaces) {
  const AabbTree detector = AabbTree::build(plate(6));
  AabbTree::Session session;
  for (const double height : {5e-324, 1e-310, 1e-200, 1e-160}) {
    for (const double side : {1.0, -1.0}) {
      const auto contact = detector.nearest({{2.5, 2.5, side * height}, 0}, height, session);
      ASSERT_TRUE(contact) << height;
      EXPECT_EQ(contact->normal, Vec3(0, 0, side)) << height;
      EXPECT_EQ(contact->distance, height);
    }
  }
}

TEST(CertifiedNearest, OverABorderOfLevelFacesNamesTheFirstWithoutWholeNumbers) {
  const TriangleMesh mesh = plate(6);
  const AabbTree detector = AabbTree::build(mesh);
  const bench::oracle::Oracle oracle(mesh);
  AabbTree::Session session;
  for (int i = 1; i < 100; ++i) {
    const double x = 0.06 * i;
    for (const Vec3& center : {Vec3(x, x, 0.3), Vec3(x, 3, 0.3), Vec3(2, x, -0.7)}) {
      const auto contact = detector.nearest({center, 0}, 1, session);
      ASSERT_TRUE(contact);
      EXPECT_EQ(contact->triangle, oracle.solve(center).triangle) << i;
    }
  }
  EXPECT_EQ(session.work.exact_decisions, 0U);
}

/// Sheared, so that no point is exactly as far from two faces.
TriangleMesh lopsided_octasphere() {
  const TriangleMesh sphere = octasphere(12);
  std::vector<Vec3> vertices(sphere.vertices().begin(), sphere.vertices().end());
  for (Vec3& v : vertices) v += Vec3(0.3 * v.y(), 0.2 * v.z(), 0);
  return {std::move(vertices), {sphere.triangles().begin(), sphere.triangles().end()}};
}

TEST(CertifiedNearest, OnAnEdgeButForRoundingNeedsNoExactDecision) {
  const TriangleMesh mesh = lopsided_octasphere();
  const AabbTree detector = AabbTree::build(mesh);
  AabbTree::Session session;
  CornerCases cases(73);
  for (int i = 0; i < 10000; ++i) {
    const auto t = static_cast<std::uint32_t>(cases.below(mesh.size()));
    const double part = cases.fraction();
    const Vec3 point = (1 - part) * mesh.corner(t, 0) + part * mesh.corner(t, 1);
    const auto contact = detector.nearest({point, 0}, 0.5, session);
    ASSERT_TRUE(contact);
    ASSERT_LE(contact->distance, 16 * unit_roundoff) << i;
  }
  EXPECT_EQ(session.work.exact_decisions, 0U);
}

TEST(CertifiedNearest, AProbeThatSlidesNeedsNoExactDecision) {
  const TriangleMesh mesh = octasphere(12);
  const GridGroup detector = GridGroup::build(mesh);
  GridGroup::Session session;
  constexpr int steps = 20000;
  for (int i = 0; i < steps; ++i) {
    const double angle = 1e-3 * i;
    const Vec3 center = 1.003 * Vec3(std::cos(angle), std::sin(angle) * std::cos(0.1 * angle),
                                     std::sin(angle) * std::sin(0.1 * angle));
    detector.nearest({center, 0}, 0.01, session);
    detector.touches({center, 0.005}, session);
  }
  EXPECT_LE(session.work.exact_decisions, 2U * steps / 10000);
}

template <class D>
void expect_decisions_within_rounding(const typename D::Options& uncertified_options) {
  const TriangleMesh mesh = octasphere(12);
  const bench::oracle::Oracle oracle(mesh);
  const D detector = D::build(mesh, uncertified_options);
  EXPECT_FALSE(detector.accuracy().decides_exactly);
  typename D::Session session;
  CornerCases cases(74);
  for (const Vec3& point : corner_case_points(mesh, cases, 200)) {
    const bench::oracle::GroundTruth truth = oracle.solve(point);
    const double error = detector.accuracy().relative * truth.largest_difference;
    for (const double off : {-2.0, -1.0, 0.0, 1.0, 2.0}) {
      const double radius = truth.high + off * error;
      if (radius < 0) continue;
      const bool touches = detector.touches({point, radius}, session);
      const auto contact = detector.nearest({point, 0}, radius, session);
      if (off > 1) {
        EXPECT_TRUE(touches && contact);
      }
      if (off < -1) {
        EXPECT_FALSE(touches || contact);
      }
    }
  }
}

TEST(CertifiedNearest, WithoutCertificationDoublesDecideWithinTheirRounding) {
  expect_decisions_within_rounding<AabbTree>({.certified = false});
  expect_decisions_within_rounding<GridGroup>({.certified = false});
  expect_decisions_within_rounding<SphereCluster>({.certified = false});
}

TEST(CertifiedNearest, TheErrorsBoundIsInfiniteWhereTheKernelLeavesTheRangeOfDouble) {
  EXPECT_EQ(distance_error(1), 256 * unit_roundoff + 0x1p-200);
  for (const double beyond : {0.0, 1e-60, 1e90, infinity, std::numeric_limits<double>::quiet_NaN()})
    EXPECT_EQ(distance_error(beyond), infinity) << beyond;
}

}  // namespace
}  // namespace touchmark
