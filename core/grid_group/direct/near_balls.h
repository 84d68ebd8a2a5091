/// The triangles gathered around one, with their balls as columns, so that several are looked at at once.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/aabb.h"
#include "core/grid_group/direct/box_tree.h"
#include "core/grid_group/direct/prism.h"
#include "core/grid_group/direct/triangle_store.h"

namespace touchmark::grid {

/// A box rounded inwards: to compare its sides with other floats is to compare those of the box itself.
struct FloatBounds {
  explicit FloatBounds(const Aabb& box) noexcept;

  std::array<float, 3> min, max;
};

struct NearBalls {
  /// It holds no more than these before a block is added.
  static constexpr std::size_t max_before = 384;
  static constexpr std::size_t capacity = max_before + TriangleStore::block_size;

  /// More is too much; no more slots than max_before.
  struct Most {
    std::uint64_t slots, boxes;
  };
  /// Holds afterwards all slots whose balls reach into the box, as those of all triangles do that reach into
  /// it, and nothing else. Returns false where that would be too many, or too many boxes are seen, which are
  /// counted in with those that were seen before.
  bool gather(const TriangleStore& store, const BoxTree& tree, const FloatBounds& box, const Most& most,
              std::uint64_t& boxes_seen) noexcept;
  /// Adds one slot.
  void add(const TriangleBall* balls, std::uint32_t slot) noexcept {
    slots[size] = slot;
    x[size] = balls[slot].x;
    y[size] = balls[slot].y;
    z[size] = balls[slot].z;
    radius[size++] = balls[slot].radius;
  }

  /// Room behind the last for a register's worth.
  template <class Number>
  using Column = std::array<Number, capacity + TriangleStore::block_size>;

  std::size_t size = 0;
  alignas(32) Column<std::uint32_t> slots{};
  alignas(32) Column<float> x{}, y{}, z{}, radius{};
};

/// Slots that a prism leaves open, and room behind the last for a look's worth.
using OpenSlots = std::array<std::uint32_t, NearBalls::capacity + Prism::triangles_a_look>;

/// Puts the slots of those balls into `open` that may hold what is nearest somewhere in the prism of these
/// corners, and returns how many these are. First come those whose balls meet the `own` one, as those of its
/// neighbours do.
std::size_t open_by_balls(const NearBalls& near, const std::array<BallLimit, 6>& corners,
                          const TriangleBall& own, OpenSlots& open) noexcept;

}  // namespace touchmark::grid
