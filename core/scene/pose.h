/// The place of a body: a rotation and a translation, twelve stored doubles.
///
/// The image of a body's point x is rotation * x + translation, in exact arithmetic on the doubles as they
/// are stored; nothing is normalised behind the caller's back. Names what is refused.
#pragma once

#include <stdexcept>

#include <Eigen/Core>

#include "core/probe.h"
#include "core/visible.h"

namespace touchmark {

/// Thrown when a pose cannot be used; the message names what is wrong and by how much.
class TOUCHMARK_VISIBLE PoseError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A rigid motion from a body's frame to the scene's.
struct Pose {
  Eigen::Matrix3d rotation = Eigen::Matrix3d::Identity();
  Vec3 translation = Vec3::Zero();

  /// Are all twelve numbers the same?
  friend bool operator==(const Pose& a, const Pose& b) noexcept {
    return a.rotation == b.rotation && a.translation == b.translation;
  }
};

/// The pose of a position and a quaternion w + xi + yj + zk of any length, computed in double in this order:
/// n = w w + x x + y y + z z, s = 2 / n, and the rotation is
///
///     1 - s (y y + z z)   s (x y - w z)       s (x z + w y)
///     s (x y + w z)       1 - s (x x + z z)   s (y z - w x)
///     s (x z - w y)       s (y z + w x)       1 - s (x x + y y)
///
/// Throws PoseError for numbers that are not finite and for a quaternion whose n is 0, infinite or below
/// 2^-500.
Pose pose_of(const Vec3& position, double w, double x, double y, double z);

/// How far a rotation may be off orthonormal: its rigid_error. What rounding leaves of a million products of
/// rotations is less; a matrix in single precision is more.
inline constexpr double max_rigid_error = 0x1p-32;

/// Returns how far the rotation stretches or shrinks any vector, at most and relatively: a bound of
/// |singular value - 1|, rounding of the bound included.
double rigid_error(const Eigen::Matrix3d& rotation) noexcept;

/// Throws PoseError for a pose that is not rigid but for rounding, saying which: a number that is not finite,
/// a reflection, a scale, a shear. Returns rigid_error of its rotation.
double expect_rigid(const Pose& pose);

/// The image of a body's point, rounded.
Vec3 image(const Pose& pose, const Vec3& point) noexcept;
/// A scene's point as the body sees it, rounded: by the transpose of the rotation.
Vec3 in_frame(const Pose& pose, const Vec3& point) noexcept;

}  // namespace touchmark
