/// The group of a triangle: all triangles that can be nearest to a point close to it.
#pragma once

#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/bvh/node.h"
#include "core/search/memory/lazy_construction.h"
#include "core/search/plane_filter/plane_filter.h"

namespace touchmark::grid {

/// Valid from `height` under the triangle's plane to `height` over it, up to `margin` beyond its sides, in
/// the filter's frame; nowhere when there are no blocks.
class Group {
 public:
  Group() = default;
  Group(std::uint32_t first, std::size_t count, float height, float margin) noexcept
      : first_(first), count_(static_cast<std::uint16_t>(count)), height_(height), margin_(margin) {}

  std::size_t count() const noexcept { return count_.load(std::memory_order_acquire); }  ///< number of blocks
  float height() const noexcept { return height_.load(std::memory_order_acquire); }
  float margin() const noexcept { return margin_; }  ///< valid only if there are blocks

  /// Is the point with these values of the triangle's planes surely where the group is valid?
  bool covers(Lanes values, float plane_error) const noexcept {
    return std::abs(values[0]) + plane_error <= height() && max_side_excess(values) + plane_error <= margin_;
  }

 private:
  friend class Groups;
  std::uint32_t first_ = 0;  ///< block
  // Whoever sees the count sees the first block, and whoever sees the height sees all.
  SharedValue<std::uint16_t> count_ = 0;
  LazyState state_;
  SharedValue<float> height_ = -1;
  float margin_ = -1;
};

/// A group as it is found: the blocks of the hierarchy in which its triangles are, that of the triangle that
/// it is about first.
struct FoundGroup {
  std::span<const bvh::ChildRef> blocks;  ///< none where there is no group
  float height = -1, margin = -1;
};

/// The groups, by slot of the hierarchy. All are built at once, or each by the thread that claims it.
class Groups {
 public:
  /// A group has more than many blocks only where a lower prism would not help.
  static constexpr std::size_t many_blocks = 10, max_blocks = 16;

  Groups() = default;
  /// None is made. There is room for so many bytes of them; for none where that is too little.
  Groups(std::size_t slots, std::size_t max_bytes, bool lazy);
  /// Copies what is made; what is being made meanwhile is not.
  Groups(const Groups& other);
  Groups& operator=(const Groups& other) { return *this = Groups(other); }
  Groups(Groups&&) noexcept = default;
  Groups& operator=(Groups&&) noexcept = default;
  ~Groups() = default;

  /// One without blocks where it is not made yet.
  const Group& of(std::uint32_t slot) const noexcept { return groups_[slot]; }
  std::span<const bvh::ChildRef> blocks(const Group& group) const noexcept {
    const std::size_t count = group.count();
    return {blocks_.data() + group.first_, count};
  }
  FoundGroup found(std::uint32_t slot) const noexcept {
    return {blocks(groups_[slot]), groups_[slot].height(), groups_[slot].margin()};
  }

  bool is_unbuilt(std::uint32_t slot) const noexcept { return groups_[slot].state_.is_unbuilt(); }
  /// Is it the caller who has to put it?
  bool claim(std::uint32_t slot) const noexcept { return groups_[slot].state_.claim(); }
  /// Returns false, and puts none, where there is no room for it.
  bool put(std::uint32_t slot, const FoundGroup& found) const noexcept;
  /// Gives back the room that is not taken.
  void shrink();

  bool empty() const noexcept { return groups_.empty(); }
  /// True if there was no room for some groups.
  bool ran_out() const noexcept { return groups_.empty() || taken_.load() > blocks_.size(); }
  /// Returns how many groups have blocks.
  std::size_t count() const noexcept { return count_.load(); }
  std::size_t bytes() const noexcept {
    return groups_.capacity() * sizeof(Group) + blocks_.capacity() * sizeof(bvh::ChildRef);
  }

 private:
  bool lazy_ = false;
  // What is not made belongs to nobody but who has claimed it.
  mutable std::vector<Group> groups_;
  mutable std::vector<bvh::ChildRef> blocks_;
  SharedValue<std::size_t> taken_ = 0;  ///< how many of blocks_ are in use
  SharedValue<std::size_t> count_ = 0;
};

}  // namespace touchmark::grid
