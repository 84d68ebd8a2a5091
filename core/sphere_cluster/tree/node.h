/// How the hierarchy lies in memory: wide nodes and blocks of triangles, in single precision and as plain
/// arrays, so that one instruction tests several children or triangles.
///
/// Everything is in the tree's frame: the mesh's box centre at 0, its extent near 1 (FilterFrame of
/// core/search/plane_filter.h), so that nothing overflows.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <type_traits>
#include <utility>
#include <vector>

#include "core/geometry/point_triangle.h"
#include "core/sphere_cluster/tree/unbuilt_parts.h"

namespace touchmark::spheres {

inline constexpr std::uint32_t tree_width = 8;

/// A child: a node, or block b of the triangles, those from 8 b on, or a part of the tree that may not be
/// built yet (lazy_builder.h). All blocks are full but the last.
struct TreeRef {
  static constexpr std::uint32_t block_bit = 0x80000000U, part_bit = 0x40000000U;
  std::uint32_t bits;

  bool is_block() const noexcept { return (bits & block_bit) != 0; }
  bool is_part() const noexcept { return (bits & part_bit) != 0; }
  std::uint32_t index() const noexcept { return bits & ~(block_bit | part_bit); }
};

/// Up to eight children, each bounded by a cylinder: the points within `radius` of the axis through the
/// centre along `normal`, and within `half` of the centre along it. A patch of a surface is as flat as a
/// coin or as long as a rod, and fills such a cylinder better than a sphere. In a tree of boxes (TreeParts)
/// `half`, `radius` and `normal_x` are half the extents along x, y and z, and the rest says nothing.
struct alignas(64) TreeNode {
  float x[tree_width], y[tree_width], z[tree_width], radius[tree_width];
  float normal_x[tree_width], normal_y[tree_width], normal_z[tree_width], half[tree_width];
  TreeRef child[tree_width];

  /// Puts nothing there, infinitely far away.
  void clear(std::size_t i) noexcept {
    x[i] = y[i] = z[i] = radius[i] = normal_x[i] = normal_y[i] = normal_z[i] = 0;
    half[i] = -std::numeric_limits<float>::infinity();
    child[i] = {0};
  }
};

/// Eight triangles as planes (TrianglePlanes): plane k of triangle i has the value
/// x[k][i] px + y[k][i] py + z[k][i] pz + offset[k][i] at p. What fills up the last block is infinitely far.
struct alignas(64) TriangleBlock {
  float x[4][tree_width], y[4][tree_width], z[4][tree_width], offset[4][tree_width];
};

/// Leaves elements as they are until they are set: most memory of a tree that is built lazily is not touched
/// before a query is there.
template <class T>
struct UnsetAllocator : std::allocator<T> {
  template <class Other>
  struct rebind {
    using other = UnsetAllocator<Other>;
  };
  /// Does nothing: a type without a destructor, all of whose members are set before they are read, needs
  /// nothing.
  template <class U>
  void construct(U*) noexcept {
    static_assert(std::is_trivially_destructible_v<U>);
  }
  template <class U, class... Arguments>
  void construct(U* at, Arguments&&... arguments) {
    ::new (static_cast<void*>(at)) U(std::forward<Arguments>(arguments)...);
  }
};
template <class T>
using UnsetVector = std::vector<T, UnsetAllocator<T>>;

struct TreeParts {
  UnbuiltParts unbuilt;         ///< comes first: a copy has what was built when it began
  UnsetVector<TreeNode> nodes;  ///< the root comes first
  UnsetVector<TriangleBlock> blocks;
  UnsetVector<PreparedTriangle> triangles;  ///< in the order of the blocks
  bool boxes = false;                       ///< true: children are bounded by boxes instead of cylinders
  /// From so far on, squared, a closer look at corners pays: many triangles are nearly as near.
  float far = std::numeric_limits<float>::infinity();
};

}  // namespace touchmark::spheres
