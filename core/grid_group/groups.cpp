#include "core/grid_group/groups.h"

namespace touchmark::grid {

const Group Groups::none;

Groups::Groups(std::size_t places, std::size_t members) : grows_(true), groups_(places), members_(members) {
  for (const Group& group : groups_) group.state = unmade;
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
    if (!is_made(other.groups_[place])) continue;
    const Group& group = other.groups_[place];
    put(place, other.members(group), group.height, group.margin);
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
    group.first = static_cast<std::uint32_t>(first);
    group.count = static_cast<std::uint16_t>(members.size());
    group.height = height;
    group.margin = margin;
    std::atomic_ref(count_).fetch_add(1, std::memory_order_relaxed);
  }
  std::atomic_ref(group.state).store(made, std::memory_order_release);
}

}  // namespace touchmark::grid
