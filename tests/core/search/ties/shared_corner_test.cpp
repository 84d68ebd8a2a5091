// Triangles that are known without the kernel to be as far as another one by a corner that both have.
#include "core/search/ties/shared_corner.h"

#include <gtest/gtest.h>

#include "core/geometry/distance_error.h"
#include "core/search/ties/shared_nearest.h"
#include "tests/bench/oracle/corner_case_triangles.h"

namespace touchmark {
namespace {

/// As a search has it.
double margin_of(const PreparedTriangle& a, const PreparedTriangle& b, const Vec3& point) {
  Aabb box;
  for (const PreparedTriangle* triangle : {&a, &b})
    for (const Vec3& corner : triangle->corner) box.extend(corner);
  const double error = distance_error(box, point);
  return 0x1p47 * error * error;
}

bool has_shared_corner(const PreparedTriangle& a, const PreparedTriangle& b, const Vec3& point) {
  const Offset offset = offset_from(a, point);
  SharedCorner corner;
  corner.find(a, point, offset.vector, margin_of(a, b, point));
  return corner.is_known() && corner.is_nearest_of(b);
}

TEST(SharedCorner, IsTheTipOfAConeThatThePointIsBeyond) {
  const PreparedTriangle a = prepare({0, 0, 0}, {1, 0, -1}, {0, 1, -1}, 0),
                         b = prepare({0, 1, -1}, {-1, 0, -1}, {0, 0, 0}, 1);
  EXPECT_TRUE(has_shared_corner(a, b, {0.1, 0.1, 2}));
  EXPECT_FALSE(has_shared_corner(a, b, {-3, 0, 1})) << "over a face of the second";
  EXPECT_FALSE(has_shared_corner(b, a, {-3, 0, 1})) << "over a face of the first";
  EXPECT_FALSE(has_shared_corner(a, b, {0, 0, 0})) << "on the corner";
  EXPECT_FALSE(has_shared_corner(a, prepare({0, 0, 1e-9}, {-1, 0, -1}, {0, 1, -1}, 1), {0.1, 0.1, 2}))
      << "another corner";
}

/// Nearly flat, nearly closed, sharp and blunt ones, and points close to where the corner ceases to be
/// nearest.
TEST(SharedCorner, HasTheSameBitsAndTheSameDistance) {
  CornerCases cases(95);
  int known = 0;
  for (int i = 0; i < 200000; ++i) {
    const Vec3 tip = cases.magnitude(-3, 3) * cases.vector();
    const auto end = [&] { return Vec3(tip + cases.magnitude(-6, 1) * cases.vector()); };
    const Vec3 one = end(),
               other = i % 3 == 0 ? Vec3(tip + (1 + cases.magnitude(-12, -3)) * (one - tip)) : end();
    const PreparedTriangle a = prepare(tip, one, end(), 0), b = prepare(end(), tip, other, 1);
    Vec3 away = cases.magnitude(-6, 2) * cases.vector();
    if (i % 2 == 0)
      away -= away.dot(one - tip) / (one - tip).squaredNorm() * (1 + cases.magnitude(-16, 0)) * (one - tip);
    const Vec3 point = tip + away;
    if (!has_shared_corner(a, b, point)) continue;
    ++known;
    const Offset first = offset_from(a, point), second = offset_from(b, point);
    ASSERT_EQ(first.squared, second.squared) << i;
    ASSERT_EQ(first.vector, second.vector) << i;
    ASSERT_TRUE(surely_share_nearest(a, b, point)) << i;
  }
  EXPECT_GT(known, 10000);
}

}  // namespace
}  // namespace touchmark
