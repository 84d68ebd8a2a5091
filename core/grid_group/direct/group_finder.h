/// Finds which blocks of the hierarchy hold a triangle's group. Takes no memory beyond its own.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>

#include "core/bvh/leaf_list.h"
#include "core/bvh/wide_bvh.h"
#include "core/detector.h"
#include "core/grid_group/direct/groups.h"
#include "core/grid_group/direct/prism.h"

namespace touchmark::grid {

class GroupFinder {
 public:
  /// What looks at more than `budget` boxes and triangles finds no more groups. `exclusion_margin`: by how
  /// much, in the frame, a triangle must lose to be left out.
  GroupFinder(const WideBvh& bvh, double exclusion_margin, std::uint64_t budget) noexcept
      : bvh_(bvh), exclusion_margin_(exclusion_margin), budget_(budget) {}

  /// Returns the group of a slot's triangle, valid until the next call; none where no group can cover a
  /// point, or it would be too large.
  FoundGroup find(std::uint32_t slot) noexcept;
  /// With less nothing is found.
  static constexpr std::uint64_t min_budget = 2 * (1 + bvh::width) * bvh::LeafList::padded_capacity;
  const Work& work() const noexcept { return work_; }

  /// Everything that can be nearest where a group is valid comes this near to the triangle's incenter, in
  /// distances of its farthest corner from there.
  static constexpr double reach_in_radii = 6;

 private:
  /// A look at all that may be listed is no more than this.
  static constexpr std::uint64_t max_look = (1 + bvh::width) * bvh::LeafList::padded_capacity;

  bool list_around(const Vec3& center, double radius) noexcept;
  bool select_blocks(std::uint32_t slot, const Prism& prism) noexcept;

  const WideBvh& bvh_;
  double exclusion_margin_;
  std::uint64_t budget_;
  Work work_;
  double height_ = 1;                  ///< the last prism's, in sizes of its triangle
  Vec3 listed_center_ = Vec3::Zero();  ///< about which is listed, in the frame
  bvh::LeafList near_;
  std::array<bvh::ChildRef, bvh::LeafList::padded_capacity> open_;
  std::array<bvh::ChildRef, Groups::max_blocks> blocks_;
  std::size_t block_count_ = 0;
};

}  // namespace touchmark::grid
