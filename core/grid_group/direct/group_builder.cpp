#include "core/grid_group/direct/group_builder.h"

#include <algorithm>
#include <utility>

namespace touchmark::grid {

void GroupBuilder::start() {
  groups_.groups_.resize(store_.size());
  groups_.members_.reserve(std::min(max_bytes_ / sizeof(std::uint32_t), std::size_t{24} * store_.size()));
}

Groups GroupBuilder::build() {
  start();
  for (std::uint32_t slot = 0; slot < store_.size() && !ran_out_; ++slot) add(slot, finder_.find(slot));
  groups_.members_.shrink_to_fit();
  return std::move(groups_);
}

Groups GroupBuilder::unbuilt() const {
  // Room for as many as most meshes' groups have in the mean, and a third more.
  constexpr std::size_t members_a_group = 32;
  const std::size_t left = max_bytes_ - std::min(max_bytes_, store_.size() * sizeof(Group));
  return {store_.size(), std::min(left / sizeof(std::uint32_t), members_a_group * store_.size())};
}

/// What can be nearest in a prism is within its farthest() of it: triangles whose prism what moved does not
/// come so near to keep their members.
Groups GroupBuilder::rebuild(const Groups& groups, const std::vector<Aabb>& moved) {
  if (groups.is_lazy()) {
    Groups all = unbuilt();
    for (std::uint32_t slot = 0; slot < store_.size(); ++slot) {
      if (groups.is_unbuilt(slot) || changes(slot, moved)) continue;
      const Group& kept = groups.of(slot);
      all.put(slot, groups.members(kept), kept.height(), kept.margin());
    }
    return all;
  }
  start();
  for (std::uint32_t slot = 0; slot < store_.size() && !ran_out_; ++slot) {
    if (changes(slot, moved)) {
      add(slot, finder_.find(slot));
    } else {
      const Group& kept = groups.of(slot);
      add(slot, {groups.members(kept), kept.height(), kept.margin()});
    }
  }
  groups_.members_.shrink_to_fit();
  return std::move(groups_);
}

bool GroupBuilder::changes(std::uint32_t slot, const std::vector<Aabb>& moved) const noexcept {
  const TriangleBall& ball = store_.balls[slot];
  const double around =
      GroupFinder::reach_in_radii * static_cast<double>(ball.radius) + 2 * exclusion_margin_;
  const Vec3 middle(static_cast<double>(ball.x), static_cast<double>(ball.y), static_cast<double>(ball.z));
  const Aabb at_middle{middle, middle};
  return std::any_of(moved.begin(), moved.end(),
                     [&](const Aabb& one) { return one.comes_within(around, at_middle); });
}

void GroupBuilder::add(std::uint32_t slot, const GroupFinder::Found& found) {
  if (found.members.empty()) return;
  const std::size_t count = found.members.size(), stored = Groups::rounded_up(count);
  const std::size_t bytes =
      groups_.groups_.size() * sizeof(Group) + (groups_.members_.size() + stored) * sizeof(std::uint32_t);
  if (bytes > max_bytes_) {
    ran_out_ = true;
    return;
  }
  groups_.groups_[slot] = {static_cast<std::uint32_t>(groups_.members_.size()), count, found.height,
                           found.margin};
  groups_.members_.insert(groups_.members_.end(), found.members.data(), found.members.data() + stored);
  groups_.count_.add(1);
}

}  // namespace touchmark::grid
