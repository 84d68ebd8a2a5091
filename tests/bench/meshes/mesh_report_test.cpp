#include "bench/meshes/mesh_report.h"

#include <cmath>

#include <gtest/gtest.h>

namespace touchmark::bench::meshes {
namespace {

const std::vector<Vec3> tetrahedron_corners = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

TriangleMesh tetrahedron() { return {tetrahedron_corners, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 2, 3}}}; }

TEST(MeshReport, MeasuresATetrahedron) {
  const MeshReport report = report_on(tetrahedron());
  EXPECT_EQ(report.triangles, 4u);
  EXPECT_EQ(report.faces, 4u);
  EXPECT_EQ(report.positions, 4u);
  EXPECT_EQ(report.edges, 6u);
  EXPECT_EQ(report.euler_characteristic, 2);
  EXPECT_TRUE(report.closed);
  EXPECT_TRUE(report.oriented);
  EXPECT_NEAR(report.area, 1.5 + std::sqrt(3.0) / 2, 1e-15);
  EXPECT_NEAR(report.volume.value(), 1.0 / 6, 1e-16);
  EXPECT_EQ(report.shortest_edge, 1);
  EXPECT_EQ(report.longest_edge, std::sqrt(2.0));
  EXPECT_NEAR(report.mean_edge, (1 + std::sqrt(2.0)) / 2, 1e-15);
  EXPECT_NEAR(report.worst_aspect_ratio, 2, 1e-15);
  EXPECT_EQ(report.degenerate, 0u);
}

TEST(MeshReport, ATriangleTurnedOverIsClosedButNotOriented) {
  const MeshReport report = report_on({tetrahedron_corners, {{0, 2, 1}, {0, 1, 3}, {0, 3, 2}, {1, 3, 2}}});
  EXPECT_TRUE(report.closed);
  EXPECT_FALSE(report.oriented);
  EXPECT_FALSE(report.volume.has_value());
}

TEST(MeshReport, VerticesRepeatedByTheFileAreOnePosition) {
  std::vector<Vec3> corners;
  std::vector<TriangleMesh::Corners> triangles;
  const TriangleMesh shared = tetrahedron();
  for (std::size_t t = 0; t < shared.size(); ++t) {
    const auto first = static_cast<std::uint32_t>(corners.size());
    for (int k = 0; k < 3; ++k) corners.push_back(shared.corner(t, k));
    triangles.push_back({first, first + 1, first + 2});
  }
  corners.emplace_back(9, 9, 9);  // used by no triangle
  const MeshReport report = report_on({corners, triangles});
  EXPECT_EQ(report.vertices, 13u);
  EXPECT_EQ(report.positions, 4u);
  EXPECT_TRUE(report.closed);
}

TEST(MeshReport, CountsBoundariesAndEdgesOfMoreThanTwo) {
  EXPECT_EQ(report_on({tetrahedron_corners, {{0, 1, 2}}}).boundary_edges, 3u);
  const MeshReport book = report_on(
      {{{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, 0, 0}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}});
  EXPECT_EQ(book.non_manifold_edges, 1u);
  EXPECT_EQ(book.boundary_edges, 6u);
  EXPECT_FALSE(book.closed);
  EXPECT_FALSE(book.oriented);
}

TEST(MeshReport, CountsPolygonsOnceAndDegenerateTrianglesApart) {
  const MeshReport report =
      report_on({tetrahedron_corners, {{0, 1, 2}, {0, 2, 3}, {1, 1, 2}, {3, 3, 3}}, {0, 0, 1, 5}});
  EXPECT_EQ(report.faces, 3u);
  EXPECT_EQ(report.degenerate, 2u);
  EXPECT_LT(report.worst_aspect_ratio, 3);
}

TEST(MeshReport, AMeshThatIsOnePointHasNoEdges) {
  const MeshReport report = report_on({{{1, 2, 3}}, {{0, 0, 0}}});
  EXPECT_EQ(report.edges, 0u);
  EXPECT_EQ(report.shortest_edge, 0);
  EXPECT_EQ(report.mean_edge, 0);
  EXPECT_FALSE(report.closed);
}

TEST(MeshReport, MeasuresFarFromTheOriginAndTinyMeshes) {
  EXPECT_NEAR(report_on(tetrahedron().transformed(1, Vec3::Constant(1e6))).volume.value(), 1.0 / 6, 1e-9);
  EXPECT_NEAR(report_on(tetrahedron().transformed(1e-90, Vec3::Zero())).area / 1e-180,
              1.5 + std::sqrt(3.0) / 2, 1e-12);
}

TEST(AspectRatio, IsTheLongestEdgeOverTheSmallestHeight) {
  EXPECT_NEAR(aspect_ratio({0, 0, 0}, {1, 0, 0}, {0.5, 1e-15, 0}) / 1e15, 1, 1e-15);
  EXPECT_NEAR(aspect_ratio({0.3, 0.7, 0}, {0.3, 0.7, 1e-9}, {1.3, 0.7, 0}) / 1e9, 1, 1e-15);
  EXPECT_TRUE(std::isinf(aspect_ratio({0, 0, 0}, {1, 1, 1}, {2, 2, 2})));
}

}  // namespace
}  // namespace touchmark::bench::meshes
