#include "bench/meshes/generated_meshes.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "bench/meshes/mesh_report.h"
#include "bench/meshes/portable_sincos.h"
#include "bench/meshes/sized_meshes.h"

namespace touchmark::bench::meshes {
namespace {

constexpr double pi = 3.14159265358979323846;

/// A closed surface, oriented outwards, of the given genus.
void expect_solid(const MeshReport& report, int genus) {
  EXPECT_TRUE(report.closed);
  EXPECT_TRUE(report.oriented);
  EXPECT_EQ(report.euler_characteristic, 2 - 2 * genus);
  EXPECT_EQ(report.degenerate, 0u);
  EXPECT_EQ(report.positions, report.vertices);
  EXPECT_GT(report.volume.value_or(-1), 0);
}

TEST(SinCos, AgreesWithTheLibraryToOneRounding) {
  for (int i = -1000; i <= 3000; ++i) {
    const double fraction = i / 997.0;
    const SinCos direction = portable_sincos(fraction);
    EXPECT_NEAR(direction.cos, std::cos(2 * pi * fraction), 1e-15 * (1 + std::abs(fraction)));
    EXPECT_NEAR(direction.sin, std::sin(2 * pi * fraction), 1e-15 * (1 + std::abs(fraction)));
  }
  EXPECT_EQ(portable_sincos(0.25).cos, 0);
  EXPECT_EQ(portable_sincos(0.5).cos, -1);
}

TEST(GeneratedMeshes, AnIcosphereApproachesTheUnitSphere) {
  double missing = 0;
  for (unsigned levels = 1; levels <= 5; ++levels) {
    const TriangleMesh mesh = icosphere(levels);
    const MeshReport report = report_on(mesh);
    expect_solid(report, 0);
    EXPECT_EQ(report.triangles, std::size_t{20} << (2 * levels));
    for (const Vec3& vertex : mesh.vertices()) ASSERT_NEAR(vertex.norm(), 1, 4e-16);
    EXPECT_LT(report.worst_aspect_ratio, 1.5);
    // The chords' error falls by four a level, once they are short.
    const double still_missing = 4 * pi / 3 - report.volume.value();
    if (levels > 1) {
      EXPECT_NEAR(missing / still_missing, 4, 0.3);
    }
    missing = still_missing;
  }
}

TEST(GeneratedMeshes, ATorusHasAHoleAndPappusVolume) {
  const MeshReport report = report_on(torus(200, 100));
  expect_solid(report, 1);
  EXPECT_EQ(report.triangles, 40000u);
  EXPECT_NEAR(report.volume.value() / (2 * pi * pi * 0.16), 1, 2e-3);
  EXPECT_NEAR(report.area / (4 * pi * pi * 0.4), 1, 2e-3);
  expect_solid(report_on(torus(3, 3)), 1);
}

TEST(GeneratedMeshes, TheThinPlateIsAThousandTimesWiderThanThick) {
  const MeshReport report = report_on(thin_plate());
  expect_solid(report, 0);
  EXPECT_EQ(report.triangles, 4352u);
  EXPECT_EQ(report.bounds.extent(), Vec3(1, 1, thin_plate_thickness));
  EXPECT_NEAR(report.volume.value(), thin_plate_thickness, 1e-15);
}

TEST(GeneratedMeshes, TheCubeHasVolumeOneAndTwelveTriangles) {
  const MeshReport report = report_on(cube());
  expect_solid(report, 0);
  EXPECT_EQ(report.triangles, 12u);
  EXPECT_EQ(report.volume.value(), 1);
  EXPECT_EQ(report.area, 6);
}

TEST(GeneratedMeshes, TheWedgeIsTwoDegreesSharp) {
  const MeshReport report = report_on(wedge());
  expect_solid(report, 0);
  const Vec3 extent = report.bounds.extent();
  EXPECT_NEAR(2 * std::atan(extent.z() / 2 / extent.x()), 2 * pi / 180, 1e-15);
  EXPECT_NEAR(report.volume.value(), extent.x() * extent.y() * extent.z() / 2, 1e-16);
}

TEST(GeneratedMeshes, TheSingleTriangleIsEquilateral) {
  const MeshReport report = report_on(single_triangle());
  EXPECT_EQ(report.triangles, 1u);
  EXPECT_NEAR(report.shortest_edge, 1, 1e-15);
  EXPECT_NEAR(report.longest_edge, 1, 1e-15);
}

TEST(GeneratedMeshes, ANoisySphereHasAsManyTrianglesAsAskedFor) {
  for (std::uint64_t triangles = 6; triangles < 400; ++triangles) {
    const MeshReport report = report_on(noisy_sphere(triangles));
    EXPECT_EQ(report.triangles, triangles / 2 * 2);
    expect_solid(report, 0);
    if (HasFailure()) FAIL() << triangles << " triangles";
  }
}

TEST(GeneratedMeshes, ANoisySphereIsRoughButWellShaped) {
  const TriangleMesh mesh = noisy_sphere(100'000);
  const MeshReport report = report_on(mesh);
  expect_solid(report, 0);
  double nearest = 2, farthest = 0;
  for (std::size_t t = 0; t < mesh.size(); ++t) {
    const Vec3 &a = mesh.corner(t, 0), &b = mesh.corner(t, 1), &c = mesh.corner(t, 2);
    nearest = std::min(nearest, a.norm());
    farthest = std::max(farthest, a.norm());
    ASSERT_GT((b - a).cross(c - a).dot(a), 0) << "star-shaped about the origin, triangle " << t;
  }
  EXPECT_GT(nearest, 0.85);
  EXPECT_LT(nearest, 0.98);
  EXPECT_LT(farthest, 1.15);
  EXPECT_GT(farthest, 1.02);
  EXPECT_LT(report.worst_aspect_ratio, 20);
  EXPECT_LT(report.longest_edge, 4 * report.mean_edge);
}

TEST(GeneratedMeshes, TheSliverFanNarrowsToATenthOfABillionth) {
  const TriangleMesh mesh = sliver_fan();
  ASSERT_EQ(mesh.size(), 1000u);
  const Vec3 apex = mesh.corner(0, 0);
  double sum = 0;
  for (std::size_t t = 0; t < mesh.size(); ++t) {
    ASSERT_EQ(mesh.corner(t, 0), apex);
    const double rim = (mesh.corner(t, 2) - mesh.corner(t, 1)).norm();
    ASSERT_GT(rim, 0);
    sum += rim;
  }
  EXPECT_NEAR(sum, 2 * pi, 1e-2);
  EXPECT_GT(report_on(mesh).worst_aspect_ratio, 1e9);
}

TEST(GeneratedMeshes, SoupIsUnconnectedInTheUnitCube) {
  const TriangleMesh mesh = soup(1000);
  const MeshReport report = report_on(mesh);
  EXPECT_EQ(report.triangles, 1000u);
  EXPECT_EQ(report.boundary_edges, 3000u);
  EXPECT_TRUE((report.bounds.min.array() >= 0).all() && (report.bounds.max.array() <= 1).all());
  EXPECT_GT(report.diagonal, 1.5);
  EXPECT_GT(report.longest_edge, 0.1);
  EXPECT_LE(report.longest_edge, 0.3);
}

TEST(GeneratedMeshes, SoupOfMoreBeginsWithSoupOfFewer) {
  const TriangleMesh few = soup(10), more = soup(20);
  EXPECT_TRUE(std::equal(few.vertices().begin(), few.vertices().end(), more.vertices().begin()));
}

TEST(GeneratedMeshes, DegenerateMixesPointsSegmentsAndGoodTriangles) {
  const TriangleMesh mesh = degenerate();
  const MeshReport report = report_on(mesh);
  EXPECT_EQ(report.triangles, 160u);
  EXPECT_EQ(report.degenerate, 80u);
  std::size_t points = 0, segments = 0, collinear = 0;
  for (std::size_t t = 0; t < mesh.size(); ++t) {
    const Vec3 &a = mesh.corner(t, 0), &b = mesh.corner(t, 1), &c = mesh.corner(t, 2);
    const int equal = (a == b) + (b == c) + (c == a);
    points += equal == 3;
    segments += equal == 1;
    collinear += equal == 0 && (b - a).cross(c - a).isZero(0);  // dyadic: the products are exact
  }
  EXPECT_EQ(points, 10u);
  EXPECT_EQ(segments, 40u);
  EXPECT_EQ(collinear, 30u);
}

TEST(GeneratedMeshes, DoubledUsesEveryEdgeSixTimes) {
  const TriangleMesh mesh = doubled();
  const MeshReport report = report_on(mesh);
  EXPECT_EQ(report.triangles, 960u);
  EXPECT_EQ(report.edges, 480u);
  EXPECT_EQ(report.non_manifold_edges, 480u);
}

TEST(GeneratedMeshes, NeedlesAndCapsReachAspectRatiosOf1e15) {
  for (const bool needle : {true, false}) {
    const TriangleMesh mesh = needle ? needles() : caps();
    ASSERT_EQ(mesh.size(), 192u);
    double height = 1;
    for (std::size_t t = 0; t < mesh.size(); ++t) {
      if (t % 64 == 0) height = 1;
      const Vec3 &a = mesh.corner(t, 0), &b = mesh.corner(t, 1), &c = mesh.corner(t, 2);
      std::array<double, 3> edges = {(b - a).norm(), (c - b).norm(), (a - c).norm()};
      std::sort(edges.begin(), edges.end());
      const double longest = needle ? std::hypot(1, height) : std::max(1.0, std::hypot(0.5, height));
      EXPECT_NEAR(aspect_ratio(a, b, c) * height / (longest * longest), 1, 1e-3) << t;
      if (needle && height < 1) {
        EXPECT_NEAR(edges[0] / height, 1, 1e-9) << t;
      }
      if (!needle && height < 0.1) {
        EXPECT_NEAR(edges[0] + edges[1], edges[2], 4 * height) << t;
      }
      if (t % 4 == 3) height /= 10;
    }
    EXPECT_GT(report_on(mesh).worst_aspect_ratio, 0.9e15);
  }
}

TEST(SizedMeshes, AreOfAboutTheSizeAskedForAndHaveNoDegenerateTriangle) {
  for (const SizedMesh& sized : sized_meshes()) {
    for (const std::uint64_t triangles : {sized.min_triangles, std::uint64_t{3000}}) {
      if (triangles < sized.min_triangles) continue;
      const MeshReport report = report_on(sized.make(triangles));
      EXPECT_GT(report.triangles, 0U) << sized.form;
      EXPECT_LE(report.triangles, triangles) << sized.form;
      if (triangles == 3000) {
        EXPECT_GE(report.triangles, triangles / 2) << sized.form;
      }
      EXPECT_EQ(report.degenerate, 0U) << sized.form << ' ' << triangles;
    }
  }
}

TEST(SizedMeshes, AreWithinAFewUnitsOfTheOrigin) {
  for (const SizedMesh& sized : sized_meshes()) {
    const TriangleMesh mesh = sized.make(3000);
    EXPECT_LT(mesh.bounds().min.norm(), 3) << sized.form;
    EXPECT_LT(mesh.bounds().max.norm(), 3) << sized.form;
    EXPECT_GT(mesh.diagonal(), 1) << sized.form;
  }
}

TEST(SizedMeshes, PartsAreClosed) {
  for (TriangleMesh (*make)(std::uint64_t) :
       {clusters, pebbles, hair, wires, cable, cylinder, bolts, gear, spring, knot, spikes, shells}) {
    const MeshReport report = report_on(make(2000));
    EXPECT_TRUE(report.closed);
    EXPECT_TRUE(report.oriented);
  }
}

TEST(SizedMeshes, TheCylinderApproachesTheRoundOne) {
  const MeshReport report = report_on(cylinder(4000));
  expect_solid(report, 0);
  EXPECT_EQ(report.triangles, 4000U);
  EXPECT_NEAR(report.volume.value() / (pi * 0.16), 1, 1e-5);
  EXPECT_NEAR(report.area / (2 * pi * 0.16 + 2 * pi * 0.4), 1, 1e-5);
}

TEST(SizedMeshes, CratesTouchSoThatMostOfTheirCornersAreEightfold) {
  const MeshReport report = report_on(crates(12 * 27));
  EXPECT_EQ(report.triangles, 12U * 27);
  EXPECT_EQ(report.vertices, 8U * 27);
  EXPECT_EQ(report.positions, 64U);
}

TEST(SizedMeshes, AGiantQuadIsFiftyTimesAsLargeAsTheBallBesideIt) {
  const TriangleMesh mesh = giant_quad(302);
  EXPECT_NEAR(mesh.bounds().extent().x(), 1, 1e-12);
  double largest = 0;
  for (std::size_t t = 2; t < mesh.size(); ++t)
    largest = std::max(largest, (mesh.corner(t, 0) - mesh.corner(t, 1)).norm());
  EXPECT_LT(largest, 1.0 / 50);
}

TEST(SizedMeshes, SheetsAreAHairApart) {
  const TriangleMesh mesh = sheets(1600);
  const std::size_t of_one = mesh.vertices().size() / 8;
  for (std::size_t i = 0; i < of_one; ++i) {
    const Vec3 apart = mesh.vertices()[i + of_one] - mesh.vertices()[i];
    ASSERT_EQ(apart.x(), 0);
    ASSERT_EQ(apart.y(), 0);
    ASSERT_NEAR(apart.z(), 1e-4, 1e-12);
  }
}

TEST(SizedMeshes, ShellsLieInsideOneAnother) {
  const TriangleMesh mesh = shells(2000);
  const std::size_t of_one = mesh.vertices().size() / 10;
  for (std::size_t i = 0; i + of_one < mesh.vertices().size(); ++i)
    ASSERT_LT(mesh.vertices()[i + of_one].norm(), mesh.vertices()[i].norm());
}

TEST(SizedMeshes, GradedTrianglesDifferAHundredThousandfold) {
  const MeshReport report = report_on(graded(6000));
  EXPECT_GT(report.longest_edge / report.shortest_edge, 1e5);
}

TEST(SizedMeshes, FoamSharesItsWalls) {
  // Between 27 cells there are 108 walls, each of two triangles, and those inside are of two cells.
  const MeshReport report = report_on(foam(216));
  EXPECT_EQ(report.triangles, 216U);
  EXPECT_EQ(report.vertices, 64U);
  EXPECT_GT(report.non_manifold_edges, 0U);
}

TEST(SizedMeshes, VoxelFacesLieOnALattice) {
  const TriangleMesh mesh = voxels(3000);
  double least = 1;
  for (std::size_t t = 0; t < mesh.size(); ++t) {
    const Vec3 normal = (mesh.corner(t, 1) - mesh.corner(t, 0)).cross(mesh.corner(t, 2) - mesh.corner(t, 0));
    EXPECT_NEAR(normal.cwiseAbs().maxCoeff(), normal.norm(), 1e-12) << t;
    least = std::min(least, normal.norm());
  }
  EXPECT_GT(least, 1e-4);
}

}  // namespace
}  // namespace touchmark::bench::meshes
