/// The plane filter over a whole group: one pass, and what a search needs to know of it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/grid_group/direct/groups.h"
#include "core/search/plane_filter/plane_filter.h"
#include "core/simd/lanes.h"

namespace touchmark::grid {

struct GroupBounds {
  std::array<Lanes, Groups::max_members / 4>
      squared;          ///< lower bounds of the squared distances, in the frame
  float least;          ///< least of the lower bounds
  bool over_face;       ///< is the point over a member's face?
  float height;         ///< then the least of its heights over them
  std::uint32_t guess;  ///< slot of the member of that height; else of the one of the least bound
};

/// `planes` are the store's, `slots` those of `count` members, readable up to Groups::rounded_up(count).
/// With AVX2 where the processor has it; the same bits without.
GroupBounds filter_group(const TrianglePlanes* planes, const std::uint32_t* slots, std::size_t count,
                         const FilterPoint& point) noexcept;

/// Filters without wide instructions, whatever the processor has: for tests.
GroupBounds filter_group_portably(const TrianglePlanes* planes, const std::uint32_t* slots, std::size_t count,
                                  const FilterPoint& point) noexcept;

}  // namespace touchmark::grid
