/// How far a shape reaches in any direction, bounded from above: what gives posed bodies boxes that fit.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/probe.h"

namespace touchmark {

/// The support function h(u) = max u . (x - c) of points x about a centre c, at places of a cube's surface.
///
/// h is convex, and positively homogeneous, so between places it is no more than what interpolates them: u is
/// a sum of the four places around it with the weights of bilinear interpolation.
class SupportTable {
 public:
  /// The radius bounds how far the points are from the centre; `beyond` is how far the shape reaches beyond
  /// the points.
  SupportTable(std::span<const Vec3> points, const Vec3& center, double radius, double beyond);

  /// Returns at least h(u), roundings included, for a direction of about unit length.
  double along(const Vec3& direction) const noexcept;

 private:
  static constexpr std::size_t cells = 4, places = cells + 1;
  using Face = std::array<std::array<float, places>, places>;

  static constexpr double coordinate(std::size_t place) noexcept {
    return -1 + 2 * static_cast<double>(place) / static_cast<double>(cells);
  }

  std::array<std::array<Face, 2>, 3> faces_;  ///< by axis, of its positive and its negative side
  double pad_;
};

}  // namespace touchmark
