/// Where a mesh is open or contradicts itself: decided only where that is clear.
#include <array>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/sign/open_edges.h"
#include "tests/core/sign/closed_meshes.h"
#include "tests/core/sign/side_at.h"

namespace touchmark {
namespace {

using test::side_at, test::SignedBruteForce;
using Method = SideFinder::Method;

/// Without the triangles whose corners all lie below this height.
TriangleMesh cut_off(const TriangleMesh& mesh, double height) {
  std::vector<TriangleMesh::Corners> kept;
  for (std::uint32_t t = 0; t < mesh.size(); ++t) {
    if (std::max({mesh.corner(t, 0).z(), mesh.corner(t, 1).z(), mesh.corner(t, 2).z()}) >= height)
      kept.push_back(mesh.triangles()[t]);
  }
  return {{mesh.vertices().begin(), mesh.vertices().end()}, std::move(kept)};
}

TriangleMesh moebius_strip(std::uint32_t parts) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  for (std::uint32_t i = 0; i < parts; ++i) {
    const double turn = 2 * std::numbers::pi * i / parts;
    const Vec3 out(std::cos(turn), std::sin(turn), 0);
    const Vec3 across = std::cos(turn / 2) * out + std::sin(turn / 2) * Vec3::UnitZ();
    vertices.push_back(out + 0.4 * across);
    vertices.push_back(out - 0.4 * across);
  }
  for (std::uint32_t i = 0; i < parts; ++i) {
    const bool last = i + 1 == parts;  // joined upside down
    const std::uint32_t a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    triangles.push_back({a, b, c});
    triangles.push_back({b, d, c});
  }
  return {std::move(vertices), std::move(triangles)};
}

/// The share of all directions that the triangles cover, one by one (van Oosterom & Strackee).
double plain_winding_number(const TriangleMesh& mesh, const Vec3& p) {
  double sum = 0;
  for (std::uint32_t t = 0; t < mesh.size(); ++t) {
    const Vec3 a = mesh.corner(t, 0) - p, b = mesh.corner(t, 1) - p, c = mesh.corner(t, 2) - p;
    const double la = a.norm(), lb = b.norm(), lc = c.norm();
    sum += 2 * std::atan2(a.dot(b.cross(c)), la * lb * lc + a.dot(b) * lc + b.dot(c) * la + c.dot(a) * lb);
  }
  return sum / (4 * std::numbers::pi);
}

sign::Winding winding_of(const TriangleMesh& mesh) {
  const IndexedTriangles welded = weld(mesh);
  std::vector<std::array<Vec3, 2>> ends;
  const EdgeMap<3> edges(welded.faces, welded.positions.size());
  for (const auto& [from, to] : sign::open_edges(welded, edges).edges)
    ends.push_back({welded.positions[from], welded.positions[to]});
  return {mesh, std::move(ends)};
}

TEST(OpenMeshes, ARayAndItsCurtainsGiveTheWindingNumberOfAllTriangles) {
  bench::support::Random random(4);
  for (const TriangleMesh& mesh :
       {bench::meshes::icosphere(2), cut_off(bench::meshes::icosphere(2), 0.1),
        bench::meshes::single_triangle(), bench::meshes::soup(50), cut_off(bench::meshes::torus(12, 8), 0)}) {
    const sign::Winding winding = winding_of(mesh);
    for (int i = 0; i < 500; ++i) {
      const Vec3 point = mesh.bounds().center() + random.unit() * mesh.diagonal() * random.direction();
      const auto curtains = winding.of_curtains(point);
      EXPECT_NEAR(winding.count(point).value() - curtains.value, plain_winding_number(mesh, point),
                  curtains.error + 1e-12);
      EXPECT_LT(curtains.error, 1e-9);
    }
  }
}

TEST(OpenMeshes, ABallWithASmallHoleIsDecidedAwayFromTheHoleAndNeverWrongly) {
  const TriangleMesh ball = bench::meshes::icosphere(3), open = cut_off(ball, -0.94);
  const SignedBruteForce whole = SignedBruteForce::build(ball, {}), holed = SignedBruteForce::build(open, {});
  ASSERT_EQ(holed.sides().surface().method, Method::winding_number);
  bench::support::Random random(5);
  int decided = 0;
  constexpr int count = 1000;
  for (int i = 0; i < count; ++i) {
    const Vec3 point = random.between(0.2, 2.0) * random.direction();
    const Side side = side_at(holed, point);
    if (side == Side::undecided) continue;
    EXPECT_EQ(side, side_at(whole, point)) << point.transpose();
    ++decided;
  }
  EXPECT_GT(decided, count * 3 / 4);
}

TEST(OpenMeshes, NothingIsDecidedInTheMouthOfAHemisphere) {
  const SignedBruteForce bowl = SignedBruteForce::build(cut_off(bench::meshes::icosphere(3), 0.05), {});
  bench::support::Random random(6);
  for (int i = 0; i < 500; ++i) {
    const double radius = 0.95 * std::sqrt(random.unit());
    const Vec3 flat = random.direction();
    const Vec3 point =
        radius * Vec3(flat.x(), flat.y(), 0).normalized() + random.between(-0.3, 0.3) * Vec3::UnitZ();
    EXPECT_EQ(side_at(bowl, point), Side::undecided) << point.transpose();
  }
}

TEST(OpenMeshes, AMoebiusStripIsUndecidedEverywhereButOnItself) {
  const SignedBruteForce strip = SignedBruteForce::build(moebius_strip(24), {});
  ASSERT_EQ(strip.sides().surface().method, Method::none);
  bench::support::Random random(7);
  for (int i = 0; i < 300; ++i)
    EXPECT_EQ(side_at(strip, 2 * random.direction() * random.unit()), Side::undecided);
  EXPECT_EQ(side_at(strip, {1.4, 0, 0}), Side::on_surface);  // its first vertex
}

TEST(OpenMeshes, APatchTurnedOverLeavesAllUndecided) {
  const TriangleMesh ball = bench::meshes::icosphere(2);
  std::vector<TriangleMesh::Corners> triangles(ball.triangles().begin(), ball.triangles().end());
  for (std::size_t t = 0; t < triangles.size() / 2; ++t) std::swap(triangles[t][1], triangles[t][2]);
  const SignedBruteForce detector =
      SignedBruteForce::build({{ball.vertices().begin(), ball.vertices().end()}, triangles}, {});
  ASSERT_GT(detector.sides().surface().contrary_edges, 0u);
  bench::support::Random random(8);
  for (int i = 0; i < 300; ++i)
    EXPECT_EQ(side_at(detector, 2 * random.unit() * random.direction()), Side::undecided);
}

TEST(OpenMeshes, NothingIsInsideASoup) {
  const TriangleMesh soup = bench::meshes::soup(200);
  const SignedBruteForce detector = SignedBruteForce::build(soup, {});
  bench::support::Random random(9);
  for (const Vec3& point : telling_points(soup, random, 60))
    EXPECT_NE(side_at(detector, point), Side::inside) << point.transpose();
}

TEST(OpenMeshes, NothingIsDecidedJustBesideASheet) {
  const SignedBruteForce sheet = SignedBruteForce::build(bench::meshes::single_triangle(), {});
  for (const double height : {1e-12, 1e-6, 0.1}) {
    EXPECT_EQ(side_at(sheet, {0, 0, height}), Side::undecided);
    EXPECT_EQ(side_at(sheet, {0, 0, -height}), Side::undecided);
  }
  EXPECT_EQ(side_at(sheet, {0, 0, 0}), Side::on_surface);
}

}  // namespace
}  // namespace touchmark
