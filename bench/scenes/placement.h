/// The place of a body as files write it: a position and a quaternion. core/scene/pose.h makes a matrix of
/// it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/probe.h"
#include "core/scene/pose.h"

namespace touchmark::bench::scenes {

/// w, x, y, z.
using Quaternion = std::array<double, 4>;

struct Placement {
  Vec3 position = Vec3::Zero();
  Quaternion orientation{1, 0, 0, 0};  ///< finite and not zero; its length does not matter
};

inline double dot(const Quaternion& a, const Quaternion& b) noexcept {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2] + a[3] * b[3];
}

/// A quaternion whose squares are doubles: itself, or where they would leave that range divided by the
/// largest of its numbers. It must be finite and not zero.
inline Quaternion in_range(Quaternion q) noexcept {
  constexpr double least = 0x1p-200, most = 0x1p200;
  double largest = 0;
  for (const double x : q) largest = std::max(largest, std::abs(x));
  if (largest >= least && largest <= most) return q;
  for (double& x : q) x /= largest;
  return q;
}

/// Returns q / sqrt(w^2 + x^2 + y^2 + z^2). It must be finite and not zero.
inline Quaternion normalized(Quaternion q) noexcept {
  q = in_range(q);
  const double norm = std::sqrt(dot(q, q));
  for (double& x : q) x /= norm;
  return q;
}

/// Returns the matrix of the position and the quaternion, which may have any length: see core/scene/pose.h.
inline Pose pose_of(const Placement& placement) {
  const Quaternion q = in_range(placement.orientation);
  return touchmark::pose_of(placement.position, q[0], q[1], q[2], q[3]);
}

/// Returns the quaternion that turns by b first, then by a.
inline Quaternion product(const Quaternion& a, const Quaternion& b) noexcept {
  return {a[0] * b[0] - a[1] * b[1] - a[2] * b[2] - a[3] * b[3],
          a[0] * b[1] + a[1] * b[0] + a[2] * b[3] - a[3] * b[2],
          a[0] * b[2] - a[1] * b[3] + a[2] * b[0] + a[3] * b[1],
          a[0] * b[3] + a[1] * b[2] - a[2] * b[1] + a[3] * b[0]};
}

/// Returns the placement at a part from 0 to 1 of the way from one to another: the position on the straight
/// line, (1 - part) a + part b, the orientation by slerp of both, normalised, the shorter way round.
inline Placement between(const Placement& from, const Placement& to, double part) noexcept {
  Placement middle;
  middle.position = (1 - part) * from.position + part * to.position;
  const Quaternion a = normalized(from.orientation), b = normalized(to.orientation);
  const double cosine = dot(a, b), sign = cosine < 0 ? -1 : 1;
  double of_a = 1 - part, of_b = part;
  constexpr double nearly_alike = 1 - 1e-9;  // from there on the chord is the arc to the last digit
  if (std::abs(cosine) < nearly_alike) {
    const double angle = std::acos(std::abs(cosine)), sine = std::sin(angle);
    of_a = std::sin((1 - part) * angle) / sine;
    of_b = std::sin(part * angle) / sine;
  }
  for (std::size_t i = 0; i < 4; ++i) middle.orientation[i] = of_a * a[i] + sign * of_b * b[i];
  middle.orientation = normalized(middle.orientation);
  return middle;
}

}  // namespace touchmark::bench::scenes
