// Answers about a body that moves, right and wrong ones, whose verdicts are known from geometry.
#include "bench/oracle/moving_judge.h"

#include <cmath>
#include <memory>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "core/triangle_mesh.h"

namespace touchmark::bench::oracle {
namespace {

Pose at(double z) { return {Eigen::Matrix3d::Identity(), {0, 0, z}}; }
Pose turned(double angle) {
  return {Eigen::AngleAxisd(angle, Vec3::UnitX()).toRotationMatrix(), Vec3::Zero()};
}

/// The verdict on a fraction, or on no hit, where a square goes from pose to pose.
ErrorCounts judged(const Pose& before, const Pose& after, const Sweep& sweep,
                   std::optional<double> fraction) {
  const TriangleMesh square({{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}}, {{0, 1, 2}, {0, 2, 3}});
  SceneOracle oracle({std::make_shared<const TriangleMesh>(square)}, {{0, after}});
  BodyScrew screw(0, before);
  EXPECT_TRUE(screw.goes_to(after));
  const workload::Answer answer =
      fraction ? workload::Answer::of({Vec3::Zero(), Vec3::UnitZ(), sweep.radius, 0}, *fraction)
               : workload::Answer{};
  return judge_moving(oracle, std::vector{screw}, sweep, answer);
}

TEST(MovingJudge, ChargesWhatIsLateMissedOrTooEarly) {
  for (const double radius : {0.0, 0.25}) {
    const Sweep rest{{0.1, 0.2, 0}, {0.1, 0.2, 0}, radius};
    const double true_fraction = (3 - radius) / 7;  // from 3 below to 4 above
    EXPECT_FALSE(judged(at(-3), at(4), rest, true_fraction - 1e-9).charged()) << radius;
    EXPECT_EQ(judged(at(-3), at(4), rest, std::nullopt).missed, 1u) << radius;
    EXPECT_EQ(judged(at(-3), at(4), rest, true_fraction + 0.01).missed, 1u) << radius;
    EXPECT_EQ(judged(at(-3), at(4), rest, true_fraction - 0.01).false_contacts, 1u) << radius;
    EXPECT_FALSE(judged(at(-3), at(-1), rest, std::nullopt).charged()) << radius;
    EXPECT_EQ(judged(at(-3), at(-1), rest, 0.5).false_contacts, 1u) << radius;
  }
}

TEST(MovingJudge, FollowsATurn) {
  // A point half off the axis, over the square by 30 degrees of a turn by 60.
  const double angle = std::acos(-1.0) / 6;
  const Vec3 place(0.2, 0.5 * std::cos(angle), 0.5 * std::sin(angle));
  for (const double radius : {0.0, 0.1}) {
    const double true_fraction = (angle - std::asin(radius / 0.5)) / (2 * angle);
    const Sweep rest{place, place, radius};
    EXPECT_FALSE(judged(turned(0), turned(2 * angle), rest, true_fraction - 1e-9).charged()) << radius;
    EXPECT_EQ(judged(turned(0), turned(2 * angle), rest, std::nullopt).missed, 1u) << radius;
    EXPECT_EQ(judged(turned(0), turned(2 * angle), rest, true_fraction - 0.01).false_contacts, 1u) << radius;
  }
}

}  // namespace
}  // namespace touchmark::bench::oracle
