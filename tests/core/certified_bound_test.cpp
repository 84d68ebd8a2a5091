// The distance that `nearest` reports is within 16 u M of the true one (u = 2^-53, M the largest coordinate
// difference between the centre and the triangle's corners): over the worst triangles there are, and by
// climbing from each towards greater error. The analysis is in docs/exactness.md, E5; it allows 14.8.
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <type_traits>

#include <gtest/gtest.h>

#include "bench/oracle/exact/exact_distance.h"
#include "bench/oracle/oracle.h"
#include "core/aabb.h"
#include "core/aabb_tree/aabb_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/float_limits.h"
#include "core/grid_group/grid_group.h"
#include "core/search/linear_scan.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "tests/bench/oracle/corner_case_triangles.h"

namespace touchmark {
namespace {

using bench::experiments::stress::mesh_of;

/// |d - d*| / (u M).
double error_of_the_scan(const CornerCase& c) {
  const PreparedTriangle triangle = prepare(c.triangle[0], c.triangle[1], c.triangle[2], 0);
  Aabb bounds;
  for (const Vec3& corner : c.triangle) bounds.extend(corner);
  Work work;
  const std::optional<Contact> contact =
      LinearScan{{&triangle, 1}, bounds, {}}.nearest(c.point, infinity, work);
  const bench::oracle::ExactNearest exact = bench::oracle::nearest_exactly(c.point, {&c.triangle, 1});
  const double unit = unit_roundoff * c.largest_difference();
  if (!contact || !(unit > 0)) return 0;
  return std::abs((contact->distance - exact.high) - exact.low) / unit;
}

/// The same but for a little more or less in one place, or in all of them.
CornerCase nudged(const CornerCase& c, CornerCases& cases) {
  CornerCase other = c;
  const double size = cases.magnitude(-17, -1) * c.largest_difference();
  const std::size_t one = cases.below(5);
  for (std::size_t i = 0; i < 3; ++i)
    if (one == i || one == 4) other.triangle[i] += size * cases.vector();
  if (one >= 3) other.point += size * cases.vector();
  return other;
}

class CertifiedBound : public testing::TestWithParam<CornerCaseFamily> {};

TEST_P(CertifiedBound, IsKeptEvenUphill) {
  constexpr int climbs = 40, steps = 150;
  CornerCases cases(50);
  double worst = 0;
  for (int climb = 0; climb < climbs; ++climb) {
    CornerCase at = placed(GetParam(), cases, climb);
    double height = error_of_the_scan(at);
    for (int step = 0; step < steps; ++step) {
      const CornerCase next = nudged(at, cases);
      const double error = error_of_the_scan(next);
      ASSERT_LE(error, 16) << "climb " << climb << ", step " << step;
      if (error < height) continue;
      height = error;
      at = next;
    }
    worst = std::max(worst, height);
  }
  RecordProperty("worst_error_in_roundings", std::to_string(worst));
}

/// Two triangles exactly as far from a centre, on its diagonal: the coordinates of the one are those of the
/// other in turn, so that they are summed in another order; or one of them nearer by a few units in the last
/// place.
struct NearTie {
  TriangleMesh mesh;
  Vec3 center;
};

NearTie near_tie(CornerCases& cases) {
  const double away = cases.magnitude(0, 6), along = 4 * cases.vector().x();
  const Vec3 center = Vec3::Constant(along), place = center + away * cases.vector();
  CornerCases::Corners one, other;
  for (std::size_t i = 0; i < 3; ++i) {
    one[i] = place + cases.vector();
    other[i] = {one[i].y(), one[i].z(), one[i].x()};
  }
  double& last = other[cases.below(3)][static_cast<int>(cases.below(3))];
  for (std::size_t ulps = cases.below(3); ulps > 0; --ulps)
    last = std::nextafter(last, cases.below(2) == 0 ? infinity : -infinity);
  return {cases.below(2) == 0 ? mesh_of({one, other}) : mesh_of({other, one}), center};
}

TEST(NearTies, NameTheFirstOfTheExactlyNearest) {
  CornerCases cases(52);
  for (int i = 0; i < 4000; ++i) {
    const NearTie tie = near_tie(cases);
    const bench::oracle::GroundTruth truth = bench::oracle::Oracle(tie.mesh, 1).solve(tie.center);
    const auto ask = [&](const auto& detector) {
      typename std::decay_t<decltype(detector)>::Session session;
      return detector.nearest({tie.center, 0}, infinity, session);
    };
    const std::optional<Contact> contact = ask(BruteForce::build(tie.mesh));
    ASSERT_TRUE(contact);
    ASSERT_EQ(contact->triangle, truth.triangle) << i;
    const double unit = unit_roundoff * truth.largest_difference;
    ASSERT_LE(std::abs((contact->distance - truth.high) - truth.low), 16 * unit) << i;
    for (const auto& other : {ask(AabbTree::build(tie.mesh)), ask(GridGroup::build(tie.mesh)),
                              ask(SphereCluster::build(tie.mesh))}) {
      ASSERT_TRUE(other);
      ASSERT_EQ(other->triangle, contact->triangle) << i;
      ASSERT_EQ(other->distance, contact->distance) << i;
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Nearest, CertifiedBound, testing::ValuesIn(corner_case_families()),
                         [](const auto& family) { return family.param.name; });

}  // namespace
}  // namespace touchmark
