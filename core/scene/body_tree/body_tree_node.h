/// A node of the tree of bodies' boxes, as its search reads it.
#pragma once

#include <array>
#include <cstdint>
#include <limits>

namespace touchmark::body_tree {

using Ref = std::uint32_t;  ///< a node, or a body as a child of a node of level 0
inline constexpr Ref none = std::numeric_limits<Ref>::max();
inline constexpr std::uint32_t width = 16;
/// A node but the root has so many children at least, so no tree of 2^32 bodies is higher than this.
inline constexpr std::uint32_t fewest = 2, max_height = 32;

struct Node {
  std::array<std::array<float, width>, 3> min{}, max{};  ///< the children's boxes, by coordinate
  std::array<Ref, width> child{};
  Ref parent = none;
  std::uint8_t slot = 0;   ///< which child of its parent it is
  std::uint8_t count = 0;  ///< children are the first ones
  std::uint8_t level = 0;  ///< above bodies 0
};

/// Is called for a body, and returns the limit to go on with.
struct Visit {
  void* object;
  double (*call)(void* object, std::uint32_t body) noexcept;
};

}  // namespace touchmark::body_tree
