#include "core/scene/pose.h"

#include <cmath>
#include <limits>
#include <string>

#include <gtest/gtest.h>

#include "core/scene/posed_predicates.h"

namespace touchmark {
namespace {

std::string refusal(const Pose& pose) {
  try {
    expect_rigid(pose);
  } catch (const PoseError& error) {
    return error.what();
  }
  return "";
}

Pose diagonal(double x, double y, double z) {
  Pose pose;
  pose.rotation.diagonal() << x, y, z;
  return pose;
}

TEST(Pose, OfAQuaternionTurnsAsItSays) {
  const double half = std::sqrt(0.5);
  const Pose quarter = pose_of({1, 2, 3}, half, 0, 0, half);
  EXPECT_NEAR((image(quarter, {1, 0, 0}) - Vec3(1, 3, 3)).norm(), 0, 1e-15);
  EXPECT_NEAR((in_frame(quarter, {1, 3, 3}) - Vec3(1, 0, 0)).norm(), 0, 1e-15);
  EXPECT_EQ(pose_of({1, 2, 3}, 1, 0, 0, 0), (Pose{Eigen::Matrix3d::Identity(), {1, 2, 3}}));
}

TEST(Pose, OfAQuaternionIsRigidWhateverItsLength) {
  for (const double length : {0x1p-240, 1e-9, 1.0, 3.7, 0x1p+240}) {
    const Pose pose = pose_of({0, 0, 0}, length * 0.3, length * -1.7, length * 0.2, length * 1e-9);
    EXPECT_EQ(refusal(pose), "") << length;
    EXPECT_LT(rigid_error(pose.rotation), 64 * std::numeric_limits<double>::epsilon()) << length;
  }
}

TEST(Pose, OfAQuaternionWithoutADirectionIsRefused) {
  EXPECT_THROW(pose_of({0, 0, 0}, 0, 0, 0, 0), PoseError);
  EXPECT_THROW(pose_of({0, 0, 0}, 1e-200, 0, 0, 0), PoseError);
  EXPECT_THROW(pose_of({0, 0, 0}, 1e200, 0, 0, 0), PoseError);
  EXPECT_THROW(pose_of({0, 0, 0}, std::nan(""), 0, 0, 0), PoseError);
  EXPECT_THROW(pose_of({0, HUGE_VAL, 0}, 1, 0, 0, 0), PoseError);
}

TEST(Pose, RefusesByNameWhatIsNotRigid) {
  EXPECT_EQ(refusal(diagonal(1, 1, 1)), "");
  EXPECT_EQ(refusal(diagonal(1, -1, -1)), "");
  EXPECT_EQ(refusal(diagonal(1, 2, 1)), "the pose scales: column 1 of its rotation is 2 long, not 1");
  EXPECT_NE(refusal(diagonal(1 + 1e-9, 1, 1)).find("scales: column 0"), std::string::npos);
  EXPECT_NE(refusal(diagonal(1, 1, -1)).find("reflects"), std::string::npos);
  Pose sheared;
  sheared.rotation(0, 1) = 1e-5;
  EXPECT_NE(refusal(sheared).find("shears: columns 0 and 1"), std::string::npos);
  EXPECT_NE(refusal(diagonal(std::nan(""), 1, 1)).find("not finite"), std::string::npos);
  EXPECT_NE(refusal({Eigen::Matrix3d::Identity(), {0, HUGE_VAL, 0}}).find("translation"), std::string::npos);
}

TEST(Pose, TakesWhatRoundingLeavesOfAMillionRotations) {
  Pose pose;
  const Pose step = pose_of({0, 0, 0}, 0.9, 0.1, -0.3, 0.2);
  for (int i = 0; i < 1'000'000; ++i) pose.rotation = (step.rotation * pose.rotation).eval();
  EXPECT_EQ(refusal(pose), "");
  EXPECT_NE(pose.rotation.transpose() * pose.rotation, Eigen::Matrix3d::Identity());
}

/// At its end the ball's centre is (2, 2, 1) from a corner, which is the radius.
TEST(PosedTriangle, IsNotSaidToBeMissedWhereSquaresAreBeyondTheRangeOfDouble) {
  const Pose rest;
  for (const double unit : {1.0, 0x1p240, 0x1p255, 0x1p285}) {
    const PosedTriangle triangle{{Vec3(0, 0, unit), Vec3(0, 0, -unit), Vec3(3 * unit, -3 * unit, -unit)},
                                 &rest};
    const Vec3 from = unit * Vec3(1, 4, 3), to = unit * Vec3(2, 2, 2);
    EXPECT_NE(within_by_sides(triangle, from, to, 3 * unit), false) << unit;
    EXPECT_TRUE(path_within_exactly(triangle, from, to, 1, 3 * unit)) << unit;
  }
}

}  // namespace
}  // namespace touchmark
