#include "core/grid_group/direct/groups.h"

namespace touchmark::grid {

Groups::Groups(std::size_t places, std::size_t members) : grows_(true), groups_(places), members_(members) {
  for (const Group& group : groups_) group.state_ = unmade;
}

Groups::Groups(const Groups& other) : grows_(other.grows_) {
  if (!grows_) {
    groups_ = other.groups_;
    members_ = other.members_;
    count_ = other.count_;
    return;
  }
  *this = Groups(other.groups_.size(), other.members_.size());
  for (std::uint32_t place = 0; place < groups_.size(); ++place) {
    const Group& group = other.groups_[place];
    if (std::atomic_ref(group.state_).load(std::memory_order_acquire) == made)
      put(place, other.members(group), group.height(), group.margin_);
  }
}

void Groups::put(std::uint32_t place, std::span<const std::uint32_t> members, float height,
                 float margin) const noexcept {
  Group& group = groups_[place];
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
  std::atomic_ref(group.state_).store(made, std::memory_order_release);
}

}  // namespace touchmark::grid
