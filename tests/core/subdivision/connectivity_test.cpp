/// Edges, fans and the splitting of triangles.
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include <gtest/gtest.h>

#include "core/subdivision/edge_map.h"
#include "core/subdivision/edge_split.h"
#include "core/subdivision/oriented_surface.h"
#include "core/subdivision/subdivision.h"
#include "tests/core/subdivision/meshes.h"

namespace touchmark {
namespace {

using Corners = TriangleMesh::Corners;

EdgeMap<3> edges_of(const TriangleMesh& mesh) { return EdgeMap<3>(mesh.triangles(), mesh.vertices().size()); }

TEST(EdgeMap, NumbersEdgesAsTheFacesNameThem) {
  const std::vector<Corners> faces = {{3, 1, 2}, {2, 1, 0}};
  const EdgeMap<3> edges(faces, 4);
  ASSERT_EQ(edges.size(), 5u);
  EXPECT_EQ(edges.ends(0), (std::array<std::uint32_t, 2>{3, 1}));
  EXPECT_EQ(edges.ends(1), (std::array<std::uint32_t, 2>{1, 2}));
  EXPECT_EQ(edges.ends(2), (std::array<std::uint32_t, 2>{2, 3}));
  EXPECT_EQ(edges.ends(3), (std::array<std::uint32_t, 2>{1, 0}));
  EXPECT_EQ(edges.edge(1, 0), 1u);
  EXPECT_TRUE(std::ranges::equal(edges.sides(1), std::vector<std::uint32_t>{1, 3}));
  EXPECT_TRUE(std::ranges::equal(edges.sides(3), std::vector<std::uint32_t>{4}));
}

TEST(EdgeMap, CountsTheEdgesOfQuadrilaterals) {
  const std::vector<std::array<std::uint32_t, 4>> cube = {{0, 1, 2, 3}, {7, 6, 5, 4}, {0, 4, 5, 1},
                                                          {1, 5, 6, 2}, {2, 6, 7, 3}, {3, 7, 4, 0}};
  const EdgeMap<4> edges(cube, 8);
  ASSERT_EQ(edges.size(), 12u);
  for (std::size_t e = 0; e < 12; ++e) EXPECT_EQ(edges.sides(e).size(), 2u);
}

TEST(EdgeMap, KeepsEulersFormula) {
  for (const TriangleMesh& sphere : {test::tetrahedron(), test::octahedron(), test::icosahedron()})
    EXPECT_EQ(sphere.vertices().size() + sphere.size(), edges_of(sphere).size() + 2);
  const TriangleMesh torus = test::shaken_torus(7, 5, 0);
  EXPECT_EQ(torus.vertices().size() + torus.size(), edges_of(torus).size());
}

TEST(OrientedSurface, WalksAroundAnInnerVertexCounterClockwise) {
  const TriangleMesh mesh = test::octahedron();
  const EdgeMap<3> edges = edges_of(mesh);
  const TriangleSurface surface(mesh.triangles(), edges, mesh.vertices().size());
  std::vector<std::uint32_t> ring;
  surface.ring(surface.side_from(4), ring);  // +z, seen from above
  ASSERT_EQ(ring.size(), 4u);
  std::ranges::rotate(ring, std::ranges::find(ring, 0u));
  EXPECT_EQ(ring, (std::vector<std::uint32_t>{0, 2, 1, 3}));
  EXPECT_EQ(surface.valence(4), 4u);
  EXPECT_EQ(surface.location(4), TriangleSurface::Location::inside);
}

TEST(OrientedSurface, WalksFromOneEndOfABoundaryFanToTheOther) {
  const TriangleMesh mesh = test::grid(3, [](double i, double j) { return Vec3(i, j, 0); });
  const EdgeMap<3> edges = edges_of(mesh);
  const TriangleSurface surface(mesh.triangles(), edges, mesh.vertices().size());
  std::vector<std::uint32_t> ring;
  surface.ring(surface.side_from(1), ring);
  EXPECT_EQ(ring, (std::vector<std::uint32_t>{2, 4, 3, 0}));
  surface.ring(surface.side_from(0), ring);
  EXPECT_EQ(ring, (std::vector<std::uint32_t>{1, 3}));
  EXPECT_EQ(surface.valence(4), 6u);
  EXPECT_EQ(surface.valence(2), 3u);
  EXPECT_EQ(surface.location(5), TriangleSurface::Location::boundary);
}

TEST(OrientedSurface, EndsAtSeams) {
  // Three triangles on the edge 0-1, and one that turns the other way on the edge 0-2.
  const std::vector<Corners> faces = {{0, 1, 2}, {1, 0, 3}, {0, 1, 4}, {2, 0, 5}, {5, 0, 6}};
  const EdgeMap<3> edges(faces, 7);
  const TriangleSurface surface(faces, edges, 7);
  using enum TriangleSurface::Location;
  EXPECT_EQ(surface.location_of_edge(edges.edge(0, 0)), corner);    // of three triangles
  EXPECT_EQ(surface.location_of_edge(edges.edge(0, 2)), corner);    // 2-0 twice
  EXPECT_EQ(surface.location_of_edge(edges.edge(3, 1)), inside);    // 0-5 there and back
  EXPECT_EQ(surface.location_of_edge(edges.edge(0, 1)), boundary);  // 1-2
  for (const std::uint32_t v : {0u, 1u, 2u}) EXPECT_EQ(surface.location(v), corner) << v;
  for (const std::uint32_t v : {3u, 4u, 5u, 6u}) EXPECT_EQ(surface.location(v), boundary) << v;
  EXPECT_EQ(surface.across(0), TriangleSurface::no_side);
}

TEST(OrientedSurface, CallsVerticesOfSeveralFansCorners) {
  using enum TriangleSurface::Location;
  const std::vector<Corners> open = {{0, 1, 2}, {3, 4, 2}};
  const EdgeMap<3> open_edges(open, 5);
  EXPECT_EQ(TriangleSurface(open, open_edges, 5).location(2), corner);
  // Two tetrahedra tip to tip.
  const std::vector<Corners> closed = {{0, 2, 1}, {0, 3, 2}, {0, 1, 3}, {1, 2, 3},
                                       {0, 4, 5}, {0, 5, 6}, {0, 6, 4}, {4, 6, 5}};
  const EdgeMap<3> closed_edges(closed, 7);
  const TriangleSurface tips(closed, closed_edges, 7);
  EXPECT_EQ(tips.location(0), corner);
  EXPECT_EQ(tips.location(1), inside);
}

TriangleMesh halved(const TriangleMesh& mesh, double threshold) {
  return subdivide(mesh, {.method = SubdivisionMethod::mid_point, .levels = 1, .threshold = threshold});
}

/// Edges of 3, 4 and 5.
TriangleMesh right_triangle() { return TriangleMesh({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}); }

TEST(EdgeSplit, MakesOneTriangleMoreForEveryLongEdge) {
  EXPECT_EQ(halved(right_triangle(), 2.9).size(), 4u);
  EXPECT_EQ(halved(right_triangle(), 3.5).size(), 3u);
  EXPECT_EQ(halved(right_triangle(), 4.5).size(), 2u);
  EXPECT_EQ(halved(right_triangle(), 5.5).size(), 1u);
  EXPECT_EQ(halved(right_triangle(), 0).size(), 4u);
}

TEST(EdgeSplit, LeavesAnEdgeOfJustTheThreshold) {
  EXPECT_EQ(halved(right_triangle(), 3).size(), 3u);
  EXPECT_EQ(halved(right_triangle(), 4).size(), 2u);
  EXPECT_EQ(halved(right_triangle(), 5).size(), 1u);
}

TEST(EdgeSplit, ClosesTheTrapezoidWithItsShorterDiagonal) {
  // Without the edge of 3, the trapezoid is (0,0) (3,0) (1.5,2) (0,2): diagonals of 2.5 and 3.6.
  const TriangleMesh mesh = halved(right_triangle(), 3.5);
  const auto has_edge = [&](const Vec3& a, const Vec3& b) {
    for (std::size_t t = 0; t < mesh.size(); ++t)
      for (int i = 0; i < 3; ++i)
        if ((mesh.corner(t, i) == a && mesh.corner(t, (i + 1) % 3) == b) ||
            (mesh.corner(t, i) == b && mesh.corner(t, (i + 1) % 3) == a))
          return true;
    return false;
  };
  EXPECT_TRUE(has_edge({0, 0, 0}, {1.5, 2, 0}));
  EXPECT_FALSE(has_edge({3, 0, 0}, {0, 2, 0}));
}

TEST(EdgeSplit, KeepsTheOrientationHoweverATriangleIsTurned) {
  const TriangleMesh whole = right_triangle();
  for (std::uint32_t turn = 0; turn < 3; ++turn) {
    const std::vector<Vec3> vertices(whole.vertices().begin(), whole.vertices().end());
    const TriangleMesh turned(vertices, {{turn, (turn + 1) % 3, (turn + 2) % 3}});
    for (const double threshold : {0., 3.5, 4.5}) {
      const TriangleMesh mesh = halved(turned, threshold);
      double area = 0;
      for (std::size_t t = 0; t < mesh.size(); ++t) {
        const Vec3 u = mesh.corner(t, 1) - mesh.corner(t, 0), v = mesh.corner(t, 2) - mesh.corner(t, 0);
        const double twice = u.x() * v.y() - u.y() * v.x();
        EXPECT_GT(twice, 0);
        area += twice / 2;
      }
      EXPECT_EQ(area, 6);
    }
  }
}

TEST(EdgeSplit, KeepsTheFirstPartInPlaceAndPutsTheOthersAtTheEnd) {
  const TriangleMesh mesh = halved(test::octahedron(), 0);
  ASSERT_EQ(mesh.size(), 32u);
  const TriangleMesh coarse = test::octahedron();
  for (std::size_t t = 0; t < coarse.size(); ++t) {
    const auto inside = [&](std::size_t part) {
      const Vec3 outwards = coarse.corner(t, 0) + coarse.corner(t, 1) + coarse.corner(t, 2);
      return (mesh.corner(part, 0) + mesh.corner(part, 1) + mesh.corner(part, 2)).dot(outwards) > 2.9;
    };
    EXPECT_TRUE(inside(t));
    for (std::size_t k = 0; k < 3; ++k) EXPECT_TRUE(inside(8 + 3 * t + k));
  }
}

}  // namespace
}  // namespace touchmark
