/// The parts of SphereTree that depend on what a search is for. A visitor has
///   center      where the search is from
///   limit       squared, in the tree's frame: only triangles within it need to be shown; may fall meanwhile
///   work        counts
///   wants(at)   does it want to know about the triangle kept there
///   take(at, offset)
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "core/sphere_cluster/tree/cylinder_bvh.h"
#include "core/sphere_cluster/tree/traversal.h"

namespace touchmark {

template <class Visitor>
void SphereTree::show(std::uint32_t at, Visitor& visitor) const noexcept {
  ++visitor.work.triangles;
  simd_ == Simd::portable ? spheres::portable::show(parts_, at, visitor)
                          : spheres::avx2::show(parts_, at, visitor);
}

template <class Visitor>
void SphereTree::show_all(Visitor& visitor) const noexcept {
  for (std::uint32_t i = 0; i < parts_.triangles.size(); ++i) show(i, visitor);
}

template <class Visitor>
float SphereTree::descend(const FilterPoint& point, Visitor& visitor, std::uint64_t most) const noexcept {
  switch (simd_) {
    case Simd::avx512:
      return spheres::avx512::descend(parts_, point, most, visitor);
    case Simd::avx2:
      return spheres::avx2::descend(parts_, point, most, visitor);
    default:
      return spheres::portable::descend(parts_, point, most, visitor);
  }
}

inline float SphereTree::way(const Vec3& from, const Vec3& to, const FilterPoint& at) const noexcept {
  return static_cast<float>(frame_.scale() * (to - from).norm()) + 2 * at.tau;
}

/// From the blocks listed, when they are all that can be within the limit; lists them anew when they are not.
template <class Visitor>
float SphereTree::search_near(const FilterPoint& point, Visitor& visitor, Memory& memory,
                              std::uint64_t most) const noexcept {
  const float distance = std::sqrt(visitor.limit) + point.tau;
  float away = way(memory.blocks.anchor, visitor.center, point);
  if (!(distance + away < memory.blocks.rest)) {
    if (!list_blocks(visitor.center, visitor.center - memory.center, distance, memory, most, visitor.work))
      return descend(point, visitor, most);
    away = way(memory.blocks.anchor, visitor.center, point);
    if (!(distance + away < memory.blocks.rest)) return descend(point, visitor, most);
  }
  return search_listed(point, visitor, memory.blocks, away, most);
}

template <class Visitor>
float SphereTree::search_listed(const FilterPoint& point, Visitor& visitor, const spheres::NearBlocks& blocks,
                                float away, std::uint64_t most) const noexcept {
  switch (simd_) {
    case Simd::avx512:
      return spheres::avx512::search_listed(parts_, point, blocks, away, most, visitor);
    case Simd::avx2:
      return spheres::avx2::search_listed(parts_, point, blocks, away, most, visitor);
    default:
      return spheres::portable::search_listed(parts_, point, blocks, away, most, visitor);
  }
}

}  // namespace touchmark
