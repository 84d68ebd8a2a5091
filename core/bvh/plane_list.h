/// The triangles within a ball, each behind a plane that bounds its distance all around.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/bvh/node.h"
#include "core/probe.h"

namespace touchmark::bvh {

/// A move of the mesh's frame in the tree's.
struct MoveInFrame {
  float x, y, z;

  MoveInFrame(const Vec3& move, double scale) noexcept
      : x(static_cast<float>(move.x() * scale)),
        y(static_cast<float>(move.y() * scale)),
        z(static_cast<float>(move.z() * scale)) {}
  float along(float other_x, float other_y, float other_z) const noexcept {
    return other_x * x + other_y * y + other_z * z;
  }
};

/// Triangle i is at least bound[i] + (x[i], y[i], z[i]) . d from where is d away from the list's centre, with
/// (x, y, z) a unit vector, or 0; in the tree's frame: docs/exactness.md, E14. WideBvh::list_near fills it,
/// and may write `Spare` places beyond the capacity: a block's worth.
template <std::uint32_t Capacity, std::uint32_t Spare = width>
struct PlaneList {
  static constexpr std::uint32_t capacity = Capacity, padded_capacity = Capacity + Spare;
  /// The most nodes and blocks that are looked into.
  static constexpr std::uint32_t max_queue = 4 * capacity;
  /// A long list begins a cache line; a short one lies in as few as can be.
  static constexpr std::size_t alignment = capacity > 16 ? 64 : alignof(float);

  std::uint32_t count = 0;
  float unlisted = std::numeric_limits<float>::max();  ///< what is not listed is no nearer, squared
  alignas(alignment) std::uint32_t slot[padded_capacity];
  alignas(alignment) float bound[padded_capacity], x[padded_capacity], y[padded_capacity], z[padded_capacity];

  void start_anew() noexcept {
    count = 0;
    unlisted = std::numeric_limits<float>::max();
  }
  /// Puts the triangle of another list in a place.
  template <class List>
  void copy(std::uint32_t to, const List& from, std::uint32_t i) noexcept {
    slot[to] = from.slot[i];
    bound[to] = from.bound[i];
    x[to] = from.x[i];
    y[to] = from.y[i];
    z[to] = from.z[i];
  }
  /// Fills the places up to `end` with what is infinitely far.
  void fill_up(std::uint32_t end) noexcept {
    for (std::uint32_t i = count; i < end; ++i) {
      slot[i] = 0;
      bound[i] = std::numeric_limits<float>::infinity();
      x[i] = y[i] = z[i] = 0;
    }
  }
};

}  // namespace touchmark::bvh
