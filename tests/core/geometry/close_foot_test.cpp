// The nearest point in 106 bits against the oracle, which shares no code with it.
#include "core/geometry/close_foot.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "bench/oracle/exact_distance.h"
#include "tests/bench/oracle/hard_triangles.h"

namespace touchmark {
namespace {

using Corners = HardCases::Corners;

class CloseFeet : public testing::TestWithParam<HardFamily> {};

TEST_P(CloseFeet, KeepTheErrorTheyState) {
  HardCases hard(80);
  for (int i = 0; i < 8000; ++i) {
    const HardCase c = placed(GetParam(), hard, i);
    const std::optional<CloseFoot> close = close_foot(c.triangle, c.point);
    if (!close) continue;
    const Foot& foot = close->foot;
    ASSERT_LE(foot.error, 0x1p-60 * c.largest_difference()) << i;
    const bench::ExactNearest truth = bench::nearest_exactly(c.point, {&c.triangle, 1});
    const double off = (foot.distance.high - truth.high) + (foot.distance.low - truth.low);
    ASSERT_LE(std::abs(off), foot.error + 0x1p-98 * truth.high) << i;  // what the oracle rounds, too
    // The nearest point is one, so the offset is the oracle's, as far as doubles can tell.
    const Vec3 offset = truth.high * truth.direction;
    ASSERT_LE((foot.offset - offset).norm(), 2 * foot.error + 0x1p-50 * truth.high) << i;
  }
}

TEST_P(CloseFeet, OfTheSameFeatureAreTies) {
  HardCases hard(81);
  int ties = 0;
  for (int i = 0; i < 4000; ++i) {
    const Corners a = GetParam().triangle(hard);
    const Corners b = {a[1], a[0], hard.vector()};
    const Vec3 point = hard.point_about(a);
    const std::optional<CloseFoot> first = close_foot(a, point), second = close_foot(b, point);
    if (!first || !second || !on_same_feature(*first, *second)) continue;
    ++ties;
    ASSERT_TRUE(compare_exactly(a, b, point) == 0) << i;
  }
  if (GetParam().name == "plain") {
    EXPECT_GT(ties, 400);
  }
}

INSTANTIATE_TEST_SUITE_P(Families, CloseFeet, testing::ValuesIn(hard_families()),
                         [](const auto& family) { return family.param.name; });

TEST(CloseFoot, TellsNearlyAlwaysWhatIsNearestToAPlainTriangle) {
  HardCases hard(82);
  int unknown = 0;
  for (int i = 0; i < 10000; ++i) {
    const Corners t = hard.plain();
    const double part = hard.fraction();
    const Vec3 on_edge = (1 - part) * t[0] + part * t[1];
    if (!close_foot(t, on_edge + hard.magnitude(-17, 0) * hard.vector())) ++unknown;
  }
  EXPECT_LE(unknown, 2);
}

TEST(CloseFoot, DoesNotTellOnABorderOrWithoutAnArea) {
  const Corners triangle = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
  EXPECT_FALSE(close_foot(triangle, {1, 0, 1}));   // over an edge: face or edge?
  EXPECT_FALSE(close_foot(triangle, {0, -1, 0}));  // beside a corner: corner or edge?
  EXPECT_FALSE(close_foot({Vec3(0, 0, 0), Vec3(1, 1, 1), Vec3(2, 2, 2)}, {1, 0, 0}));
  EXPECT_TRUE(close_foot(triangle, {1, 1, 1}));
}

TEST(CloseFoot, DoesNotTellWhereDoubleDoublesLoseTheirLowerHalves) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Corners triangle = {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(0, 4, 0)};
  EXPECT_FALSE(close_foot(triangle, {nan, 0, 0}));
  EXPECT_FALSE(close_foot(triangle, {1e100, 0, 0}));
  EXPECT_FALSE(close_foot({Vec3(0, 0, 0), Vec3(1e-100, 0, 0), Vec3(0, 1e-100, 0)}, {0, 0, 1e-100}));
}

}  // namespace
}  // namespace touchmark
