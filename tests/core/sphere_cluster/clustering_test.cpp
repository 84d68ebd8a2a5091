#include "core/sphere_cluster/clustering.h"

#include <algorithm>
#include <fstream>
#include <limits>
#include <set>
#include <string>

#include <gtest/gtest.h>

#include "core/sphere_cluster/published/triangle_spheres.h"
#include "tests/core/sphere_cluster/test_meshes.h"

namespace touchmark {
namespace {

bool holds(const Sphere& sphere, const TriangleMesh& mesh, std::size_t triangle) {
  // In long double, whose rounding is far below the margin by which radii are rounded up.
  for (int k = 0; k < 3; ++k) {
    long double squared = 0;
    for (int axis = 0; axis < 3; ++axis) {
      const long double d = static_cast<long double>(mesh.corner(triangle, k)[axis]) - sphere.center[axis];
      squared += d * d;
    }
    if (std::sqrt(squared) > sphere.radius) return false;
  }
  return true;
}

/// The vertices and faces of an ascii PLY with nothing but positions.
TriangleMesh read_plain_ply(std::istream& file) {
  std::string word;
  std::size_t vertex_count = 0, face_count = 0;
  while (file >> word && word != "end_header") {
    if (word != "element") continue;
    std::string what;
    std::size_t count = 0;
    file >> what >> count;
    (what == "vertex" ? vertex_count : face_count) = count;
  }
  std::vector<Vec3> vertices(vertex_count);
  for (Vec3& v : vertices) file >> v.x() >> v.y() >> v.z();
  std::vector<TriangleMesh::Corners> faces(face_count);
  for (TriangleMesh::Corners& corners : faces) {
    int three = 0;
    file >> three >> corners[0] >> corners[1] >> corners[2];
  }
  return {std::move(vertices), std::move(faces)};
}

TEST(TriangleSpheres, AreCentredOnTheCentroidAndReachTheFarthestCorner) {
  const auto spheres = triangle_spheres(TriangleMesh({{0, 0, 0}, {3, 0, 0}, {0, 6, 0}}, {{0, 1, 2}}));
  ASSERT_EQ(spheres.size(), 1u);
  EXPECT_EQ(spheres[0].center, Vec3(1, 2, 0));
  EXPECT_NEAR(spheres[0].radius, std::sqrt(1 + 16), 1e-14);
}

TEST(TriangleSpheres, HoldTheirTrianglesOnEveryMesh) {
  for (const auto& named : test::test_meshes()) {
    const auto spheres = triangle_spheres(named.mesh);
    ASSERT_EQ(spheres.size(), named.mesh.size());
    for (std::size_t i = 0; i < spheres.size(); ++i)
      ASSERT_TRUE(holds(spheres[i], named.mesh, i)) << named.name;
  }
}

TEST(Clustering, AtDistanceZeroEveryTriangleKeepsItsOwnSphere) {
  const TriangleMesh mesh = test::repeated(10);
  const SphereClusters clusters = cluster_spheres(mesh, 0);
  ASSERT_EQ(clusters.size(), 10u);
  for (std::uint32_t i = 0; i < 10; ++i) {
    ASSERT_EQ(clusters.triangles_of(i).size(), 1u);
    EXPECT_EQ(clusters.triangles_of(i)[0], i);
  }
}

TEST(Clustering, MergesTheTwoTrianglesOfASquareAtTheDistanceOfTheirCentroids) {
  const TriangleMesh mesh({{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}}, {{0, 1, 2}, {0, 2, 3}});
  const double apart = std::sqrt(2.0);  // centroids (2, 1) and (1, 2)
  EXPECT_EQ(cluster_spheres(mesh, 0.999 * apart).size(), 2u);
  const SphereClusters merged = cluster_spheres(mesh, 1.001 * apart);
  ASSERT_EQ(merged.size(), 1u);
  EXPECT_EQ(merged.spheres[0].center, Vec3(2, 1, 0));
  EXPECT_NEAR(merged.spheres[0].radius, std::sqrt(8.0), 1e-14);  // to (0, 3)
}

TEST(Clustering, PutsEveryTriangleInOneSphereThatHoldsItOnEveryMesh) {
  for (const auto& named : test::test_meshes()) {
    for (const double part : {1e-300, 1e-3, 0.1, 0.7, 10.0}) {
      const VisitOrder order = part < 0.5 ? VisitOrder::breadth_first : VisitOrder::mesh;
      const SphereClusters clusters = cluster_spheres(named.mesh, part * named.size, order);
      std::set<std::uint32_t> seen;
      for (std::size_t i = 0; i < clusters.size(); ++i)
        for (const std::uint32_t triangle : clusters.triangles_of(i)) {
          EXPECT_TRUE(seen.insert(triangle).second) << named.name;
          ASSERT_TRUE(holds(clusters.spheres[i], named.mesh, triangle)) << named.name << " at " << part;
        }
      EXPECT_EQ(seen.size(), named.mesh.size()) << named.name;
    }
  }
}

TEST(Clustering, KeepsLeadersApartAndMembersNearTheirs) {
  const TriangleMesh mesh = test::bumpy_sphere(16, 0.05, 11);
  const double distance = 0.3;
  const SphereClusters clusters = cluster_spheres(mesh, distance);
  EXPECT_LT(clusters.size(), mesh.size() / 2);
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_GT((clusters.spheres[i].center - clusters.spheres[k].center).norm(), distance);
    for (const std::uint32_t triangle : clusters.triangles_of(i))
      EXPECT_LE((centroid(mesh, triangle) - clusters.spheres[i].center).norm(), distance);
  }
}

TEST(Clustering, DoesNotDependOnTheUnit) {
  const TriangleMesh mesh = test::bumpy_sphere(12, 0.05, 13);
  const SphereClusters here = cluster_spheres(mesh, 0.25);
  const SphereClusters there = cluster_spheres(mesh.transformed(1024, Vec3::Zero()), 256);  // exactly
  EXPECT_EQ(here.members, there.members);
}

TEST(BreadthFirstOrder, VisitsEachTriangleOnceNeighboursFirst) {
  // A strip 2 - 0 - 3 - 1 by shared edges, and an island 4.
  const TriangleMesh mesh(
      {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {2, 0, 0}, {2, 1, 0}, {9, 0, 0}, {9, 1, 0}, {8, 0, 0}},
      {{1, 2, 3}, {3, 4, 5}, {0, 1, 2}, {2, 3, 4}, {6, 7, 8}});
  EXPECT_EQ(breadth_first_order(mesh), (std::vector<std::uint32_t>{0, 2, 3, 1, 4}));
}

TEST(BreadthFirstOrder, TakesLinearTimeOnAnEdgeThatAllTrianglesShare) {
  // Quadratic work on 400,000 triangles would be 10^11 visits.
  const TriangleMesh mesh({{0, 0, 0}, {1, 0, 0}, {0, 1, 0}},
                          std::vector<TriangleMesh::Corners>(400000, {0, 1, 2}));
  EXPECT_EQ(breadth_first_order(mesh).size(), mesh.size());
}

TEST(Tightness, IsTheMeanOfRadiusMinusCentroidDistance) {
  const TriangleMesh mesh({{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}}, {{0, 1, 2}, {0, 2, 3}});
  EXPECT_NEAR(average_tightness(mesh, cluster_spheres(mesh, 0)), std::sqrt(5.0), 1e-14);
  // One sphere of radius sqrt 8; centroids at distance 0 and sqrt 2 from its centre.
  EXPECT_NEAR(average_tightness(mesh, cluster_spheres(mesh, 2)), std::sqrt(8.0) - std::sqrt(2.0) / 2, 1e-14);
}

TEST(Clustering, ReproducesTheCountsOfThePaper) {
  const std::string path = TOUCHMARK_SHARED_MODELS "/bunny-902.ply";
  std::ifstream file(path);
  if (!file) GTEST_SKIP() << path << " is not there";
  const TriangleMesh bunny = read_plain_ply(file);
  ASSERT_EQ(bunny.size(), 902u);
  EXPECT_EQ(cluster_spheres(bunny, 0).size(), 902u);
  EXPECT_EQ(cluster_spheres(bunny, 0.0416, VisitOrder::mesh).size(), 728u);
  EXPECT_NEAR(static_cast<double>(cluster_spheres(bunny, 0.0416, VisitOrder::breadth_first).size()), 728, 4);
}

}  // namespace
}  // namespace touchmark
