/// What a haptic point remembers of the hierarchy: the blocks of triangles near it, so that the next ticks
/// need not descend from the root.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/probe.h"
#include "core/sphere_cluster/tree_layout.h"

namespace touchmark::spheres {

/// The blocks are kept as children of nodes of the point's own, so that their bounds are as good at the next
/// ticks as they are in the tree. A block that is not listed was at least `rest` from `anchor`.
struct NearBlocks {
  static constexpr std::uint32_t groups = 4, capacity = groups * tree_width;

  Vec3 anchor = Vec3::Zero();  ///< in the tree's frame, as all lengths here
  float rest = -1;             ///< nothing is known
  std::uint32_t count = 0;
  std::array<float, capacity> bound;  ///< of the distance from the anchor
  std::array<TreeNode, groups> nodes;

  /// Everything nearer than `limit` is going to be added.
  void start(const Vec3& at, float limit) noexcept {
    anchor = at;
    rest = limit;
    count = 0;
  }
  /// What was listed is not all there is.
  void forget() noexcept { rest = -1; }
  /// When there is no room, the farthest block goes.
  void add(const TreeNode& from, std::size_t child, float distance) noexcept {
    std::uint32_t place = count;
    if (count == capacity) {
      place = static_cast<std::uint32_t>(std::max_element(bound.begin(), bound.end()) - bound.begin());
      rest = std::min(rest, std::max(bound[place], distance));
      if (!(distance < bound[place])) return;
    } else {
      ++count;
    }
    bound[place] = distance;
    nodes[place / tree_width].copy(place % tree_width, from, child);
  }
  /// Clears the places after the last one in its node.
  void finish() noexcept {
    for (std::uint32_t i = count; i % tree_width != 0; ++i) nodes[i / tree_width].clear(i % tree_width);
  }
};

}  // namespace touchmark::spheres
