/// The group of a triangle: all triangles that can be nearest to a point close to it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/plane_filter.h"

namespace touchmark::grid {

/// Valid from `height` under the triangle's plane to `height` over it, up to `margin` beyond its sides, in
/// the filter's frame; nowhere when there are no members.
struct Group {
  std::uint32_t first = 0;  ///< member
  std::uint32_t count = 0;  ///< of members
  float height = -1;
  float margin = -1;

  /// Is the point with these values of the triangle's planes surely where the group is valid?
  bool serves(Lanes values, float tau) const noexcept {
    const float beside = std::max(values[1], std::max(values[2], values[3]));
    return std::abs(values[0]) + tau <= height && beside + tau <= margin;
  }
};

/// By place in the TriangleStore.
class Groups {
 public:
  /// More than many only where a lower prism would not help.
  static constexpr std::size_t many_members = 32, most_members = 64;

  const Group& of(std::uint32_t place) const noexcept { return groups_[place]; }
  std::span<const std::uint32_t> members(const Group& group) const noexcept {
    return {members_.data() + group.first, group.count};
  }
  /// Behind the members lie copies of the last, up to a multiple of eight.
  static constexpr std::size_t rounded_up(std::size_t members) { return (members + 7) / 8 * 8; }
  /// Of the groups that have members.
  std::size_t count() const noexcept { return count_; }
  std::size_t bytes() const noexcept {
    return groups_.capacity() * sizeof(Group) + members_.capacity() * sizeof(std::uint32_t);
  }

 private:
  friend class GroupBuilder;
  std::vector<Group> groups_;
  std::vector<std::uint32_t> members_;
  std::size_t count_ = 0;
};

}  // namespace touchmark::grid
