#include "core/subdivision/mesh_measures.h"

#include <cmath>
#include <stdexcept>
#include <vector>

#include <gtest/gtest.h>

#include "tests/core/subdivision/meshes.h"

namespace touchmark {
namespace {

TriangleMesh reversed(const TriangleMesh& mesh) {
  std::vector<TriangleMesh::Corners> triangles;
  for (const auto& [a, b, c] : mesh.triangles()) triangles.push_back({a, c, b});
  return {{mesh.vertices().begin(), mesh.vertices().end()}, std::move(triangles)};
}

TEST(MeshMeasures, OfAnOctahedron) {
  const TriangleMesh mesh = test::octahedron();
  EXPECT_NEAR(signed_volume(mesh), 4. / 3, 1e-15);
  EXPECT_NEAR(absolute_volume(mesh, Vec3::Zero()), 4. / 3, 1e-15);
  EXPECT_NEAR(area(mesh), 4 * std::sqrt(3), 1e-14);
  EXPECT_NEAR(mean_triangle_area(mesh), std::sqrt(3) / 2, 1e-15);
}

TEST(MeshMeasures, VolumeIsNegativeInsideOut) {
  EXPECT_NEAR(signed_volume(reversed(test::octahedron())), -4. / 3, 1e-15);
  EXPECT_NEAR(absolute_volume(reversed(test::octahedron()), Vec3::Zero()), 4. / 3, 1e-15);
}

TEST(MeshMeasures, VolumeIsTheSameFarAway) {
  // Coordinates of 2^20 leave 2^-32 to the shape's own; these are exact.
  EXPECT_EQ(signed_volume(test::octahedron().transformed(1, Vec3::Constant(1 << 20))),
            signed_volume(test::octahedron()));
}

TEST(MeshMeasures, ThePapersVolumeGrowsFromACentreThatDoesNotSeeEveryFace) {
  // From (3, 0, 0) the far half counts in full and the near half a second time.
  const TriangleMesh mesh = test::octahedron();
  double expected = 0;
  for (std::size_t t = 0; t < mesh.size(); ++t) {
    const Vec3 outwards = (mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)).normalized();
    // Area sqrt(3)/2, plane at distance 1/sqrt(3) from the origin.
    expected += std::abs(1 / std::sqrt(3) - outwards.x() * 3) * std::sqrt(3) / 2 / 3;
  }
  EXPECT_NEAR(absolute_volume(mesh, {3, 0, 0}), expected, 1e-14);
  EXPECT_GT(expected, 4. / 3 + 1);
}

TEST(MeshMeasures, EdgesOfAClosedMesh) {
  const EdgeStatistics edges = edge_statistics(test::octahedron());
  EXPECT_EQ(edges.edges, 12u);
  EXPECT_TRUE(edges.closed());
  EXPECT_NEAR(edges.shortest, std::sqrt(2), 1e-15);
  EXPECT_NEAR(edges.mean, std::sqrt(2), 1e-15);
  EXPECT_NEAR(edges.longest, std::sqrt(2), 1e-15);
}

TEST(MeshMeasures, EdgesOfAnOpenMesh) {
  const EdgeStatistics edges = edge_statistics(TriangleMesh({{0, 0, 0}, {3, 0, 0}, {0, 4, 0}}, {{0, 1, 2}}));
  EXPECT_EQ(edges.boundary, 3u);
  EXPECT_FALSE(edges.closed());
  EXPECT_EQ(edges.shortest, 3);
  EXPECT_EQ(edges.mean, 4);
  EXPECT_EQ(edges.longest, 5);
}

TEST(MeshMeasures, EdgesOfMoreThanTwoTrianglesAreSeams) {
  const EdgeStatistics edges = edge_statistics(TriangleMesh(
      {{0, 0, 0}, {0, 0, 1}, {1, 0, 0}, {0, 1, 0}, {-1, -1, 0}}, {{0, 1, 2}, {0, 1, 3}, {0, 1, 4}}));
  EXPECT_EQ(edges.seams, 1u);
  EXPECT_EQ(edges.boundary, 6u);
  EXPECT_FALSE(edges.closed());
}

TEST(MeshMeasures, AMeshWithoutEdgesHasZeroes) {
  const EdgeStatistics edges = edge_statistics(TriangleMesh({{1, 2, 3}}, {{0, 0, 0}}));
  EXPECT_EQ(edges.edges, 0u);
  EXPECT_FALSE(edges.closed());
  EXPECT_EQ(edges.mean, 0);
}

TEST(Tightness, CountsEveryCentroidInASphereClosed) {
  // In the first sphere the centroids at distances 0, 1 and 2 (on it), in the second one at 0.5.
  const std::vector<Vec3> centers = {{0, 0, 0}, {10, 0, 0}};
  const std::vector<double> radii = {2, 1};
  const std::vector<Vec3> centroids = {{0, 0, 0}, {0, 1, 0}, {2, 0, 0}, {2.5, 0, 0}, {10, 0, 0.5}};
  EXPECT_DOUBLE_EQ(tightness(centers, radii, centroids).value(), (2 + 1 + 0 + 0.5) / 4);
}

TEST(Tightness, IsThatOfLookingAtEveryPair) {
  test::Noise noise(21);
  std::vector<Vec3> centers, centroids;
  std::vector<double> radii;
  for (int i = 0; i < 300; ++i) centers.push_back(noise.vector());
  for (int i = 0; i < 300; ++i) radii.push_back(0.3 * (1 + noise()));
  for (int i = 0; i < 500; ++i) centroids.push_back(noise.vector().cwiseProduct(Vec3(1, 2, 0.1)));
  double sum = 0;
  int pairs = 0;
  for (std::size_t s = 0; s < centers.size(); ++s) {
    for (const Vec3& c : centroids) {
      const double distance = (c - centers[s]).norm();
      if (distance > radii[s]) continue;
      sum += radii[s] - distance;
      ++pairs;
    }
  }
  EXPECT_NEAR(tightness(centers, radii, centroids).value(), sum / pairs, 1e-12);
}

TEST(Tightness, IsNothingWhereNoCentroidLiesInASphere) {
  const std::vector<Vec3> center = {{0, 0, 0}}, far = {{5, 0, 0}};
  const std::vector<double> radius = {1};
  EXPECT_FALSE(tightness(center, radius, far));
  EXPECT_FALSE(tightness({}, {}, far));
  EXPECT_FALSE(tightness(center, radius, {}));
}

TEST(Tightness, RefusesSpheresWithoutRadius) {
  const std::vector<Vec3> center = {{0, 0, 0}};
  EXPECT_THROW(tightness(center, {}, center), std::invalid_argument);
}

}  // namespace
}  // namespace touchmark
