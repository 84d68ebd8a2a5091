/// One plane that stands for the surface in a cube, and which triangles are near it.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "core/probe.h"

namespace touchmark::field {

/// As it is kept in memory, before the names of the triangles.
struct StoredPlane {
  std::array<float, 2> along{};     ///< the normal's lesser coordinates; the third makes it a unit vector
  float offset = 0;                 ///< height of the cube's lowest corner above the plane, mesh units
  std::array<float, 2> first{};     ///< the grid begins here
  std::array<float, 2> per_edge{};  ///< so many squares of the grid are in an edge of the smallest cube
  std::uint16_t near = 0;           ///< so many triangles are named, at most 256
  std::uint8_t bits = 0;            ///< so many squares are along each side of the grid: 2^bits
  std::uint8_t across = 0;          ///< the normal's greatest coordinate; 4 more where that is negative
};
inline constexpr std::size_t words_of_plane = sizeof(StoredPlane) / sizeof(std::uint32_t);

/// Places are in a cube, from its lowest corner, in edges of the octree's smallest cube. A square grid lies
/// over the feet of the cube's points on the plane, as seen along the axis that the normal is closest to:
/// each of its squares names a triangle.
struct PlaneCell {
  static constexpr std::uint8_t max_bits = 4;

  StoredPlane stored;
  Vec3 normal = Vec3::Zero();  ///< unit
  std::array<int, 2> axes{};   ///< along which the grid's coordinates are

  PlaneCell() = default;
  explicit PlaneCell(const StoredPlane& plane) noexcept : stored(plane) {
    const int across = plane.across & 3;
    axes = {across == 0 ? 1 : 0, across == 2 ? 1 : 2};
    const double a = static_cast<double>(plane.along[0]), b = static_cast<double>(plane.along[1]);
    normal[axes[0]] = a;
    normal[axes[1]] = b;
    normal[across] = std::copysign(std::sqrt(1 - (a * a + b * b)), plane.across < 4 ? 1.0 : -1.0);
  }
  /// Returns the plane with this normal, up to rounding, whose other members are not yet known.
  static PlaneCell across(const Vec3& unit_normal) noexcept {
    int across = 0;
    unit_normal.cwiseAbs().maxCoeff(&across);
    StoredPlane plane;
    plane.across = static_cast<std::uint8_t>(unit_normal[across] < 0 ? across + 4 : across);
    plane.along = {static_cast<float>(unit_normal[across == 0 ? 1 : 0]),
                   static_cast<float>(unit_normal[across == 2 ? 1 : 2])};
    return PlaneCell(plane);
  }

  /// Returns how far the place is above the plane, in mesh units: negative below.
  double height(const Vec3& place, double unit) const noexcept {
    return normal.dot(place) * unit + static_cast<double>(stored.offset);
  }
  /// Returns the square that the foot of a place at this height, here in edges, is in; the first coordinate
  /// runs first.
  std::uint32_t square_of(const Vec3& place, double height) const noexcept {
    return (coordinate(1, place, height) << stored.bits) + coordinate(0, place, height);
  }
  std::uint32_t squares() const noexcept { return 1U << 2 * stored.bits; }

  /// Behind the plane are the triangles named, a word each, and then for each square which of them it is.
  std::size_t words() const noexcept {
    return words_of_plane + stored.near + (squares() * bits_of_name() + 31) / 32;
  }
  std::uint32_t bits_of_name() const noexcept { return stored.near <= 16 ? 4 : 8; }

 private:
  std::uint32_t coordinate(std::size_t side, const Vec3& place, double height) const noexcept {
    const double foot = place[axes[side]] - height * normal[axes[side]];
    const double at =
        (foot - static_cast<double>(stored.first[side])) * static_cast<double>(stored.per_edge[side]);
    return static_cast<std::uint32_t>(std::clamp(static_cast<std::int32_t>(at), 0, (1 << stored.bits) - 1));
  }
};

}  // namespace touchmark::field
