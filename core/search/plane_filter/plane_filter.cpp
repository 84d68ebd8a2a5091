#include "core/search/plane_filter/plane_filter.h"

#include <algorithm>

#include <Eigen/Geometry>

namespace touchmark {

bool FilterFrame::fits(const Aabb& bounds) noexcept {
  const double extent = bounds.extent().maxCoeff();
  return extent > 0x1p-130 && extent < 0x1p200;
}

FilterFrame FilterFrame::around(const Aabb& bounds) noexcept {
  FilterFrame frame;
  const Vec3 half = 0.5 * bounds.extent();
  frame.origin_ = bounds.center();
  frame.scale_ = std::ldexp(1.0, -std::ilogb(half.maxCoeff()) - 1);
  frame.unit_ = 1 / frame.scale_;
  frame.squared_scale_ = frame.scale_ * frame.scale_;
  frame.radius_ = frame.radius_of(bounds);
  return frame;
}

/// Far from 0 the origin is the box's middle but for its rounding, which may be as much as the extent.
double FilterFrame::radius_of(const Aabb& bounds) const noexcept {
  const Vec3 farthest = (bounds.min - origin_).cwiseAbs().cwiseMax((bounds.max - origin_).cwiseAbs());
  return scale_ * farthest.norm();
}

bool FilterFrame::widen(const Aabb& bounds) noexcept {
  // A frame around a box has an extent of 1 to 2, and so a radius of 0.5 to 1.8.
  constexpr double largest_radius = 2, min_extent = 0.5;
  const double radius = radius_of(bounds);
  if (!(radius <= largest_radius) || !(scale_ * bounds.extent().maxCoeff() >= min_extent)) return false;
  radius_ = std::max(radius_, radius);
  return true;
}

namespace {

/// In the frame, whose coordinates are below 2: their roundings, 2^-53 of a corner's, turn a side as long as
/// this by u / 2 at most.
constexpr double shortest_side = 0x1p-26;

}  // namespace

TrianglePlanes planes_of(const PreparedTriangle& triangle, const FilterFrame& frame) noexcept {
  TrianglePlanes planes{};
  if (triangle.normal.isZero(0)) return planes;
  const auto set_plane = [&](int lane, const Vec3& normal, double offset) {
    planes.x[lane] = static_cast<float>(normal.x());
    planes.y[lane] = static_cast<float>(normal.y());
    planes.z[lane] = static_cast<float>(normal.z());
    planes.offset[lane] = static_cast<float>(offset);
  };
  std::array<Vec3, 3> v;
  for (std::size_t i = 0; i < 3; ++i) v[i] = frame.scale() * (triangle.corner[i] - frame.origin());
  set_plane(0, triangle.normal, -triangle.normal.dot(v[0]));
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 side = v[(i + 1) % 3] - v[i];
    const double length = side.norm();
    // A side too short for a direction bounds nothing: the other sides and the face still do.
    if (!(length > shortest_side)) {
      set_plane(static_cast<int>(i) + 1, Vec3::Zero(), 0);
      continue;
    }
    const Vec3 outward = side.cross(triangle.normal) * (1 / length);
    // The farthest corner, not the side's own: rounding must not leave one outside.
    const double farthest = std::max({outward.dot(v[0]), outward.dot(v[1]), outward.dot(v[2])});
    set_plane(static_cast<int>(i) + 1, outward, -farthest);
  }
  return planes;
}

}  // namespace touchmark
