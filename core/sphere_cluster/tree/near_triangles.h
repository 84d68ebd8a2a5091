/// The triangles within a ball, each behind a plane that bounds its distance all around.
#pragma once

#include <cstdint>
#include <limits>

#include "core/sphere_cluster/tree/node.h"

namespace touchmark::spheres {

/// Filled by `list_near` (near_triangles.inl), about a point of the tree's frame. A triangle is at least
/// bound + (x, y, z) . d from where is d away from that point.
template <std::uint32_t Capacity>
struct NearTrianglesUpTo {
  static constexpr std::uint32_t capacity = Capacity;
  /// A block's worth may be written where one triangle is to be added.
  static constexpr std::uint32_t padded_capacity = capacity + tree_width;
  /// The most nodes and blocks that are looked into.
  static constexpr std::uint32_t max_queue = 4 * capacity;

  std::uint32_t count = 0;
  float unlisted = std::numeric_limits<float>::max();  ///< what is not listed is no nearer, squared
  alignas(64) std::uint32_t slot[padded_capacity];
  alignas(64) float bound[padded_capacity], x[padded_capacity], y[padded_capacity], z[padded_capacity];
};
using NearTriangles = NearTrianglesUpTo<64>;

}  // namespace touchmark::spheres
