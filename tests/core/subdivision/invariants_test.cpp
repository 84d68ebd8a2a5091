/// What holds for whole classes of schemes on irregular meshes.
#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "core/brute_force/brute_force.h"
#include "core/subdivision/mesh_measures.h"
#include "core/subdivision/subdivision.h"
#include "tests/core/subdivision/meshes.h"

namespace touchmark {
namespace {

using enum SubdivisionMethod;
using enum SubdivisionForm;

using test::all_methods;
constexpr SubdivisionForm both_forms[] = {published, meshlab};

TriangleMesh torus() { return test::shaken_torus(9, 6, 0.2); }

TEST(Subdivision, OfInterpolatingSchemesKeepsTheVertices) {
  for (const TriangleMesh& coarse : {torus(), test::open_patch()}) {
    for (const SubdivisionMethod method : {butterfly, catmull_clark_linear, mid_point}) {
      for (const double threshold : {0., 0.8}) {
        const TriangleMesh mesh = subdivide(coarse, {.method = method, .levels = 2, .threshold = threshold});
        const auto kept = mesh.vertices().first(coarse.vertices().size());
        EXPECT_TRUE(std::ranges::equal(kept, coarse.vertices())) << name_of(method);
      }
    }
  }
}

TEST(Subdivision, OfLinearSchemesKeepsTheSurface) {
  const TriangleMesh coarse = torus();
  const BruteForce surface = BruteForce::build(coarse);
  BruteForce::Session session;
  for (const SubdivisionMethod method : {catmull_clark_linear, mid_point}) {
    const TriangleMesh mesh = subdivide(coarse, {.method = method, .levels = 2, .threshold = 0.5});
    EXPECT_NEAR(area(mesh), area(coarse), 1e-13 * area(coarse));
    EXPECT_NEAR(signed_volume(mesh), signed_volume(coarse), 1e-13 * area(coarse));
    for (const Vec3& v : mesh.vertices()) {
      const auto contact = surface.nearest({v, 0}, std::numeric_limits<double>::infinity(), session);
      ASSERT_LT(contact->distance, 1e-15 * 4) << name_of(method);
    }
  }
}

TEST(Subdivision, OfClosedMeshesIsClosed) {
  for (const SubdivisionMethod method : all_methods) {
    for (const SubdivisionForm form : both_forms) {
      for (const double threshold : {0., 0.4, 0.9, 1.3}) {
        const TriangleMesh mesh =
            subdivide(torus(), {.method = method, .levels = 3, .threshold = threshold, .form = form});
        EXPECT_TRUE(edge_statistics(mesh).closed()) << name_of(method) << " at " << threshold;
      }
    }
  }
}

TEST(Subdivision, KeepsTheBoundarysLoops) {
  // Every level doubles the boundary's edges where all edges split.
  const std::size_t boundary = edge_statistics(test::open_patch()).boundary;
  for (const SubdivisionMethod method : all_methods) {
    const TriangleMesh mesh = subdivide(test::open_patch(), {.method = method, .levels = 2});
    EXPECT_EQ(edge_statistics(mesh).boundary, 4 * boundary) << name_of(method);
    EXPECT_EQ(edge_statistics(mesh).seams, 0u);
  }
}

TEST(Subdivision, LeavesNoEdgeLongerThanTheThresholdInTheEnd) {
  const TriangleMesh mesh = subdivide(torus(), {.method = mid_point, .levels = 5, .threshold = 0.5});
  EXPECT_LE(edge_statistics(mesh).longest, 0.5);
  const TriangleMesh again = subdivide(mesh, {.method = mid_point, .levels = 1, .threshold = 0.5});
  EXPECT_EQ(again.size(), mesh.size());
}

TEST(Subdivision, MovesEveryVertexOfApproximatingSchemesThoughNoEdgeSplits) {
  for (const SubdivisionMethod method : {loop, ls3}) {
    const TriangleMesh coarse = torus();
    const TriangleMesh mesh = subdivide(coarse, {.method = method, .levels = 1, .threshold = 100});
    ASSERT_EQ(mesh.size(), coarse.size());
    for (std::size_t v = 0; v < mesh.vertices().size(); ++v)
      EXPECT_NE(mesh.vertices()[v], coarse.vertices()[v]) << name_of(method);
  }
}

/// The largest distance between vertices of the same number.
double apart(const TriangleMesh& a, const TriangleMesh& b) {
  double largest = a.vertices().size() == b.vertices().size() ? 0 : std::numeric_limits<double>::infinity();
  for (std::size_t v = 0; largest < 1e300 && v < a.vertices().size(); ++v)
    largest = std::max(largest, (a.vertices()[v] - b.vertices()[v]).norm());
  return largest;
}

template <typename Map>
TriangleMesh mapped(const TriangleMesh& mesh, const Map& map) {
  std::vector<Vec3> vertices;
  for (const Vec3& v : mesh.vertices()) vertices.push_back(map(v));
  return {std::move(vertices), {mesh.triangles().begin(), mesh.triangles().end()}};
}

TEST(Subdivision, CommutesWithAffineMapsInLinearSchemes) {
  Eigen::Matrix3d matrix;
  matrix << 1, .3, -.2, .1, 1.5, .4, -.6, .2, .8;
  const auto map = [&](const Vec3& v) { return Vec3(matrix * v + Vec3(3, -4, 5)); };
  for (const TriangleMesh& coarse : {torus(), test::open_patch()}) {
    for (const SubdivisionMethod method : {butterfly, catmull_clark, catmull_clark_linear, mid_point, loop}) {
      const SubdivisionOptions options = {.method = method, .levels = 3};
      EXPECT_LT(apart(subdivide(mapped(coarse, map), options), mapped(subdivide(coarse, options), map)),
                1e-13)
          << name_of(method);
    }
  }
}

TEST(Subdivision, CommutesWithSimilaritiesInLs3) {
  const Eigen::AngleAxisd turn(1, Vec3(1, 2, 3).normalized());
  const auto map = [&](const Vec3& v) { return Vec3(100 * (turn * v) + Vec3(1e4, 0, -1e4)); };
  for (const TriangleMesh& coarse : {torus(), test::open_patch()}) {
    const SubdivisionOptions options = {.method = ls3, .levels = 3};
    EXPECT_LT(apart(subdivide(mapped(coarse, map), options), mapped(subdivide(coarse, options), map)), 1e-9);
  }
}

TEST(Subdivision, IsTheSameFarFromTheOriginAndAtAnyScale) {
  // Powers of two and offsets that the coordinates can bear leave only the rounding of the positions.
  const TriangleMesh coarse =
      mapped(torus(), [](const Vec3& v) { return Vec3(v.cast<float>().cast<double>()); });
  for (const SubdivisionMethod method : all_methods) {
    const TriangleMesh here = subdivide(coarse, {.method = method, .levels = 2});
    const auto far = [](const Vec3& v) { return Vec3(v + Vec3::Constant(1 << 20)); };
    EXPECT_LT(apart(subdivide(mapped(coarse, far), {.method = method, .levels = 2}), mapped(here, far)), 4e-9)
        << name_of(method);
    for (const double scale : {0x1p-300, 0x1p+300}) {
      const auto scaled = [&](const Vec3& v) { return Vec3(scale * v); };
      const TriangleMesh there = subdivide(mapped(coarse, scaled), {.method = method, .levels = 2});
      EXPECT_LT(apart(there, mapped(here, scaled)), 1e-13 * scale) << name_of(method) << " at " << scale;
    }
  }
}

double farthest_from_unit_sphere(const TriangleMesh& mesh) {
  double largest = 0;
  for (const Vec3& v : mesh.vertices()) largest = std::max(largest, std::abs(v.norm() - 1));
  return largest;
}

TEST(Ls3, KeepsASymmetricallySampledSphereToTheRounding) {
  // The icosahedron's vertex normals are radial, so every sphere fitted is the sphere itself.
  const TriangleMesh mesh = subdivide(test::icosahedron(), {.method = ls3, .levels = 4});
  EXPECT_EQ(mesh.size(), 20u * 256);
  EXPECT_LT(farthest_from_unit_sphere(mesh), 1e-14);
  for (const TriangleMesh& solid : {test::octahedron(), test::tetrahedron()}) {
    const double radius = solid.vertices()[0].norm();
    const TriangleMesh fine = subdivide(solid, {.method = ls3, .levels = 3});
    for (const Vec3& v : fine.vertices()) ASSERT_NEAR(v.norm(), radius, 1e-14);
  }
}

TriangleMesh unevenly_sampled_sphere() {
  const TriangleMesh fine = subdivide(test::icosahedron(), {.method = mid_point, .levels = 3});
  return mapped(test::shaken(fine, 0.03, 9), [](const Vec3& v) { return Vec3(v.normalized()); });
}

TEST(Ls3, KeepsAnUnevenlySampledSphereBetterThanItsFacetsDo) {
  // Mid-points lie on the facets. Normals estimated from facets are not radial here, so nothing is exact.
  const TriangleMesh coarse = unevenly_sampled_sphere();
  const double facets = farthest_from_unit_sphere(subdivide(coarse, {.method = mid_point, .levels = 1}));
  for (const SubdivisionForm form : both_forms) {
    const TriangleMesh mesh = subdivide(coarse, {.method = ls3, .levels = 2, .form = form});
    EXPECT_LT(farthest_from_unit_sphere(mesh), facets / 4);
  }
  EXPECT_GT(farthest_from_unit_sphere(subdivide(coarse, {.method = loop, .levels = 2})), facets);
}

TEST(Subdivision, GivesTheSameBitsEveryTime) {
  for (const SubdivisionMethod method : all_methods) {
    for (const SubdivisionForm form : both_forms) {
      const SubdivisionOptions options = {.method = method, .levels = 2, .threshold = 0.3, .form = form};
      const TriangleMesh first = subdivide(test::open_patch(), options);
      const TriangleMesh second = subdivide(test::open_patch(), options);
      EXPECT_TRUE(std::ranges::equal(first.vertices(), second.vertices()));
      EXPECT_TRUE(std::ranges::equal(first.triangles(), second.triangles()));
    }
  }
}

TEST(Subdivision, KeepsFloatsInTheToolsForm) {
  for (const SubdivisionMethod method : all_methods) {
    const TriangleMesh mesh = subdivide(torus(), {.method = method, .levels = 2, .form = meshlab});
    for (const Vec3& v : mesh.vertices()) ASSERT_EQ(v, Vec3(v.cast<float>().cast<double>()));
  }
}

}  // namespace
}  // namespace touchmark
