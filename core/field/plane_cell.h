/// One plane that stands for the surface in a cube, and which triangles are near it.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/probe.h"

namespace touchmark::field {

/// Places are in a cube, from its lowest corner, in edges of the octree's smallest cube. A square grid of
/// names lies over the feet of the cube's points on the plane.
struct PlaneCell {
  static constexpr std::uint8_t most_bits = 4;

  Vec3 normal = Vec3::Zero();  ///< unit
  /// A place's coordinates on the grid, in its squares: three factors, and what the corner has.
  std::array<std::array<float, 4>, 2> to_grid{};
  float offset = 0;        ///< height of the cube's lowest corner above the plane, mesh units
  std::uint16_t near = 0;  ///< so many triangles are named, at most 256
  std::uint8_t bits = 0;   ///< so many squares are along each side: 2^bits

  /// Returns how far the place is above the plane, in mesh units: negative below.
  double height(const Vec3& place, double unit) const noexcept {
    return normal.dot(place) * unit + static_cast<double>(offset);
  }
  /// Returns the square that the place's foot is in; the first coordinate runs first.
  std::uint32_t square_of(const Vec3& place) const noexcept {
    return (coordinate(1, place) << bits) + coordinate(0, place);
  }
  std::size_t squares() const noexcept { return std::size_t{1} << 2 * bits; }

 private:
  std::uint32_t coordinate(std::size_t side, const Vec3& place) const noexcept {
    const std::array<float, 4>& to = to_grid[side];
    const float at = to[0] * static_cast<float>(place.x()) + to[1] * static_cast<float>(place.y()) +
                     (to[2] * static_cast<float>(place.z()) + to[3]);
    const std::int32_t last = (1 << bits) - 1;
    return static_cast<std::uint32_t>(std::clamp(static_cast<std::int32_t>(at), 0, last));
  }
};
static_assert(sizeof(PlaneCell) == 64);

}  // namespace touchmark::field
