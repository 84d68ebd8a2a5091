#include "core/scene/pose.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <string>

#include "core/float_limits.h"

namespace touchmark {
namespace {

/// With enough digits to tell 1 from what is off by rounding.
std::string text(double number) {
  std::ostringstream out;
  out.precision(17);
  out << number;
  return out.str();
}

Eigen::Matrix3d off_identity(const Eigen::Matrix3d& rotation) noexcept {
  return rotation.transpose() * rotation - Eigen::Matrix3d::Identity();
}

/// Throws, naming what is wrong with the pose.
[[noreturn]] void refuse(const Pose& pose) {
  if (!pose.rotation.allFinite()) throw PoseError("the rotation has a number that is not finite");
  if (!pose.translation.allFinite()) throw PoseError("the translation has a number that is not finite");
  const Eigen::Matrix3d off = off_identity(pose.rotation);
  Eigen::Index row = 0, column = 0;
  off.cwiseAbs().maxCoeff(&row, &column);
  if (!(rigid_error(pose.rotation) <= max_rigid_error)) {
    if (row == column)
      throw PoseError("the pose scales: column " + std::to_string(row) + " of its rotation is " +
                      text(pose.rotation.col(row).norm()) + " long, not 1");
    throw PoseError("the pose shears: columns " + std::to_string(std::min(row, column)) + " and " +
                    std::to_string(std::max(row, column)) + " of its rotation have the product " +
                    text(off(row, column)) + ", not 0");
  }
  throw PoseError("the pose reflects: its rotation's determinant is " + text(pose.rotation.determinant()) +
                  ", not 1");
}

}  // namespace

Pose pose_of(const Vec3& position, double w, double x, double y, double z) {
  constexpr double least = 0x1p-500;
  const double n = w * w + x * x + y * y + z * z;
  if (!position.allFinite()) throw PoseError("the position is not finite");
  if (!(n >= least && std::isfinite(n)))
    throw PoseError("the quaternion's squared length is " + text(n) + ", which gives no rotation");
  const double s = 2 / n;
  Pose pose;
  pose.translation = position;
  pose.rotation << 1 - s * (y * y + z * z), s * (x * y - w * z), s * (x * z + w * y),  //
      s * (x * y + w * z), 1 - s * (x * x + z * z), s * (y * z - w * x),               //
      s * (x * z - w * y), s * (y * z + w * x), 1 - s * (x * x + y * y);
  return pose;
}

double rigid_error(const Eigen::Matrix3d& rotation) noexcept {
  // The singular values' squares are within the norm of this of 1, and so are they themselves. Frobenius'
  // norm is no less. Each entry is off by 3 u of the sum of its products' magnitudes, which is that of two
  // columns about 1 long, and by the difference's: by less than 5 u, nine of them by less than 15 u. It is
  // symmetric.
  const auto x = rotation.col(0), y = rotation.col(1), z = rotation.col(2);
  const double xx = x.dot(x) - 1, yy = y.dot(y) - 1, zz = z.dot(z) - 1;
  const double xy = x.dot(y), yz = y.dot(z), zx = z.dot(x);
  const double squared = xx * xx + yy * yy + zz * zz + 2 * (xy * xy + yz * yz + zx * zx);
  return 1.01 * std::sqrt(squared) + 16 * unit_roundoff;
}

double expect_rigid(const Pose& pose) {
  const double error = rigid_error(pose.rotation);
  // The determinant is within a few roundings of 1 or -1 then. What is not a number is not less either.
  if (error <= max_rigid_error && pose.rotation.determinant() > 0 && pose.translation.allFinite())
    return error;
  refuse(pose);
}

Vec3 image(const Pose& pose, const Vec3& point) noexcept { return pose.rotation * point + pose.translation; }

Vec3 in_frame(const Pose& pose, const Vec3& point) noexcept {
  return pose.rotation.transpose() * (point - pose.translation);
}

}  // namespace touchmark
