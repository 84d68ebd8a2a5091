#include "core/geometry/sweep_box.h"

#include <gtest/gtest.h>

#include "core/float_limits.h"

namespace touchmark {
namespace {

TEST(SweepBox, IsEnteredWhereTheWidenedBoxBegins) {
  const Aabb box{Vec3(2, -1, -1), Vec3(3, 1, 1)};
  EXPECT_EQ(enters(box, {Vec3(0, 0, 0), Vec3(4, 0, 0), 0}, 0, 1), 0.5);
  EXPECT_EQ(enters(box, {Vec3(0, 0, 0), Vec3(4, 0, 0), 0}, 1, 1), 0.25);
  EXPECT_EQ(enters(box, {Vec3(0, 3, 0), Vec3(4, 3, 0), 0}, 1, 1), infinity);
  EXPECT_EQ(enters(box, {Vec3(0, 3, 0), Vec3(4, 3, 0), 0}, infinity, 1), 0);
}

/// Hierarchies fill their nodes up with empty boxes, behind which there is nothing to look at.
TEST(SweepBox, IsNeverEnteredWhenEmptyHoweverWide) {
  for (const double widening : {0.0, 1.0, 1e300, infinity})
    for (const Vec3& to : {Vec3(1, 2, 3), Vec3(5, 2, 3), Vec3(-5, 7, -9)})
      EXPECT_EQ(enters(Aabb(), {Vec3(1, 2, 3), to, 0}, widening, 1), infinity) << widening;
}

}  // namespace
}  // namespace touchmark
