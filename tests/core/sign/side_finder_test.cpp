#include "core/sign/side_finder.h"

#include <cmath>
#include <limits>
#include <string>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "bench/oracle/exact_winding.h"
#include "core/brute_force/brute_force.h"
#include "core/sign/signed_detector.h"
#include "tests/core/sign/closed_meshes.h"

namespace touchmark {

void PrintTo(Side side, std::ostream* out) {
  constexpr std::array<const char*, 5> names{"unasked", "outside", "inside", "on surface", "undecided"};
  *out << names[static_cast<std::size_t>(side)];
}

namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();
using SignedBruteForce = Signed<BruteForce>;

std::vector<bench::Triangle> triangles_of(const TriangleMesh& mesh) {
  std::vector<bench::Triangle> triangles;
  for (std::uint32_t i = 0; i < mesh.size(); ++i) triangles.push_back(bench::triangle_of(mesh, i));
  return triangles;
}

Side side_at(const SignedBruteForce& detector, const Vec3& center) {
  SignedBruteForce::Session session;
  const auto contact = detector.nearest({center, 0}, infinity, session);
  return contact ? contact->side : Side::unasked;
}

/// By the exact winding number, for solids: behind the faces.
Side truth(const Vec3& point, const std::vector<bench::Triangle>& triangles) {
  const std::optional<int> winding = bench::winding_exactly(point, triangles);
  if (!winding) return Side::on_surface;
  return *winding == 0 ? Side::outside : *winding > 0 ? Side::inside : Side::undecided;
}

void expect_true_sides(const Named& named, int count, std::uint64_t seed) {
  bench::Random random(seed);
  const SignedBruteForce detector = SignedBruteForce::build(named.mesh, {});
  const std::vector<bench::Triangle> triangles = triangles_of(named.mesh);
  for (const Vec3& point : telling_points(named.mesh, random, count)) {
    ASSERT_EQ(side_at(detector, point), truth(point, triangles))
        << named.name << " at " << std::hexfloat << point.transpose();
  }
}

TEST(SideFinder, AgreesWithTheExactWindingNumberOnSolids) {
  for (const Named& solid : solids()) expect_true_sides(solid, 40, 1);
}

TEST(SideFinder, AgreesWithTheExactWindingNumberWhereSurfacesCrossAndTouch) {
  for (const Named& tangle : tangles()) expect_true_sides(tangle, 40, 2);
}

TEST(SideFinder, AgreesWithTheExactWindingNumberFarFromTheOriginTinyAndHuge) {
  for (const Named& solid : solids()) {
    for (const double scale : {1e-9, 1.0, 1e9}) {
      for (const double shift : {0.0, 1e3, 1e9}) {
        const std::string name = solid.name + " * " + std::to_string(scale) + " + " + std::to_string(shift);
        expect_true_sides({name, moved(solid.mesh, scale, Vec3::Constant(shift * scale))}, 4, 3);
      }
    }
  }
}

}  // namespace
}  // namespace touchmark
