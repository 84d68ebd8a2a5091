/// Each scheme against cases worked out by hand or from its theory.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <vector>

#include <gtest/gtest.h>

#include "core/subdivision/algebraic_sphere.h"
#include "core/subdivision/subdivision.h"
#include "tests/core/subdivision/meshes.h"

namespace touchmark {
namespace {

using enum SubdivisionMethod;
using enum SubdivisionForm;

using test::once;

/// Is there a vertex within 1e-14 of each of these?
void expect_vertices(const TriangleMesh& mesh, const std::vector<Vec3>& expected) {
  for (const Vec3& e : expected) {
    const bool there =
        std::ranges::any_of(mesh.vertices(), [&](const Vec3& v) { return (v - e).norm() < 1e-14; });
    EXPECT_TRUE(there) << "no vertex at " << e.transpose();
  }
}

TEST(Loop, OfAnOctahedron) {
  // Valence 4: beta = (5/8 - 9/64) / 4, so a vertex keeps 1 - 4 beta = 33/64 and its ring cancels.
  const TriangleMesh mesh = once(test::octahedron(), loop);
  ASSERT_EQ(mesh.size(), 32u);
  ASSERT_EQ(mesh.vertices().size(), 18u);
  EXPECT_NEAR((mesh.vertices()[0] - Vec3(33. / 64, 0, 0)).norm(), 0, 1e-15);
  expect_vertices(mesh, {{3. / 8, 3. / 8, 0}, {0, -3. / 8, 3. / 8}});
}

TEST(Loop, OfATetrahedron) {
  // Valence 3: 7/16 v + 3/16 (-v) = v/4; an edge 3/8 (a + b) + 1/8 (-(a + b)) = (a + b)/4.
  const TriangleMesh mesh = once(test::tetrahedron(), loop);
  EXPECT_NEAR((mesh.vertices()[0] - Vec3(.25, .25, .25)).norm(), 0, 1e-15);
  expect_vertices(mesh, {{.5, 0, 0}, {0, 0, -.5}});
}

TEST(Loop, MakesABoundaryACubicSpline) {
  const TriangleMesh mesh = once(TriangleMesh({{0, 0, 0}, {8, 0, 0}, {0, 8, 8}}, {{0, 1, 2}}), loop);
  EXPECT_NEAR((mesh.vertices()[0] - Vec3(1, 1, 1)).norm(), 0, 1e-15);
  expect_vertices(mesh, {{4, 0, 0}, {4, 4, 4}});
}

TEST(CatmullClark, OfAnOctahedron) {
  // Face points at 1/3 each; an edge ((1,1,0) + 2 (1/3,1/3,0)) / 4; a vertex (1/3 + 2/2 + (4 - 3)) / 4.
  const TriangleMesh mesh = once(test::octahedron(), catmull_clark);
  ASSERT_EQ(mesh.size(), 48u);
  ASSERT_EQ(mesh.vertices().size(), 26u);
  EXPECT_NEAR((mesh.vertices()[0] - Vec3(7. / 12, 0, 0)).norm(), 0, 1e-15);
  expect_vertices(mesh, {{1. / 3, -1. / 3, 1. / 3}, {5. / 12, 5. / 12, 0}});
}

TEST(CatmullClark, MakesABoundaryACubicSpline) {
  const TriangleMesh mesh = once(TriangleMesh({{0, 0, 0}, {8, 0, 0}, {0, 8, 8}}, {{0, 1, 2}}), catmull_clark);
  ASSERT_EQ(mesh.size(), 6u);
  EXPECT_NEAR((mesh.vertices()[0] - Vec3(1, 1, 1)).norm(), 0, 1e-15);
  expect_vertices(mesh, {{4, 0, 0}, {4, 4, 4}, {8. / 3, 8. / 3, 8. / 3}});
}

TEST(CatmullClarkLinear, CutsATriangleInSixAndThenEachQuadrilateralInEight) {
  const TriangleMesh coarse({{0, 0, 0}, {6, 0, 0}, {0, 6, 0}}, {{0, 1, 2}});
  const TriangleMesh mesh = once(coarse, catmull_clark_linear);
  ASSERT_EQ(mesh.size(), 6u);
  expect_vertices(mesh, {{0, 0, 0}, {6, 0, 0}, {0, 6, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {2, 2, 0}});
  EXPECT_EQ(subdivide(coarse, {.method = catmull_clark_linear, .levels = 2}).size(), 24u);
  EXPECT_EQ(subdivide(coarse, {.method = catmull_clark_linear, .levels = 3}).size(), 96u);
}

TEST(CatmullClark, IsSmoothInTheToolsFormToo) {
  const TriangleMesh mesh = once(test::octahedron(), catmull_clark, meshlab);
  EXPECT_EQ(mesh.vertices()[0], Vec3(static_cast<float>(7. / 12), 0, 0));
}

TEST(MidPoint, HalvesTheEdges) {
  const TriangleMesh mesh = once(test::octahedron(), mid_point);
  ASSERT_EQ(mesh.size(), 32u);
  ASSERT_EQ(mesh.vertices().size(), 18u);
  expect_vertices(mesh, {{1, 0, 0}, {.5, .5, 0}, {0, -.5, .5}});
}

TEST(Butterfly, OfAnOctahedronByItsValences) {
  // Valence 4 at both ends a, b: 3/4 a + 3/8 b - 1/8 (-b) = 3/4 a + 1/2 b, and the mean with its mirror
  // image.
  expect_vertices(once(test::octahedron(), butterfly), {{1, 0, 0}, {.625, .625, 0}, {0, -.625, .625}});
}

TEST(Butterfly, OfAnOctahedronByEightPoints) {
  // Ends a, b; apexes c, -c; each wing is beyond an edge a-c: -b twice, -a twice. 1/2 + 2/16 = 5/8.
  expect_vertices(once(test::octahedron(), butterfly, meshlab), {{1, 0, 0}, {.625, .625, 0}});
}

TEST(Butterfly, OfATetrahedronByItsValences) {
  // Valence 3 at both ends: 3/4 a + 5/12 b - 1/12 (c + d), c + d = -(a + b): 5/6 a + 1/2 b; the mean 2/3 (a +
  // b).
  expect_vertices(once(test::tetrahedron(), butterfly), {{4. / 3, 0, 0}, {0, 0, -4. / 3}});
}

double cubic(double x, double y) {
  return 1 + 2 * x - y + .3 * x * x - .7 * x * y + .2 * y * y + .05 * x * x * x - .11 * x * x * y +
         .07 * x * y * y - .02 * y * y * y;
}

TEST(Butterfly, ReproducesCubicsInsideARegularGrid) {
  constexpr std::uint32_t n = 9;
  const TriangleMesh coarse =
      test::grid(n, [](double i, double j) { return Vec3(i - 4, j - 4, cubic(i - 4, j - 4)); });
  const TriangleMesh mesh = once(coarse, butterfly);
  std::size_t inside = 0;
  for (const Vec3& v : mesh.vertices().subspan(n * n)) {
    if (std::abs(v.x()) > 2 || std::abs(v.y()) > 2) continue;
    EXPECT_NEAR(v.z(), cubic(v.x(), v.y()), 1e-13);
    ++inside;
  }
  EXPECT_EQ(inside, 56u);  // 4 x 5 edges each way and 4 x 4 diagonals
}

TEST(Butterfly, ReproducesCubicsAlongAStraightBoundary) {
  constexpr std::uint32_t n = 9;
  const auto place = [](double i, double j) { return Vec3(i - 4, j - 4, cubic(i - 4, j - 4)); };
  const TriangleMesh mesh = once(test::grid(n, place), butterfly);
  std::size_t along = 0;
  for (const Vec3& v : mesh.vertices().subspan(n * n)) {
    if (v.y() != -4 || std::abs(v.x()) > 3) continue;
    EXPECT_NEAR(v.z(), cubic(v.x(), v.y()), 1e-13);
    ++along;
  }
  EXPECT_EQ(along, 6u);
}

TEST(Butterfly, ReproducesPlanesUpToTheBoundaryOfARegularGrid) {
  const auto place = [](double i, double j) { return Vec3(i, j, 3 * i - 2 * j); };
  const TriangleMesh mesh = once(test::grid(5, place), butterfly);
  for (const Vec3& v : mesh.vertices().subspan(25)) EXPECT_NEAR(v.z(), 3 * v.x() - 2 * v.y(), 1e-14);
}

/// An extraordinary vertex 0 with k triangles over `angle`, and a second ring that makes those of its
/// neighbours regular that are not at the ends of an open fan... and those too.
TriangleMesh two_rings(std::uint32_t k, double angle, bool whole) {
  std::vector<Vec3> vertices = {{0, 0, 0}};
  const auto on_circle = [&](double radius, double part) {
    vertices.emplace_back(radius * std::cos(angle * part), radius * std::sin(angle * part), 0);
  };
  const std::uint32_t inner = whole ? k : k + 1, outer = whole ? 2 * k : 2 * k + 1;
  for (std::uint32_t j = 0; j < inner; ++j) on_circle(1, static_cast<double>(j) / k);
  for (std::uint32_t j = 0; j < outer; ++j) on_circle(2, j / (2. * k));
  std::vector<TriangleMesh::Corners> triangles;
  for (std::uint32_t j = 0; j < k; ++j) {
    const std::uint32_t a = 1 + j, b = 1 + (j + 1) % inner, first = 1 + inner;
    const std::uint32_t p = first + 2 * j, q = first + 2 * j + 1, r = first + (2 * j + 2) % outer;
    triangles.push_back({0, a, b});
    triangles.push_back({a, p, q});
    triangles.push_back({a, q, b});
    triangles.push_back({b, q, r});
  }
  return TriangleMesh(std::move(vertices), std::move(triangles));
}

TEST(Butterfly, HalvesTheRingOfAnExtraordinaryVertex) {
  // The rules are made so that the scheme's tangent plane is regular: (cos, sin) around the vertex is an
  // eigenvector to the eigenvalue 1/2.
  for (const std::uint32_t k : {3u, 4u, 5u, 7u, 8u, 12u}) {
    const TriangleMesh mesh = once(two_rings(k, 2 * std::numbers::pi, true), butterfly);
    for (std::uint32_t j = 0; j < k; ++j) {
      const double angle = 2 * std::numbers::pi * j / k;
      expect_vertices(mesh, {{std::cos(angle) / 2, std::sin(angle) / 2, 0}});
    }
  }
}

TEST(Butterfly, HalvesTheFanOfAnExtraordinaryBoundaryVertex) {
  for (const std::uint32_t k : {2u, 4u, 5u, 6u, 9u}) {
    const TriangleMesh mesh = once(two_rings(k, std::numbers::pi, false), butterfly);
    for (std::uint32_t j = 1; j < k; ++j) {
      const double angle = std::numbers::pi * j / k;
      expect_vertices(mesh, {{std::cos(angle) / 2, std::sin(angle) / 2, 0}});
    }
  }
}

TEST(Ls3, FitsTheSphereThatItsPointsAndNormalsAreOn) {
  test::Noise noise(3);
  for (const double radius : {0.5, 1e3, -2.}) {  // negative: normals inwards
    const Vec3 center = 10 * noise.vector();
    AlgebraicSphereFit fit;
    for (int i = 0; i < 7; ++i) {
      const Vec3 n = (Vec3(0, 0, 1) + 0.4 * noise.vector()).normalized();
      fit.add(center + radius * n, n, 0.1 + i);
    }
    const auto [point, gradient] = fit.mean_on_sphere();
    EXPECT_NEAR((point - center).norm(), std::abs(radius), 1e-13 * (10 + std::abs(radius)));
    EXPECT_GT(gradient.dot(point - center) * radius, 0);
  }
}

TEST(Ls3, FitsAPlaneToPointsWithOneNormal) {
  AlgebraicSphereFit fit;
  fit.add({0, 0, 1}, {0, 0, 1}, 1);
  fit.add({1, 0, 1}, {0, 0, 1}, 2);
  fit.add({0, 1, 1}, {0, 0, 1}, 1);
  EXPECT_EQ(fit.mean_on_sphere().point, Vec3(.5, .25, 1));
  EXPECT_EQ(fit.mean_on_sphere().gradient, Vec3(0, 0, 1));
}

TEST(Ls3, StaysAtTheMeanWhereTheNormalsCancel) {
  AlgebraicSphereFit fit;
  fit.add({0, 0, 0}, {0, 0, 1}, 1);
  fit.add({1, 0, 0}, {0, 0, -1}, 1);
  EXPECT_EQ(fit.mean_on_sphere().point, Vec3(.5, 0, 0));
}

TEST(Ls3, KeepsAPlane) {
  const TriangleMesh flat = test::grid(4, [](double i, double j) { return Vec3(i, j + 0.3 * i, 7); });
  for (const SubdivisionForm form : {published, meshlab}) {
    const TriangleMesh mesh = subdivide(flat, {.method = ls3, .levels = 3, .form = form});
    for (const Vec3& v : mesh.vertices()) EXPECT_EQ(v.z(), 7);
  }
}

}  // namespace
}  // namespace touchmark
