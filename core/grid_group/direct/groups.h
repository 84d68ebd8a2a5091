/// The group of a triangle: all triangles that can be nearest to a point close to it.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/search/memory/lazy_construction.h"
#include "core/search/plane_filter/plane_filter.h"
#include "core/simd/lanes.h"

namespace touchmark::grid {

/// Valid from `height` under the triangle's plane to `height` over it, up to `margin` beyond its sides, in
/// the filter's frame; nowhere when there are no members.
class Group {
 public:
  Group() = default;
  Group(std::uint32_t first, std::size_t count, float height, float margin) noexcept
      : first_(first), count_(static_cast<std::uint16_t>(count)), height_(height), margin_(margin) {}

  std::size_t count() const noexcept {
    return count_.load(std::memory_order_acquire);
  }  ///< number of members
  float height() const noexcept { return height_.load(std::memory_order_acquire); }
  float margin() const noexcept { return margin_; }  ///< valid only if there are members

  /// Is the point with these values of the triangle's planes surely where the group is valid?
  bool covers(Lanes values, float plane_error) const noexcept {
    const float side_excess = max_side_excess(values);
    return std::abs(values[0]) + plane_error <= height() && side_excess + plane_error <= margin_;
  }

 private:
  friend class Groups;
  std::uint32_t first_ = 0;  ///< member
  // Whoever sees the count sees the first member, and whoever sees the height sees all.
  SharedValue<std::uint16_t> count_ = 0;
  LazyState state_;
  SharedValue<float> height_ = -1;
  float margin_ = -1;
};

/// Groups by slot in the TriangleStore, all of them built at once or each lazily: whoever claims one puts it.
class Groups {
 public:
  /// A group has more than many members only where a lower prism would not help.
  static constexpr std::size_t many_members = 32, max_members = 64;

  Groups() = default;
  /// None is made, and there is room for so many members.
  Groups(std::size_t slots, std::size_t members);
  /// Copies what is made; what is being made meanwhile is not.
  Groups(const Groups& other);
  Groups& operator=(const Groups& other) { return *this = Groups(other); }
  Groups(Groups&&) noexcept = default;
  Groups& operator=(Groups&&) noexcept = default;
  ~Groups() = default;

  /// One without members where it is not made yet.
  const Group& of(std::uint32_t slot) const noexcept { return groups_[slot]; }
  std::span<const std::uint32_t> members(const Group& group) const noexcept {
    const std::size_t count = group.count();
    return {members_.data() + group.first_, count};
  }
  /// The members' number with the copies of the last behind them, up to a multiple of eight.
  static constexpr std::size_t rounded_up(std::size_t members) { return (members + 7) / 8 * 8; }

  bool is_unbuilt(std::uint32_t slot) const noexcept { return groups_[slot].state_.is_unbuilt(); }
  /// Is it the caller who has to put it?
  bool claim(std::uint32_t slot) const noexcept { return groups_[slot].state_.claim(); }
  /// Members with their copies behind them. Without any where there is no room for them.
  void put(std::uint32_t slot, std::span<const std::uint32_t> members, float height,
           float margin) const noexcept;

  /// Drops the last ones, of those built at once, until the rest takes no more than this. Returns true if
  /// some were dropped.
  bool fit(std::size_t max_bytes);

  bool is_lazy() const noexcept { return lazy_; }
  /// Returns how many groups have members.
  std::size_t count() const noexcept { return count_.load(); }
  std::size_t bytes() const noexcept {
    return groups_.capacity() * sizeof(Group) + members_.capacity() * sizeof(std::uint32_t);
  }

 private:
  friend class GroupBuilder;
  bool lazy_ = false;
  // What is not made belongs to nobody but who has claimed it.
  mutable std::vector<Group> groups_;
  mutable std::vector<std::uint32_t> members_;
  SharedValue<std::size_t> taken_ = 0;  ///< how many of members_ are in use, with lazy construction
  SharedValue<std::size_t> count_ = 0;
};

}  // namespace touchmark::grid
