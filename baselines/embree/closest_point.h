/// The closest point of a triangle in single precision, by the regions of its corners, edges and face: what
/// Embree's tutorial closest_point has its callback do (Ericson, "Real-Time Collision Detection", 5.1.5).
#pragma once

#include <array>

#include <Eigen/Core>

namespace touchmark::baselines {

/// A triangle without area, or too thin for floats, gets whatever the divisions leave.
inline Eigen::Vector3f closest_point(const std::array<Eigen::Vector3f, 3>& corner, const Eigen::Vector3f& p) {
  const auto& [a, b, c] = corner;
  const Eigen::Vector3f ab = b - a, ac = c - a;
  const Eigen::Vector3f from_a = p - a;
  const float ab_a = ab.dot(from_a), ac_a = ac.dot(from_a);
  if (ab_a <= 0 && ac_a <= 0) return a;
  const Eigen::Vector3f from_b = p - b;
  const float ab_b = ab.dot(from_b), ac_b = ac.dot(from_b);
  if (ab_b >= 0 && ac_b <= ab_b) return b;
  const Eigen::Vector3f from_c = p - c;
  const float ab_c = ab.dot(from_c), ac_c = ac.dot(from_c);
  if (ac_c >= 0 && ab_c <= ac_c) return c;
  const float over_c = ab_a * ac_b - ab_b * ac_a;
  if (over_c <= 0 && ab_a >= 0 && ab_b <= 0) return a + ab_a / (ab_a - ab_b) * ab;
  const float over_b = ab_c * ac_a - ab_a * ac_c;
  if (over_b <= 0 && ac_a >= 0 && ac_c <= 0) return a + ac_a / (ac_a - ac_c) * ac;
  const float over_a = ab_b * ac_c - ab_c * ac_b;
  const float towards_c = ac_b - ab_b, towards_b = ab_c - ac_c;
  if (over_a <= 0 && towards_c >= 0 && towards_b >= 0)
    return b + towards_c / (towards_c + towards_b) * (c - b);
  const float all = over_a + over_b + over_c;
  return a + over_b / all * ab + over_c / all * ac;
}

}  // namespace touchmark::baselines
