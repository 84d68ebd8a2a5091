/// An axis-aligned box; empty until something is put in.
#pragma once

#include <limits>
#include <span>

#include "core/probe.h"

namespace touchmark {

/// An axis-aligned box, given by two of its corners.
struct Aabb {
  Vec3 min = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 max = Vec3::Constant(-std::numeric_limits<double>::infinity());

  bool empty() const noexcept { return !(min.x() <= max.x()); }
  void extend(const Vec3& point) noexcept {
    min = min.cwiseMin(point);
    max = max.cwiseMax(point);
  }
  void extend(const Aabb& other) noexcept {
    min = min.cwiseMin(other.min);
    max = max.cwiseMax(other.max);
  }
  Aabb padded(double by) const noexcept { return {min - Vec3::Constant(by), max + Vec3::Constant(by)}; }
  Vec3 extent() const noexcept { return max - min; }
  Vec3 center() const noexcept { return min + 0.5 * (max - min); }
  double diagonal() const noexcept;
  bool contains(const Vec3& point) const noexcept {
    return (point.array() >= min.array()).all() && (point.array() <= max.array()).all();
  }
  /// Is the gap between the boxes at most this along every axis? Never one to an empty box. By differences,
  /// which lose nothing far from the origin.
  bool comes_within(double gap, const Aabb& other) const noexcept {
    return ((min - other.max).array() <= gap).all() && ((other.min - max).array() <= gap).all();
  }
  /// The vector from the box to the point, zero inside.
  Vec3 excess(const Vec3& point) const noexcept {
    return (min - point).cwiseMax(point - max).cwiseMax(Vec3::Zero());
  }
  double squared_distance(const Vec3& point) const noexcept;
};

/// Is one of the boxes at most this far from the point?
bool any_within(std::span<const Aabb> boxes, const Vec3& point, double distance) noexcept;

}  // namespace touchmark
