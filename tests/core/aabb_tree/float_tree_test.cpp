#include "core/aabb_tree/float_tree.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>

#include "bench/oracle/oracle.h"
#include "core/float_limits.h"
#include "tests/bench/oracle/corner_case_meshes.h"

namespace touchmark {
namespace {

constexpr double as_declared = 1 + 0x1p-50;  // the bound is evaluated in double

struct Errors {
  double worst_of_bound = 0, worst = 0;
  std::size_t asked = 0;
};

/// Every answer within what the tree declares of the oracle's: distance, triangle, point, and contact where
/// the radius is farther from the distance than that.
Errors check(const TriangleMesh& mesh, std::uint64_t seed, int points) {
  const bench::oracle::Oracle oracle(mesh, 1);
  const FloatTree tree = FloatTree::build(mesh);
  const Accuracy accuracy = tree.accuracy();
  EXPECT_EQ(accuracy.guarantee, Guarantee::approximate);
  FloatTree::Session session;
  CornerCases cases(seed);
  Errors errors;
  for (const Vec3& point : corner_case_points(mesh, cases, points)) {
    const bench::oracle::GroundTruth truth = oracle.solve(point);
    if (!truth.defined || truth.high > 0x1p40 * mesh.diagonal()) continue;
    const double bound = (accuracy.relative * truth.largest_difference + accuracy.absolute) * as_declared;
    const std::optional<Contact> contact = tree.nearest({point, 0}, infinity, session);
    if (!contact) {
      ADD_FAILURE() << "nothing within any reach";
      continue;
    }
    const double error = std::abs(contact->distance - truth.high);
    EXPECT_LE(error, bound);
    EXPECT_LE(oracle.solve(point, contact->triangle).high, truth.high + 2 * bound);
    EXPECT_NEAR(contact->normal.norm(), 1, 1e-6);
    EXPECT_LE(std::abs((point - contact->point).norm() - contact->distance), bound);
    if (truth.high - bound > 0) {
      EXPECT_FALSE(tree.touches({point, truth.high - bound}, session));
    }
    EXPECT_TRUE(tree.touches({point, truth.high + bound}, session));
    errors.worst_of_bound = std::max(errors.worst_of_bound, error / bound);
    errors.worst = std::max(errors.worst, error);
    ++errors.asked;
  }
  return errors;
}

TEST(FloatTree, KeepsItsBoundOnHardMeshes) {
  for (const NamedMesh& named : corner_case_meshes()) {
    SCOPED_TRACE(named.name);
    const Errors errors = check(named.mesh, 31, 200);
    EXPECT_GT(errors.asked, 100U);
  }
}

TEST(FloatTree, IsInSinglePrecision) {
  // Of doubles nothing would be off by that much.
  EXPECT_GT(check(octasphere(6), 32, 200).worst, 0x1p-30);
}

TEST(FloatTree, LosesNothingToOffsetAndScale) {
  const TriangleMesh mesh = octasphere(5);
  const double plain = check(mesh, 33, 200).worst_of_bound;
  for (const double scale : {1e-30, 1e-9, 1e9, 1e30})
    EXPECT_NEAR(check(mesh.transformed(scale, Vec3::Zero()), 33, 200).worst_of_bound, plain, 0.5);
  check(mesh.transformed(1, Vec3::Constant(1e6)), 33, 200);
}

TEST(FloatTree, FindsTheLeastOfAllAsComputed) {
  CornerCases cases(34);
  std::vector<CornerCases::Corners> triangles;
  for (int i = 0; i < 300; ++i) triangles.push_back(cases.mixed());
  const TriangleMesh mesh = mesh_of(triangles);
  const FloatTree tree = FloatTree::build(mesh), flat = FloatTree::build(mesh, {255});
  FloatTree::Session session, other;
  for (int i = 0; i < 300; ++i) {
    const Probe probe{2 * cases.vector(), 0};
    const auto contact = tree.nearest(probe, infinity, session),
               expected = flat.nearest(probe, infinity, other);
    ASSERT_TRUE(contact && expected);
    EXPECT_EQ(contact->triangle, expected->triangle);
    EXPECT_EQ(contact->distance, expected->distance);
  }
}

TEST(FloatTree, NothingIsNearWhatIsNoNumber) {
  const FloatTree tree = FloatTree::build(octasphere(3));
  FloatTree::Session session;
  for (const double x : {std::nan(""), infinity, 1e300}) {
    EXPECT_FALSE(tree.nearest({Vec3(x, 0, 0), 0}, infinity, session));
    EXPECT_FALSE(tree.touches({Vec3(x, 0, 0), 1}, session));
  }
  EXPECT_FALSE(tree.nearest({Vec3::Zero(), 0}, -1, session));
  EXPECT_FALSE(tree.touches({Vec3::UnitX(), -1}, session));
}

}  // namespace
}  // namespace touchmark
