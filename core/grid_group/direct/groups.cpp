#include "core/grid_group/direct/groups.h"

namespace touchmark::grid {

Groups::Groups(std::size_t slots, std::size_t members) : lazy_(true), groups_(slots), members_(members) {
  for (const Group& group : groups_) group.state_ = unbuilt;
}

Groups::Groups(const Groups& other) : lazy_(other.lazy_) {
  if (!lazy_) {
    groups_ = other.groups_;
    members_ = other.members_;
    count_ = other.count_;
    return;
  }
  *this = Groups(other.groups_.size(), other.members_.size());
  for (std::uint32_t slot = 0; slot < groups_.size(); ++slot) {
    const Group& group = other.groups_[slot];
    if (std::atomic_ref(group.state_).load(std::memory_order_acquire) == built)
      put(slot, other.members(group), group.height(), group.margin_);
  }
}

void Groups::put(std::uint32_t slot, std::span<const std::uint32_t> members, float height,
                 float margin) const noexcept {
  Group& group = groups_[slot];
  const std::size_t stored = rounded_up(members.size());
  const std::size_t first =
      members.empty() ? 0 : std::atomic_ref(taken_).fetch_add(stored, std::memory_order_relaxed);
  if (!members.empty() && first + stored <= members_.size()) {
    std::copy_n(members.data(), stored, members_.begin() + static_cast<std::ptrdiff_t>(first));
    group.first_ = static_cast<std::uint32_t>(first);
    group.margin_ = margin;
    std::atomic_ref(group.count_)
        .store(static_cast<std::uint16_t>(members.size()), std::memory_order_release);
    std::atomic_ref(group.height_).store(height, std::memory_order_release);
    std::atomic_ref(count_).fetch_add(1, std::memory_order_relaxed);
  }
  std::atomic_ref(group.state_).store(built, std::memory_order_release);
}

}  // namespace touchmark::grid
