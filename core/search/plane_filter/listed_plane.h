/// The plane that a listed triangle stands behind, after the triangle was measured.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/geometry/point_triangle.h"
#include "core/probe.h"

namespace touchmark {

/// Puts triangle i of a list behind the plane across the offset that was found from it, whose error is
/// bounded. Its bound is then about `point`, from where the offset need not be: a bound that were moved there
/// in single precision would be off by a part of the move. `scale` is the frame's. Returns false, and changes
/// nothing, where the offset is too short to have a direction.
template <class List>
bool set_plane_across(List& list, std::uint32_t i, const PreparedTriangle& triangle, const Vec3& point,
                      const Offset& found, double error, double scale) noexcept {
  const double distance = std::sqrt(found.squared);
  if (!(distance > error)) return false;
  const Vec3 away = found.vector / distance;
  list.x[i] = static_cast<float>(away.x());
  list.y[i] = static_cast<float>(away.y());
  list.z[i] = static_cast<float>(away.z());
  const Vec3 rounded(double{list.x[i]}, double{list.y[i]}, double{list.z[i]});
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& corner : triangle.corner) least = std::min(least, rounded.dot(point - corner));
  list.bound[i] = static_cast<float>((least - error) * scale);
  return true;
}

}  // namespace touchmark
