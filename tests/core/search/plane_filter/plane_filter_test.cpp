#include "core/search/plane_filter/plane_filter.h"

#include <bit>
#include <cmath>
#include <limits>
#include <vector>

#include <gtest/gtest.h>

#include "bench/support/random.h"
#include "core/search/plane_filter/side_bound.h"

namespace touchmark {
namespace {

using bench::support::Random;

double bound_of(const PreparedTriangle& triangle, const FilterFrame& frame, const Vec3& center) {
  const TrianglePlanes planes = planes_of(triangle, frame);
  return frame.squared(lower_bounds(planes, planes, planes, planes, frame.point(center))[0]);
}

Aabb box_of(const PreparedTriangle& triangle) {
  Aabb box;
  for (const Vec3& corner : triangle.corner) box.extend(corner);
  return box;
}

/// Of about this scale, as thin as that, every other one a thousand times its scale away.
struct Thin {
  Thin(Random& random, double scale, double thickness, int round)
      : shift(random.point(round % 2 == 0 ? 0 : 1e3 * scale)),
        a(random.point(scale)),
        along(random.point(scale)),
        aside(thickness * random.point(scale)),
        triangle(prepare(a + shift, a + along + shift, a + 0.7 * along + aside + shift, 0)),
        frame(FilterFrame::around(box_of(triangle))) {}

  Vec3 shift, a, along, aside;
  PreparedTriangle triangle;
  FilterFrame frame;
};

TEST(PlaneFilter, BoundsTheDistanceFromBelowWhateverTheTriangleAndTheScale) {
  Random random(1);
  for (const double scale : {1e-80, 1e-6, 1.0, 1e6, 1e80}) {
    for (const double thickness : {1.0, 1e-3, 1e-6, 1e-9, 0.0}) {
      for (int round = 0; round < 400; ++round) {
        const Thin thin(random, scale, thickness, round);
        for (const double away : {1e-3, 1.0, 1e4}) {
          const Vec3 center = thin.a + thin.shift + random.point(away * scale);
          const double squared = squared_distance(thin.triangle, center);
          ASSERT_LE(bound_of(thin.triangle, thin.frame, center), squared)
              << scale << ' ' << thickness << ' ' << round;
        }
      }
    }
  }
}

TEST(PlaneFilter, BoundsTheDistanceFromAboveWhateverTheTriangleAndTheScale) {
  Random random(3);
  int close = 0;
  for (const double scale : {1e-35, 1e-6, 1.0, 1e6, 1e50}) {
    for (const double thickness : {1.0, 1e-3, 1e-5, 1e-7, 1e-9}) {
      for (int round = 0; round < 400; ++round) {
        const Thin thin(random, scale, thickness, round);
        ASSERT_TRUE(FilterFrame::fits(box_of(thin.triangle)));
        const Vec3 center = thin.triangle.corner[0] + 0.6 * thin.along + 0.4 * thin.aside +
                            (round % 3 == 0 ? 1.0 : 1e-3) * random.point(scale);
        const FilterPoint point = thin.frame.point(center);
        const TrianglePlanes planes = planes_of(thin.triangle, thin.frame);
        const Lanes values = plane_values(planes, point);
        const double most = thin.frame.from_frame_rounded_up(distance_upper_bound(planes, values, point));
        const double distance = std::sqrt(squared_distance(thin.triangle, center));
        if (most < 1.01 * distance) ++close;
        ASSERT_GE(most, distance) << scale << ' ' << thickness << ' ' << round;
        ASSERT_LE(thin.frame.squared(squared_lower_bound(values, point)), distance * distance);
      }
    }
  }
  EXPECT_GT(close, 1000);
}

TEST(SideBound, IsNeverBelowTheDistanceWhateverTheTriangleAndTheScale) {
  Random random(5);
  int close = 0;
  for (const double scale : {1e-35, 1e-6, 1.0, 1e6, 1e50}) {
    for (const double thickness : {1.0, 1e-3, 1e-5, 1e-7, 1e-9}) {
      for (int round = 0; round < 1000; ++round) {
        const Thin thin(random, scale, thickness, round);
        const double away = scale * (round % 3 == 0 ? 1 : round % 3 == 1 ? thickness : 1e-3);
        const Vec3 center = thin.triangle.corner[0] + random.between(-0.2, 1.2) * thin.along +
                            random.between(-0.2, 1.2) * thin.aside + random.point(away);
        const FilterPoint point = thin.frame.point(center);
        const TrianglePlanes planes = planes_of(thin.triangle, thin.frame);
        const double most =
            thin.frame.from_frame_rounded_up(side_upper_bound(planes, plane_values(planes, point), point));
        const double distance = std::sqrt(squared_distance(thin.triangle, center));
        if (most < 1.01 * distance) ++close;
        ASSERT_GE(most, distance) << scale << ' ' << thickness << ' ' << round;
      }
    }
  }
  EXPECT_GT(close, 1000);
}

TEST(SideBound, IsTheDistanceToASideOrNothing) {
  const PreparedTriangle triangle = prepare({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, 0);
  const FilterFrame frame = FilterFrame::around(box_of(triangle));
  const TrianglePlanes planes = planes_of(triangle, frame);
  const auto most = [&](const Vec3& center) {
    const FilterPoint point = frame.point(center);
    return frame.from_frame_rounded_up(side_upper_bound(planes, plane_values(planes, point), point));
  };
  EXPECT_NEAR(most({2, -1, 2}), std::sqrt(5), 1e-3);
  EXPECT_NEAR(most({-3, 1, 0}), 3, 1e-3);
  EXPECT_NEAR(most({3, 3, 0}), std::sqrt(2), 1e-3);
  EXPECT_NEAR(most({0.5, 1, 2}), std::sqrt(4.25), 1e-3);  // over the face, by the nearest side
  EXPECT_NEAR(most({-1, -1, 0}), std::sqrt(18), 2e-3);    // by the foot on the far side
  EXPECT_EQ(most({6, -1, 0}), std::numeric_limits<double>::infinity());
}

TEST(SideBound, ASideTooShortForAPlaneHasNoFoot) {
  const double size = 0x1p-24;  // in this frame only the first side is too short
  const PreparedTriangle triangle = prepare({0, 0, 0}, {0.9 * size, 0, 0}, {0.45 * size, size, 0}, 0);
  const FilterFrame frame = FilterFrame::around({{0, 0, 0}, {4, 4, 4}});
  const TrianglePlanes planes = planes_of(triangle, frame);
  for (const Vec3& center : {Vec3(0, -2, 1), Vec3(0, -2, 0), Vec3(1, -3, 0.5)}) {
    const FilterPoint point = frame.point(center);
    EXPECT_GE(frame.from_frame_rounded_up(side_upper_bound(planes, plane_values(planes, point), point)),
              std::sqrt(squared_distance(triangle, center)));
  }
}

TEST(PlaneFilter, BoundsFromAboveByTheHeightOrAnAcuteCorner) {
  const PreparedTriangle triangle = prepare({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, 0);
  const FilterFrame frame = FilterFrame::around(box_of(triangle));
  const TrianglePlanes planes = planes_of(triangle, frame);
  const auto most = [&](const Vec3& center) {
    const FilterPoint point = frame.point(center);
    return frame.from_frame_rounded_up(distance_upper_bound(planes, plane_values(planes, point), point));
  };
  EXPECT_NEAR(most({1, 1, 3}), 3, 1e-3);
  EXPECT_NEAR(most({1, 1, -3}), 3, 1e-3);
  EXPECT_NEAR(most({6, -1, 2}), 3, 1e-3);
  EXPECT_NEAR(most({2, -1, 2}), 3, 1e-3);
  EXPECT_NEAR(most({4.5, 4, 1}), std::sqrt(17.25), 2e-3);
  // The corner at 0 has a right angle.
  EXPECT_NEAR(most({-1, 0, 0}), std::sqrt(17), 2e-3);
}

TEST(PlaneFilter, BoundsNothingFromAboveWithoutANormal) {
  const PreparedTriangle needle = prepare({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, 0);
  const FilterFrame frame = FilterFrame::around(box_of(needle));
  const FilterPoint point = frame.point({5, 6, 7});
  const TrianglePlanes planes = planes_of(needle, frame);
  EXPECT_TRUE(std::isinf(distance_upper_bound(planes, plane_values(planes, point), point)));
}

TEST(PlaneFilter, IsTheDistanceOverTheFaceAndBesideASide) {
  const PreparedTriangle triangle = prepare({0, 0, 0}, {4, 0, 0}, {0, 4, 0}, 0);
  const FilterFrame frame = FilterFrame::around(box_of(triangle));
  EXPECT_NEAR(bound_of(triangle, frame, {1, 1, 3}), 9, 1e-3);
  EXPECT_NEAR(bound_of(triangle, frame, {2, -3, 4}), 25, 1e-3);
  EXPECT_NEAR(bound_of(triangle, frame, {4, 4, -1}), 9, 1e-3);
}

TEST(PlaneFilter, KeepsEachTriangleInItsLane) {
  const FilterFrame frame = FilterFrame::around({{0, 0, 0}, {8, 8, 8}});
  std::vector<TrianglePlanes> planes;
  for (int i = 0; i < 4; ++i)
    planes.push_back(planes_of(prepare({0, 0, 2.0 * i}, {8, 0, 2.0 * i}, {0, 8, 2.0 * i}, 0), frame));
  const Lanes bounds = lower_bounds(planes[0], planes[1], planes[2], planes[3], frame.point({1, 1, 3}));
  EXPECT_NEAR(frame.squared(bounds[0]), 9, 1e-3);
  EXPECT_NEAR(frame.squared(bounds[1]), 1, 1e-3);
  EXPECT_NEAR(frame.squared(bounds[2]), 1, 1e-3);
  EXPECT_NEAR(frame.squared(bounds[3]), 9, 1e-3);
  EXPECT_EQ(at_most(bounds, frame.limit(2)), 0b0110u);
}

TEST(PlaneFilter, LetsATiePassAtItsOwnDistance) {
  Random random(2);
  for (int round = 0; round < 2000; ++round) {
    const PreparedTriangle triangle = prepare(random.point(1), random.point(1), random.point(1), 0);
    const FilterFrame frame = FilterFrame::around(box_of(triangle));
    const Vec3 center = random.point(2);
    const TrianglePlanes planes = planes_of(triangle, frame);
    const Lanes bounds = lower_bounds(planes, planes, planes, planes, frame.point(center));
    ASSERT_EQ(at_most(bounds, frame.limit(squared_distance(triangle, center))), 0b1111u);
  }
}

TEST(PlaneFilter, NeverHoldsBackATriangleWithoutANormal) {
  const PreparedTriangle needle = prepare({0, 0, 0}, {1, 0, 0}, {2, 0, 0}, 0);
  const FilterFrame frame = FilterFrame::around(box_of(needle));
  EXPECT_EQ(bound_of(needle, frame, {5, 6, 7}), 0);
}

TEST(PlaneFilter, AnInfiniteLimitPassesEverything) {
  const FilterFrame frame = FilterFrame::around({{0, 0, 0}, {1, 1, 1}});
  const TrianglePlanes planes = planes_of(prepare({0, 0, 0}, {1, 0, 0}, {0, 1, 1}, 0), frame);
  const Vec3 far(0x1p19, 0x1p19, 0x1p19);
  ASSERT_TRUE(frame.covers(far));
  const Lanes bounds = lower_bounds(planes, planes, planes, planes, frame.point(far));
  EXPECT_EQ(at_most(bounds, frame.limit(std::numeric_limits<double>::infinity())), 0b1111u);
}

TEST(PlaneFilter, CoversNeitherInfinityNorNaN) {
  const FilterFrame frame = FilterFrame::around({{0, 0, 0}, {1, 1, 1}});
  const double infinity = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    Vec3 center = Vec3::Zero();
    for (const double bad : {infinity, -infinity, std::nan(""), 1e9, 1e308}) {
      center[k] = bad;
      EXPECT_FALSE(frame.covers(center)) << bad;
      EXPECT_FALSE(FilterFrame::covers(frame.point(center))) << bad;
    }
  }
}

TEST(PlaneFilter, CoversAPointOfItsFrameOnlyIfItCoversThePoint) {
  Random random(4);
  const FilterFrame frame = FilterFrame::around({{5, 5, 5}, {6, 7, 8}});
  int covered = 0;
  for (int i = 0; i < 2000; ++i) {
    const Vec3 center = random.point(std::ldexp(1.0, 15 + i % 8));
    if (!FilterFrame::covers(frame.point(center))) continue;
    ++covered;
    ASSERT_TRUE(frame.covers(center)) << center.transpose();
  }
  EXPECT_GT(covered, 500);
  EXPECT_LT(covered, 2000);
}

TEST(PlaneFilter, FitsNoBoxWhoseSquaresOverflowOrVanish) {
  EXPECT_TRUE(FilterFrame::fits({{0, 0, 0}, {1, 0, 0}}));
  EXPECT_FALSE(FilterFrame::fits({{2, 2, 2}, {2, 2, 2}}));
  EXPECT_FALSE(FilterFrame::fits({{0, 0, 0}, {1e200, 1, 1}}));
  EXPECT_FALSE(FilterFrame::fits({{0, 0, 0}, {1e-200, 0, 0}}));
}

}  // namespace
}  // namespace touchmark
