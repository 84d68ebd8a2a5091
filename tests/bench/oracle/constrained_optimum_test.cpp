/// The optimum of a proxy in a convex free space, on spaces whose optima are known by hand.
#include "bench/oracle/exact/constrained_optimum.h"

#include <array>
#include <vector>

#include <gtest/gtest.h>

namespace touchmark::bench::oracle {
namespace {

/// The planes x = 0, y = 0 and z = 0, the free space being where all are positive.
std::vector<Triangle> octant() {
  const Vec3 o = Vec3::Zero(), x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ();
  return {
      {o, x, y}, {o, z, y}, {o, x, z}};  // two of them look the other way: the inside says which side is free
}

Vec3 optimum(double radius, const Vec3& goal) {
  const std::optional<Vec3> found = ConvexFreeSpace(octant(), Vec3(1, 1, 1), radius).nearest(goal);
  return found ? *found : Vec3::Constant(-1000);
}

TEST(ConstrainedOptimum, IsAFreeGoalItself) {
  EXPECT_EQ(optimum(0.5, Vec3(0.75, 2, 0.625)), Vec3(0.75, 2, 0.625));
  EXPECT_EQ(optimum(0.5, Vec3(0.5, 0.5, 0.5)), Vec3(0.5, 0.5, 0.5)) << "at the radius, it is free";
}

TEST(ConstrainedOptimum, IsOnOneTwoOrThreePlanes) {
  EXPECT_EQ(optimum(0.5, Vec3(3, 2, -7)), Vec3(3, 2, 0.5));
  EXPECT_EQ(optimum(0.5, Vec3(3, -1, -7)), Vec3(3, 0.5, 0.5));
  EXPECT_EQ(optimum(0.5, Vec3(-3, -1, 0.25)), Vec3(0.5, 0.5, 0.5));
  EXPECT_EQ(optimum(0, Vec3(-3, 4, -0x1p-30)), Vec3(0, 4, 0));
}

TEST(ConstrainedOptimum, OfASharpGrooveMayBeHeldByAPlaneThatTheGoalIsInFrontOf) {
  // Free: |y| <= x / 8. The goal is below both planes' line but in front of the second plane.
  const std::vector<Triangle> groove{{Vec3(0, 0, 0), Vec3(8, 1, 0), Vec3(0, 0, 1)},
                                     {Vec3(0, 0, 0), Vec3(8, -1, 0), Vec3(0, 0, 1)}};
  const ConvexFreeSpace space(groove, Vec3(4, 0, 0), 0);
  // Its nearest point on the first plane, along (8, 1), is behind the origin.
  const std::optional<Vec3> found = space.nearest(Vec3(-1, 0.5, 3));
  ASSERT_TRUE(found.has_value());
  EXPECT_LT((*found - Vec3(0, 0, 3)).norm(), 1e-60);
}

TEST(ConstrainedOptimum, CountsThePlanesOfOneSquareOnce) {
  std::vector<Triangle> twice = octant();
  twice.push_back({Vec3(5, 5, 0), Vec3(6, 5, 0), Vec3(5, 6, 0)});
  const std::optional<Vec3> found = ConvexFreeSpace(twice, Vec3(1, 1, 1), 0.5).nearest(Vec3(-1, -1, -1));
  ASSERT_TRUE(found.has_value());
  EXPECT_EQ(*found, Vec3(0.5, 0.5, 0.5));
}

}  // namespace
}  // namespace touchmark::bench::oracle
