/// What subdivision accepts, and what it says about the rest.
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/subdivision/mesh_measures.h"
#include "core/subdivision/subdivision.h"
#include "tests/core/subdivision/meshes.h"

namespace touchmark {
namespace {

using enum SubdivisionMethod;

using test::all_methods, test::once;

/// What it throws, or nothing.
template <typename Error>
std::string message(const TriangleMesh& mesh, const SubdivisionOptions& options) {
  try {
    subdivide(mesh, options);
  } catch (const Error& error) {
    return error.what();
  }
  return {};
}

bool contains(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

bool has_vertex(const TriangleMesh& mesh, const Vec3& place) {
  return std::ranges::any_of(mesh.vertices(), [&](const Vec3& v) { return (v - place).norm() < 1e-15; });
}

/// Three triangles on the edge of vertices 1 and 2; vertex 0 is not used.
TriangleMesh book() {
  return TriangleMesh({{9, 9, 9}, {0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}},
                      {{1, 2, 3}, {2, 1, 4}, {1, 2, 5}});
}

TEST(SubdivisionInput, SplitsAnEdgeOfThreeTrianglesInTheMiddle) {
  for (const SubdivisionMethod method : all_methods) {
    const TriangleMesh mesh = once(book(), method);
    EXPECT_EQ(mesh.size(), method == catmull_clark || method == catmull_clark_linear ? 18u : 12u);
    EXPECT_EQ(mesh.vertices()[0], Vec3(0, 0, 0)) << name_of(method);
    EXPECT_EQ(mesh.vertices()[1], Vec3(0, 0, 1)) << name_of(method);
    EXPECT_TRUE(has_vertex(mesh, {0, 0, .5})) << name_of(method);
    EXPECT_EQ(edge_statistics(mesh).seams, 2u) << name_of(method);
    EXPECT_EQ(edge_statistics(mesh).boundary, 12u) << name_of(method);
  }
}

TEST(SubdivisionInput, SplitsAnEdgeBetweenDifferentOrientationsInTheMiddle) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 1, 1}}, {{0, 1, 2}, {1, 2, 3}});
  for (const SubdivisionMethod method : all_methods) {
    const TriangleMesh result = once(mesh, method);
    EXPECT_EQ(result.vertices()[1], Vec3(1, 0, 0)) << name_of(method);
    EXPECT_EQ(result.vertices()[2], Vec3(0, 1, 0)) << name_of(method);
    EXPECT_TRUE(has_vertex(result, {.5, .5, 0})) << name_of(method);
  }
}

TEST(SubdivisionInput, KeepsAVertexOfTwoFans) {
  const TriangleMesh mesh({{1, 0, 0}, {1, 1, 0}, {0, 0, 0}, {-1, 0, 0}, {-1, -1, 1}}, {{0, 1, 2}, {3, 4, 2}});
  for (const SubdivisionMethod method : all_methods)
    EXPECT_EQ(once(mesh, method).vertices()[2], Vec3(0, 0, 0));
}

TEST(SubdivisionInput, KeepsAVertexOfTwoClosedFans) {
  // Two tetrahedra tip to tip, one larger than the other.
  const TriangleMesh mesh(
      {{0, 0, 0}, {1, 0, 1}, {-1, 1, 1}, {-1, -1, 1}, {2, 0, -2}, {-2, 2, -2}, {-2, -2, -2}},
      {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3}, {0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {4, 6, 5}});
  for (const SubdivisionMethod method : all_methods) {
    const TriangleMesh result = subdivide(mesh, {.method = method, .levels = 2});
    EXPECT_EQ(result.vertices()[0], Vec3(0, 0, 0)) << name_of(method);
    EXPECT_TRUE(edge_statistics(result).closed()) << name_of(method);
  }
}

/// A Möbius strip of n quadrilaterals: one boundary, no orientation.
TriangleMesh moebius_strip(std::uint32_t n) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  for (std::uint32_t i = 0; i < n; ++i) {
    const double turn = 2 * std::numbers::pi * i / n;
    for (const double side : {-0.3, 0.3}) {
      const double radius = 1 + side * std::cos(turn / 2);
      vertices.emplace_back(radius * std::cos(turn), radius * std::sin(turn), side * std::sin(turn / 2));
    }
  }
  for (std::uint32_t i = 0; i < n; ++i) {
    const bool last = i + 1 == n;
    const std::uint32_t a = 2 * i, b = a + 1, c = last ? 1 : a + 2, d = last ? 0 : a + 3;
    triangles.push_back({a, c, b});
    triangles.push_back({b, c, d});
  }
  return TriangleMesh(std::move(vertices), std::move(triangles));
}

TEST(SubdivisionInput, TakesASurfaceWithoutOrientation) {
  // It goes wrong across one edge, which is the seam.
  ASSERT_EQ(edge_statistics(moebius_strip(12)).seams, 1u);
  for (const SubdivisionMethod method : all_methods) {
    const TriangleMesh mesh = subdivide(moebius_strip(12), {.method = method, .levels = 2});
    EXPECT_EQ(edge_statistics(mesh).seams, 4u) << name_of(method);
    EXPECT_EQ(edge_statistics(mesh).boundary, 4 * 24u) << name_of(method);
  }
}

TEST(SubdivisionInput, WeldsASoupToTheMeshItIs) {
  const TriangleMesh whole = test::octahedron();
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  for (std::uint32_t t = 0; t < whole.size(); ++t) {
    for (int i = 0; i < 3; ++i) vertices.push_back(whole.corner(t, i));
    triangles.push_back({3 * t, 3 * t + 1, 3 * t + 2});
  }
  vertices[4].z() = -0.;  // equal to 0, and so the same place
  const TriangleMesh soup(std::move(vertices), std::move(triangles));
  for (const SubdivisionMethod method :
       {butterfly, catmull_clark, catmull_clark_linear, mid_point, loop, ls3}) {
    const TriangleMesh expected = once(whole, method), mesh = once(soup, method);
    ASSERT_EQ(mesh.size(), expected.size());
    ASSERT_EQ(mesh.vertices().size(), expected.vertices().size());
    for (std::size_t t = 0; t < mesh.size(); ++t)
      for (int i = 0; i < 3; ++i) EXPECT_NEAR((mesh.corner(t, i) - expected.corner(t, i)).norm(), 0, 1e-15);
  }
}

TEST(SubdivisionInput, LeavesOutTrianglesWithTwoCornersInOnePlace) {
  // A collapsed triangle on an inner edge would make it an edge of three.
  const TriangleMesh whole = test::octahedron();
  std::vector<TriangleMesh::Corners> triangles(whole.triangles().begin(), whole.triangles().end());
  triangles.insert(triangles.begin(), {0, 2, 2});
  const TriangleMesh mesh({whole.vertices().begin(), whole.vertices().end()}, std::move(triangles));
  const TriangleMesh expected = once(whole, loop), result = once(mesh, loop);
  EXPECT_TRUE(std::ranges::equal(result.vertices(), expected.vertices()));
  EXPECT_TRUE(std::ranges::equal(result.triangles(), expected.triangles()));
}

TEST(SubdivisionInput, KeepsTrianglesWithoutAreaThatHaveNeighbours) {
  // Vertex 4 sits on the edge 1-2: the triangle 1, 4, 2 is flat.
  const TriangleMesh mesh({{0, 0, 0}, {2, 0, 0}, {0, 2, 0}, {2, 2, 0}, {1, 1, 0}},
                          {{0, 1, 2}, {1, 4, 2}, {1, 3, 4}, {3, 2, 4}});
  for (const SubdivisionMethod method : {butterfly, loop, ls3, mid_point}) {
    const TriangleMesh result = subdivide(mesh, {.method = method, .levels = 3});
    EXPECT_EQ(result.size(), 4u * 64) << name_of(method);
    for (const Vec3& v : result.vertices()) ASSERT_EQ(v.z(), 0);
  }
}

TEST(SubdivisionInput, RefusesAMeshWithoutATriangleLeft) {
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}}, {{0, 1, 1}, {0, 0, 0}});
  for (const SubdivisionMethod method : all_methods)
    EXPECT_TRUE(contains(message<MeshError>(mesh, {.method = method}), "none of the 2 triangles"));
}

TEST(SubdivisionInput, RefusesTooManyTrianglesBeforeTakingTheirMemory) {
  const std::string text = message<MeshError>(test::octahedron(), {.method = loop, .levels = 40});
  EXPECT_EQ(text, "level 12 of loop would have 134217728 triangles, more than 50000000");
}

TEST(SubdivisionInput, RefusesExactlyBeyondTheLimit) {
  // Edges of sqrt(2): a threshold of 0.1 splits them all, as 0 does, but that is known level by level only.
  for (const SubdivisionMethod method : {loop, mid_point, butterfly, ls3}) {
    for (const double threshold : {0., 0.1}) {
      SubdivisionOptions options = {
          .method = method, .levels = 2, .threshold = threshold, .max_triangles = 128};
      EXPECT_NO_THROW(subdivide(test::octahedron(), options));
      options.max_triangles = 127;
      EXPECT_EQ(message<MeshError>(test::octahedron(), options),
                "level 2 of " + std::string(name_of(method)) + " would have 128 triangles, more than 127");
    }
  }
  for (const SubdivisionMethod method : {catmull_clark, catmull_clark_linear}) {
    SubdivisionOptions options = {.method = method, .levels = 2, .max_triangles = 192};
    EXPECT_NO_THROW(subdivide(test::octahedron(), options));
    options.max_triangles = 191;
    EXPECT_TRUE(contains(message<MeshError>(test::octahedron(), options), "192 triangles, more than 191"));
  }
}

TEST(SubdivisionInput, RefusesOptionsThatMeanNothing) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const TriangleMesh mesh = test::octahedron();
  EXPECT_TRUE(contains(message<std::invalid_argument>(mesh, {.levels = -1}), "levels is -1"));
  EXPECT_TRUE(contains(message<std::invalid_argument>(mesh, {.threshold = -0.5}), "threshold is -0.5"));
  EXPECT_TRUE(contains(message<std::invalid_argument>(mesh, {.threshold = nan}), "threshold is"));
}

TEST(SubdivisionInput, RefusesCoordinatesThatTheToolsFloatsCannotHold) {
  const TriangleMesh mesh({{0, 0, 0}, {1e39, 0, 0}, {0, 1, 0}}, {{0, 1, 2}});
  EXPECT_TRUE(
      contains(message<MeshError>(mesh, {.method = mid_point, .form = SubdivisionForm::meshlab}), "float"));
  EXPECT_NO_THROW(once(mesh, mid_point));
}

TEST(SubdivisionInput, LevelZeroIsTheMesh) {
  const TriangleMesh coarse = test::open_patch();
  const TriangleMesh mesh = subdivide(coarse, {.method = catmull_clark, .levels = 0});
  EXPECT_TRUE(std::ranges::equal(mesh.triangles(), coarse.triangles()));
}

TEST(SubdivisionNames, GoBothWays) {
  for (const SubdivisionMethod method :
       {butterfly, catmull_clark, catmull_clark_linear, mid_point, loop, ls3})
    EXPECT_EQ(subdivision_method(name_of(method)), method);
  EXPECT_FALSE(subdivision_method("catmull_clark"));
}

}  // namespace
}  // namespace touchmark
