#include "core/scene/pose_change.h"

#include <bit>
#include <cmath>
#include <cstdint>

#include <gtest/gtest.h>

#include "tests/core/scene/random_pose.h"

namespace touchmark {
namespace {

using test::Random;

/// A pose that is this one, turned and shifted by about so much.
Pose moved(Random& random, const Pose& from, double size) {
  const Vec3 axis = size * random.point();
  Pose to = from;
  to.rotation = pose_of({0, 0, 0}, 1, axis.x(), axis.y(), axis.z()).rotation * from.rotation;
  to.translation += size * random.point();
  return to;
}

bool accepted(const Pose& pose) {
  try {
    expect_rigid(pose);
  } catch (const PoseError&) {
    return false;
  }
  return true;
}

PoseChange change(const Pose& from, const Pose& to) {
  return pose_change(from, to, {{1, 2, 3}, 2, 6}, widest_simd());
}

class PoseChanges : public testing::Test {
 protected:
  /// Calls visit(from, to, ball) for moves of all sizes, near and far from the origin.
  template <class Visit>
  static void for_each(const Visit& visit) {
    Random random(23);
    for (int i = 0; i < 20'000; ++i) {
      const double far = std::exp2(random.between(-20, 20)), size = std::exp2(random.between(-40, 4));
      const Pose from = test::random_pose(random, random.point(far));
      const Vec3 center = random.point(std::exp2(random.between(-10, 10)));
      visit(random, from, moved(random, from, size),
            ShapeBall{center, random.unit(), center.cwiseAbs().sum()});
    }
  }
};

TEST_F(PoseChanges, AllInstructionsGiveTheSameBits) {
  for_each([](Random&, const Pose& from, const Pose& to, const ShapeBall& ball) {
    const PoseChange plain = pose_change(from, to, ball, Simd::portable);
    const PoseChange wide = pose_change(from, to, ball, widest_simd());
    ASSERT_EQ(std::bit_cast<std::uint64_t>(plain.rigid), std::bit_cast<std::uint64_t>(wide.rigid));
    ASSERT_EQ(std::bit_cast<std::uint64_t>(plain.motion), std::bit_cast<std::uint64_t>(wide.motion));
    ASSERT_EQ(plain.is_rigid, wide.is_rigid);
  });
}

TEST_F(PoseChanges, NoPointOfTheBallMovesFarther) {
  for_each([](Random& random, const Pose& from, const Pose& to, const ShapeBall& ball) {
    const double motion = pose_change(from, to, ball, widest_simd()).motion;
    for (int i = 0; i < 8; ++i) {
      const Vec3 point = ball.center + ball.radius * random.direction();
      Eigen::Matrix<long double, 3, 1> way;
      for (int k = 0; k < 3; ++k) {
        way[k] = static_cast<long double>(to.translation[k]) - from.translation[k];
        for (int j = 0; j < 3; ++j)
          way[k] += (static_cast<long double>(to.rotation(k, j)) - from.rotation(k, j)) * point[j];
      }
      ASSERT_LE(static_cast<double>(way.norm()), motion);
    }
  });
}

TEST_F(PoseChanges, MotionIsNoMuchLongerThanTheWidest) {
  const Pose from, shifted{Eigen::Matrix3d::Identity(), {0, 3, 4}};
  EXPECT_NEAR(change(from, shifted).motion, 5, 1e-13);
  EXPECT_LT(change(from, from).motion, 1e-14);
}

TEST_F(PoseChanges, WhatIsRigidIsAcceptedAndBounded) {
  int rigid = 0;
  for_each([&](Random&, const Pose& from, const Pose& to, const ShapeBall& ball) {
    const PoseChange change = pose_change(from, to, ball, widest_simd());
    if (!change.is_rigid) return;
    ++rigid;
    ASSERT_TRUE(accepted(to));
    ASSERT_LE(std::abs(change.rigid - rigid_error(to.rotation)), 1e-14);
  });
  EXPECT_GT(rigid, 10'000);
}

TEST_F(PoseChanges, WhatIsNotRigidIsNotTakenForIt) {
  const Pose from;
  Pose reflected, scaled, sheared, nowhere, away;
  reflected.rotation(2, 2) = -1;
  scaled.rotation(1, 1) = 1 + 1e-9;
  sheared.rotation(0, 1) = 1e-5;
  nowhere.translation.y() = std::nan("");
  away.translation.z() = HUGE_VAL;
  for (const Pose& to : {reflected, scaled, sheared, nowhere, away}) {
    EXPECT_FALSE(accepted(to));
    EXPECT_FALSE(change(from, to).is_rigid);
    EXPECT_FALSE(pose_change(from, to, {}, Simd::portable).is_rigid);
  }
}

}  // namespace
}  // namespace touchmark
