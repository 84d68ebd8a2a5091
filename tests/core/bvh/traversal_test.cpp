// The bounds that a search leaves triangles out by. All instruction sets compute the same; see
// sphere_cluster_test.
#include "core/bvh/traversal.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/bvh/build/node_writer.h"
#include "core/geometry/sphere_triangle_sweep.h"
#include "tests/bench/oracle/corner_case_triangles.h"

namespace touchmark::bvh {
namespace {

using Bounds = Portable::Wide (*)(const TriangleBlock&, std::size_t, const Portable::Point&) noexcept;

/// Of the block's first triangle.
float first_of(Bounds bounds, const TriangleBlock& block, const FilterPoint& point) {
  return bounds(block, 0, Portable::broadcast(point))[0];
}

struct Alone {
  /// `times`: how many times its own size the mesh is that it is of.
  explicit Alone(const CornerCases::Corners& c, double times = 0) : triangle(prepare(c[0], c[1], c[2], 0)) {
    Aabb box;
    for (const Vec3& corner : c) box.extend(corner);
    box.extend(box.min + times * box.extent().maxCoeff() * Vec3::Ones());
    fits = FilterFrame::fits(box);
    if (!fits) return;
    frame = FilterFrame::around(box);
    set_triangle(block, 0, planes_of(triangle, frame));
  }
  PreparedTriangle triangle;
  bool fits;
  FilterFrame frame;
  TriangleBlock block{};
};

class TriangleBounds : public testing::TestWithParam<CornerCaseFamily> {};

TEST_P(TriangleBounds, NeverExceedTheDistance) {
  CornerCases cases(90);
  int asked = 0;
  for (int i = 0; i < 20000; ++i) {
    const CornerCase c = placed(GetParam(), cases, i);
    const Alone alone(c.triangle);
    // From afar what is beyond corners counts most.
    const Vec3 center =
        i % 5 == 0 ? Vec3(c.triangle[0] + cases.magnitude(0, 4) * (c.point - c.triangle[0])) : c.point;
    if (!alone.fits || !alone.frame.covers(center)) continue;
    ++asked;
    const FilterPoint point = alone.frame.point(center);
    const float limit = alone.frame.limit(squared_distance(alone.triangle, center));
    const float plain = first_of(Portable::triangle_bounds, alone.block, point);
    const float closer = first_of(Portable::corner_bounds, alone.block, point);
    ASSERT_LE(plain, limit) << i;
    ASSERT_LE(closer, limit) << i;
    ASSERT_GE(closer, plain * (1 - 0x1p-16F)) << i;
  }
  if (GetParam().name == "plain") {
    EXPECT_GT(asked, 15000);
  }
}

TEST_P(TriangleBounds, FromAboveNeverFallShortOfTheDistance) {
  CornerCases cases(91);
  int near = 0;
  for (int i = 0; i < 20000; ++i) {
    const CornerCase c = placed(GetParam(), cases, i);
    const Alone alone(c.triangle, i % 2 == 0 ? 0 : cases.magnitude(0, 9));
    if (!alone.fits || !alone.frame.covers(c.point)) continue;
    const FilterPoint point = alone.frame.point(c.point);
    const double distance = std::sqrt(squared_distance(alone.triangle, c.point));
    const auto is_within = [&](double radius) {
      return (Portable::surely_within(alone.block, alone.frame.to_frame_rounded_down(radius),
                                      Portable::broadcast(point)) &
              1) != 0;
    };
    const double error = alone.frame.kernel_error(point.plane_error);
    ASSERT_FALSE(is_within(distance - error)) << i;
    const TrianglePlanes planes = planes_of(alone.triangle, alone.frame);
    ASSERT_GE(
        alone.frame.from_frame_rounded_up(distance_upper_bound(planes, plane_values(planes, point), point)),
        distance - error)
        << i;
    if (is_within(1.01 * distance)) ++near;
  }
  if (GetParam().name == "plain") {
    EXPECT_GT(near, 100);
  }
}

TEST_P(TriangleBounds, HoldAllAroundBehindThePlaneOfAListedTriangle) {
  CornerCases cases(92);
  int above_zero = 0;
  for (int i = 0; i < 5000; ++i) {
    const CornerCase c = placed(GetParam(), cases, i);
    const Alone alone(c.triangle);
    if (!alone.fits || !alone.frame.covers(c.point)) continue;
    Parts parts;
    parts.blocks.push_back(alone.block);
    PlaneList<64> list;
    Portable::Wide unseen{};
    Portable::add_near(parts, ChildRef{ChildRef::block_bit}, Portable::broadcast(alone.frame.point(c.point)),
                       farthest, unseen, list);
    ASSERT_GE(list.count, 1u) << i;
    ASSERT_EQ(list.slot[0], 0u) << i;
    for (int k = 0; k < 8; ++k) {
      const Vec3 moved = c.point + cases.magnitude(-9, 1) *
                                       (c.triangle[static_cast<std::size_t>(k % 3)] - c.point).norm() *
                                       cases.vector();
      if (!alone.frame.covers(moved)) continue;
      const Vec3 move = alone.frame.scale() * (moved - c.point);
      const double bound = double{list.bound[0]} + double{list.x[0]} * move.x() +
                           double{list.y[0]} * move.y() + double{list.z[0]} * move.z();
      const double distance = alone.frame.scale() * std::sqrt(squared_distance(alone.triangle, moved));
      const double error =
          alone.frame.scale() * alone.frame.kernel_error(alone.frame.point(moved).plane_error);
      ASSERT_LE(bound, distance * (1 + 0x1p-19) + move.norm() * 0x1p-19 + error) << i << ", " << k;
      if (bound > 0.5 * distance && distance > 0) ++above_zero;
    }
  }
  if (GetParam().name == "plain") {
    EXPECT_GT(above_zero, 5000);
  }
}

/// A ball of about the distance that the way comes to, so that doubles tell with difficulty, or not at all.
TEST_P(TriangleBounds, KeepNothingApartThatTheBallTouchesOnItsWay) {
  CornerCases cases(93);
  int apart = 0, told = 0;
  for (int i = 0; i < 20000; ++i) {
    const CornerCase c = placed(GetParam(), cases, i);
    const Alone alone(c.triangle);
    const double distance = std::sqrt(squared_distance(alone.triangle, c.point));
    const Vec3 to = c.point + cases.magnitude(-6, 1) * std::max(distance, 1e-30) * cases.vector();
    if (!alone.fits || !alone.frame.covers(c.point) || !alone.frame.covers(to)) continue;
    const double nearer = std::min(distance, std::sqrt(squared_distance(alone.triangle, to)));
    const Sweep sweep{c.point, to, nearer * (1 - (i % 3) * cases.magnitude(-12, -1))};
    const double part = i % 2 == 0 ? 1 : cases.magnitude(-3, 0);
    const SweptBall ball(sweep, part, alone.frame.scale());
    const std::uint32_t slot = 0;
    EightPlanes planes;
    const unsigned found = Portable::kept_apart(&alone.triangle, &slot, 1, ball, planes);
    const bool hits = sweep_hit(alone.triangle, sweep, part).has_value();
    ASSERT_FALSE(found != 0 && hits) << i;
    const double size = (c.point - c.triangle[0]).norm() + (to - c.point).norm();
    if (!sweep_hit(alone.triangle, {sweep.from, sweep.to, sweep.radius + 0.001 * size}, part)) {
      ++apart;
      told += static_cast<int>(found);
    }
    if (found == 0) continue;
    const Vec3 normal(double{planes.x[0]}, double{planes.y[0]}, double{planes.z[0]});
    EXPECT_NEAR(normal.norm(), 1, 0x1p-21) << i;
    for (const Vec3& corner : c.triangle)
      ASSERT_LE(double{planes.height[0]}, normal.dot(c.point - corner) * alone.frame.scale()) << i;
  }
  if (GetParam().name == "plain") {
    EXPECT_GT(apart, 500);
    EXPECT_GT(told, 0.95 * apart);
  }
}

INSTANTIATE_TEST_SUITE_P(Families, TriangleBounds, testing::ValuesIn(corner_case_families()),
                         [](const auto& family) { return family.param.name; });

TEST(CornerBounds, AreTheDistanceWhateverTheCorner) {
  const std::array<std::array<Vec3, 3>, 2> triangles = {
      {{Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(2, 4, 0)}, {Vec3(0, 0, 0), Vec3(4, 0, 0), Vec3(2, 0.5, 0)}}};
  for (const std::array<Vec3, 3>& corners : triangles) {
    const Alone alone(corners);
    CornerCases cases(93);
    for (int i = 0; i < 2000; ++i) {
      const Vec3 center = alone.triangle.corner[0] + 20 * cases.vector();
      const FilterPoint point = alone.frame.point(center);
      const double squared = squared_distance(alone.triangle, center);
      EXPECT_NEAR(alone.frame.squared(first_of(Portable::corner_bounds, alone.block, point)) / squared, 1,
                  2e-4)
          << center.transpose();
    }
  }
  // Where it takes both sides, the greater excess alone falls short.
  const Alone sharp(triangles[0]);
  const FilterPoint below = sharp.frame.point({-3, -1, 0.5});
  EXPECT_LT(first_of(Portable::triangle_bounds, sharp.block, below),
            0.9F * first_of(Portable::corner_bounds, sharp.block, below));
}

}  // namespace
}  // namespace touchmark::bvh
