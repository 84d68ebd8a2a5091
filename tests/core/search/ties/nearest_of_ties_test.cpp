// Hundreds of triangles as near by one shared place, or each by its own: the exact answers, and what they
// cost in decisions by whole numbers, each of which takes as long as a hundred distances in doubles.
#include "core/search/ties/nearest_of_ties.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "bench/experiments/stress/shared_features.h"
#include "bench/oracle/exact/exact_distance.h"
#include "bench/oracle/oracle.h"
#include "core/float_limits.h"
#include "tests/bench/oracle/corner_case_triangles.h"
#include "tests/own_forms.h"

namespace touchmark {
namespace {

using bench::workload::Answer;
using bench::workload::Query;
using bench::workload::Step;

/// Whole numbers may name the nearest, measure it, and compare it with the reach; and now and then decide
/// whether a point is exactly across an oblique corner from a triangle.
std::uint64_t max_decisions(const TriangleMesh& mesh) { return 4 + mesh.size() / 16; }

std::vector<Step> steps_about(const bench::experiments::stress::SharedFeature& shared) {
  const bench::oracle::Oracle oracle(shared.mesh);
  std::vector<Step> steps;
  for (const Vec3& center : shared.centers) {
    const double distance = oracle.solve(center).high;
    for (const double length :
         {distance, std::nextafter(distance, 0.0), std::nextafter(distance, infinity), infinity})
      steps.push_back({{center, length}, length});
  }
  return steps;
}

TEST(SharedFeatures, AreDecidedAsTheOracleDoesWithFewWholeNumbers) {
  for (const bench::experiments::stress::SharedFeature& shared :
       bench::experiments::stress::shared_feature_meshes(300)) {
    const bench::oracle::Oracle oracle(shared.mesh);
    const std::vector<Step> steps = steps_about(shared);
    std::vector<bench::oracle::GroundTruth> truths;
    for (const Step& step : steps) truths.push_back(oracle.solve(step.probe.center));
    for (const ExactForm& form : exact_forms(shared.mesh)) {
      for (const Query query : {Query::touches, Query::nearest}) {
        form.detector->forget();
        for (std::size_t i = 0; i < steps.size(); ++i) {
          const std::string where = shared.name + ", " + form.name + ", step " + std::to_string(i);
          Answer answer;
          std::uint64_t work = 0;
          const std::uint64_t before = form.detector->work().exact_decisions;
          form.detector->answer({query, {&steps[i], 1}}, {0, 1}, {&answer, 1}, {&work, 1});
          // As published, grid groups look at a triangle once for each group that it is in.
          if (!form.name.starts_with("grid-group, scan")) {
            EXPECT_LE(form.detector->work().exact_decisions - before, max_decisions(shared.mesh)) << where;
          }
          const bool within = oracle.within(truths[i], steps[i].probe.center, steps[i].reach);
          ASSERT_EQ(answer.found != 0, within) << where;
          if (query == Query::nearest && within) {
            ASSERT_EQ(answer.triangle, truths[i].triangle) << where;
          }
        }
      }
    }
  }
}

class SureFeatures : public testing::TestWithParam<CornerCaseFamily> {};

TEST_P(SureFeatures, AreAsFarAsTheTriangle) {
  CornerCases cases(90);
  int sure = 0;
  for (int i = 0; i < 4000; ++i) {
    const CornerCase c = placed(GetParam(), cases, i);
    if (!features_fit(c.largest_difference())) continue;
    const PreparedTriangle triangle = prepare(c.triangle[0], c.triangle[1], c.triangle[2], 0);
    const std::optional<Feature> feature = sure_feature(triangle, c.point);
    if (!feature) continue;
    ++sure;
    const bench::oracle::ExactNearest truth = bench::oracle::nearest_exactly(c.point, {&c.triangle, 1});
    const SquaredDistance squared = squared_distance(*feature, c.point);
    // The square of the oracle's two halves, but for that of the lower one and the oracle's rounding.
    const DoubleDouble expected = DoubleDouble{truth.high, truth.low} * DoubleDouble{truth.high, truth.low};
    const double off = (squared.value.high - expected.high) + (squared.value.low - expected.low);
    EXPECT_LE(std::abs(off), squared.error + 0x1p-96 * expected.high) << i;
  }
  if (GetParam().name == "plain") {
    EXPECT_GT(sure, 3000);
  }
}

TEST_P(SureFeatures, ThatAreSharedAreTies) {
  CornerCases cases(91);
  int ties = 0;
  for (int i = 0; i < 4000; ++i) {
    const CornerCases::Corners a = GetParam().triangle(cases);
    const CornerCases::Corners b = i % 2 == 0 ? CornerCases::Corners{a[1], a[0], cases.vector()}
                                              : CornerCases::Corners{cases.vector(), a[0], cases.vector()};
    // On a shared corner or edge, or anywhere.
    const Vec3 point = i % 5 == 0 ? a[0] : i % 5 == 1 ? Vec3(0.5 * (a[0] + a[1])) : cases.point_near(a);
    const std::optional<Feature> feature = sure_feature(prepare(a[0], a[1], a[2], 0), point);
    if (!feature) continue;
    const PreparedTriangle other = prepare(b[0], b[1], b[2], 1);
    if (!SharedFeature(*feature, point).is_nearest_of(other)) continue;
    ++ties;
    ASSERT_TRUE(compare_exactly(a, b, point) == 0) << i;
  }
  EXPECT_GT(ties, 100);
}

TEST_P(SureFeatures, OfTwoTrianglesCompareAsWholeNumbersDo) {
  CornerCases cases(92);
  for (int i = 0; i < 2000; ++i) {
    CornerCases::Corners a = GetParam().triangle(cases);
    const Vec3 point = cases.point_near(a);
    // Its image, exactly as far, and sometimes an ulp off.
    CornerCases::Corners b;
    for (std::size_t k = 0; k < 3; ++k) b[k] = Vec3(a[k].y(), a[k].z(), a[k].x());
    const Vec3 center = Vec3::Constant(point.x());
    if (i % 2 == 0) b[0].x() = std::nextafter(b[0].x(), infinity);
    const PreparedTriangle first = prepare(a[0], a[1], a[2], 0), second = prepare(b[0], b[1], b[2], 1);
    NearestOfTies ties(center);
    ties.consider(second);
    ties.consider(first);
    const bool second_is_nearer = compare_exactly(b, a, center) < 0;
    ASSERT_EQ(ties.nearest()->index, second_is_nearer ? 1U : 0U) << i;
  }
}

/// Pairs of triangles with one corner or edge, and points about it from on it to far away, some exactly over
/// the corner of a face across an axis.
template <class Check>
void for_each_pair_at_a_corner(const CornerCaseFamily& family, CornerCases& cases, const Check& check) {
  for (int i = 0; i < 4000; ++i) {
    CornerCases::Corners a = family.triangle(cases);
    CornerCases::Corners b = {a[0], i % 2 == 0 ? a[1] : cases.vector(), cases.vector()};
    Vec3 point = a[0] + std::ldexp(1.0, -static_cast<int>(cases.below(70))) * cases.vector();
    if (i % 3 == 0) {
      // An oblique plane, but for rounding, and a point over the corner.
      const Vec3 x = cases.vector().normalized(), y = x.unitOrthogonal();
      const auto in_plane = [&] { return Vec3(a[0] + cases.vector().x() * x + cases.vector().y() * y); };
      a = {a[0], in_plane(), in_plane()};
      b = {a[0], i % 2 == 0 ? a[1] : in_plane(), in_plane()};
      point = a[0] + cases.vector().x() * x.cross(y);
    } else if (i % 3 == 1 && i % 5 == 0) {
      for (Vec3* v : {&a[1], &a[2], &b[1], &b[2]}) v->z() = a[0].z();
      point = a[0] + Vec3(0, 0, cases.vector().z());
    }
    check(a, b, point, i);
  }
}

TEST_P(SureFeatures, AtACornerComparesAsTheOracleDoes) {
  CornerCases cases(93);
  int told = 0;
  for_each_pair_at_a_corner(GetParam(), cases, [&](const auto& a, const auto& b, const Vec3& point, int i) {
    const std::partial_ordering order = BesideCorner(a, point).compare(b);
    if (order == std::partial_ordering::unordered) return;
    ++told;
    const std::array<bench::oracle::Triangle, 2> b_first = {b, a}, a_first = {a, b};
    const bool b_is_no_farther = bench::oracle::nearest_exactly(point, b_first).which == 0;
    const bool a_is_no_farther = bench::oracle::nearest_exactly(point, a_first).which == 0;
    ASSERT_EQ(order <= 0, b_is_no_farther) << i;
    ASSERT_EQ(order >= 0, a_is_no_farther) << i;
  });
  EXPECT_GT(told, 1000);
}

/// A point about the plane of the triangle, over it or not, and a radius about its height there.
TEST_P(SureFeatures, AreNoNearerThanTheirPlane) {
  CornerCases cases(94);
  int told = 0;
  for (int i = 0; i < 4000; ++i) {
    const CornerCase c = placed(GetParam(), cases, i);
    if (!features_fit(c.largest_difference())) continue;
    const SquaredDistance plane = squared_distance(Feature{c.triangle, 3}, c.point);
    const double height = std::sqrt(plane.value.high);
    for (const double radius : {height, std::nextafter(height, 0.0)}) {
      if (!(compare(plane, squared(radius)) > 0)) continue;
      ++told;
      ASSERT_TRUE(bench::oracle::compare_distance(c.point, c.triangle, radius) > 0) << i;
    }
  }
  if (GetParam().name == "plain") {
    EXPECT_GT(told, 3000);
  }
}

INSTANTIATE_TEST_SUITE_P(Families, SureFeatures, testing::ValuesIn(corner_case_families()),
                         [](const auto& family) { return family.param.name; });

}  // namespace
}  // namespace touchmark
