/// Triangles that the builder keeps together.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

#include "core/geometry/smallest_sphere.h"

namespace touchmark::bvh {

/// Cluster i holds the triangles members[first[i]] .. members[first[i + 1] - 1], and is split by its sphere's
/// centre.
struct Clusters {
  std::span<const Sphere> spheres;
  std::span<const std::uint32_t> first;    ///< one more than spheres
  std::span<const std::uint32_t> members;  ///< each triangle once

  std::size_t size() const noexcept { return spheres.size(); }
  std::span<const std::uint32_t> triangles_of(std::size_t cluster) const noexcept {
    return members.subspan(first[cluster], first[cluster + 1] - first[cluster]);
  }
};

}  // namespace touchmark::bvh
