#include "core/grid_group/direct/groups.h"

#include <algorithm>

namespace touchmark::grid {

Groups::Groups(std::size_t slots, std::size_t max_bytes, bool lazy) : lazy_(lazy) {
  // Lazily built groups get room for a third more blocks than groups of most meshes have in the mean.
  const std::size_t blocks_a_group = lazy_ ? 12 : max_blocks;
  if (max_bytes < slots * (sizeof(Group) + sizeof(bvh::ChildRef))) return;
  groups_.resize(slots);
  blocks_.resize(
      std::min((max_bytes - slots * sizeof(Group)) / sizeof(bvh::ChildRef), blocks_a_group * slots));
  for (Group& group : groups_)
    if (lazy_) group.state_ = LazyState::unbuilt();
}

Groups::Groups(const Groups& other) : lazy_(other.lazy_) {
  if (!lazy_) {
    groups_ = other.groups_;
    blocks_ = other.blocks_;
    taken_ = other.taken_;
    count_ = other.count_;
    return;
  }
  *this = Groups(other.groups_.size(), other.bytes(), true);
  for (std::uint32_t slot = 0; slot < groups_.size(); ++slot)
    if (other.groups_[slot].state_.is_built()) put(slot, other.found(slot));
}

bool Groups::put(std::uint32_t slot, const FoundGroup& found) const noexcept {
  Group& group = groups_[slot];
  const std::size_t first = found.blocks.empty() ? 0 : taken_.add(found.blocks.size());
  const bool fits = first + found.blocks.size() <= blocks_.size();
  if (!found.blocks.empty() && fits) {
    std::copy(found.blocks.begin(), found.blocks.end(), blocks_.begin() + static_cast<std::ptrdiff_t>(first));
    group.first_ = static_cast<std::uint32_t>(first);
    group.margin_ = found.margin;
    group.count_.store(static_cast<std::uint16_t>(found.blocks.size()), std::memory_order_release);
    group.height_.store(found.height, std::memory_order_release);
    count_.add(1);
  }
  group.state_.finish();
  return fits;
}

void Groups::shrink() {
  blocks_.resize(std::min(taken_.load(), blocks_.size()));
  blocks_.shrink_to_fit();
}

}  // namespace touchmark::grid
