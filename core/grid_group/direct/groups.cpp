#include "core/grid_group/direct/groups.h"

namespace touchmark::grid {

Groups::Groups(std::size_t slots, std::size_t members) : lazy_(true), groups_(slots), members_(members) {
  for (Group& group : groups_) group.state_ = LazyState::unbuilt();
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
    if (group.state_.is_built()) put(slot, other.members(group), group.height(), group.margin_);
  }
}

void Groups::put(std::uint32_t slot, std::span<const std::uint32_t> members, float height,
                 float margin) const noexcept {
  Group& group = groups_[slot];
  const std::size_t stored = rounded_up(members.size());
  const std::size_t first = members.empty() ? 0 : taken_.add(stored);
  if (!members.empty() && first + stored <= members_.size()) {
    std::copy_n(members.data(), stored, members_.begin() + static_cast<std::ptrdiff_t>(first));
    group.first_ = static_cast<std::uint32_t>(first);
    group.margin_ = margin;
    group.count_.store(static_cast<std::uint16_t>(members.size()), std::memory_order_release);
    group.height_.store(height, std::memory_order_release);
    count_.add(1);
  }
  group.state_.finish();
}

bool Groups::fit(std::size_t max_bytes) {
  const std::size_t whole = members_.size();
  std::size_t members = whole, count = count_.load();
  for (std::size_t slot = groups_.size(); slot-- > 0 && count > 0;) {
    if (groups_.size() * sizeof(Group) + members * sizeof(std::uint32_t) <= max_bytes) break;
    Group& last = groups_[slot];
    if (last.count() == 0) continue;
    members = last.first_;
    last = Group();
    --count;
  }
  if (members == whole) return false;
  members_.resize(members);
  members_.shrink_to_fit();
  count_ = count;
  return true;
}

}  // namespace touchmark::grid
