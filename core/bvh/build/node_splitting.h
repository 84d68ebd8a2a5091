/// How a range of triangles becomes the children of a node.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

#include "core/bvh/build/binned_sah.h"
#include "core/bvh/node.h"

namespace touchmark::bvh {

/// Splits the range that is most likely to be looked into, again and again, until there are eight or none can
/// be split. Returns how many there are, in the splitter's order, so that the last block is the one that need
/// not be full.
inline std::size_t split_into(const TriangleSplitter& splitter, const TriangleRange& range,
                              std::array<TriangleRange, width>& children) noexcept {
  const std::uint32_t smallest = splitter.smallest();
  std::array<float, width> area;
  // Nobody asks for the area of a range that is not split.
  const auto area_of = [&](const TriangleRange& r) { return r.size() > smallest ? splitter.area(r) : 0.0F; };
  children[0] = range;
  area[0] = area_of(range);
  std::size_t count = 1;
  while (count < width) {
    std::size_t widest = count;
    for (std::size_t i = 0; i < count; ++i)
      if (children[i].size() > smallest && (widest == count || area[i] > area[widest])) widest = i;
    if (widest == count) break;
    const auto [left, right] = splitter.halves(children[widest]);
    children[widest] = left;
    children[count] = right;
    area[widest] = area_of(left);
    area[count] = area_of(right);
    ++count;
  }
  std::sort(children.begin(), children.begin() + count,
            [](const TriangleRange& a, const TriangleRange& b) { return a.begin < b.begin; });
  return count;
}

/// Splits a range into the children of a node, each of which is what child_of(range) returns; their bounds
/// are still to be set. child_of may add nodes.
template <class ChildOf>
void add_children(Parts& tree, std::uint32_t node, const TriangleSplitter& splitter,
                  const TriangleRange& range, const ChildOf& child_of) {
  std::array<TriangleRange, width> children;
  const std::size_t count = split_into(splitter, range, children);
  for (std::size_t i = count; i < width; ++i) tree.nodes[node].clear(i);
  for (std::size_t i = 0; i < count; ++i) {
    const ChildRef child = child_of(children[i]);  // which may move the nodes
    tree.nodes[node].set_child(i, child);
  }
}

}  // namespace touchmark::bvh
