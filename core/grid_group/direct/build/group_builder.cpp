#include "core/grid_group/direct/build/group_builder.h"

#include <algorithm>
#include <utility>

#include "core/search/threads/parallel.h"

namespace touchmark::grid {

void GroupBuilder::Piece::add(std::uint32_t slot, const GroupFinder::Found& found) {
  if (found.members.empty()) return;
  const std::size_t count = found.members.size();
  groups.push_back({slot, static_cast<std::uint32_t>(members.size()), static_cast<std::uint32_t>(count),
                    found.height, found.margin});
  members.insert(members.end(), found.members.data(), found.members.data() + Groups::rounded_up(count));
}

/// Pieces are made by any thread and stored in their order, as long as there is room. Each has a finder of
/// its own, find_or_keep(finder, slot), so that what one finds does not depend on another.
template <class FindOrKeep>
Groups GroupBuilder::make(const FindOrKeep& find_or_keep) {
  // As many slots as let neighbours share what they gather, and as many pieces as take little memory.
  constexpr std::size_t slots_a_piece = 256, pieces_a_wave = 64;
  groups_.groups_.resize(store_.size());
  groups_.members_.reserve(std::min(max_bytes_ / sizeof(std::uint32_t), std::size_t{24} * store_.size()));
  std::vector<Piece> wave(pieces_a_wave);
  std::size_t found = 0;  // in the last wave
  for (std::size_t begin = 0; begin < store_.size() && !ran_out_; begin += slots_a_piece * pieces_a_wave) {
    const std::size_t size = std::min(store_.size() - begin, slots_a_piece * pieces_a_wave);
    for (Piece& piece : wave) piece = {};
    // Where the last wave had next to no groups, this one probably has none either.
    constexpr std::size_t slots_a_group = 64;
    const bool has_hope = begin == 0 || slots_a_group * found >= slots_a_piece * pieces_a_wave;
    in_ranges(size, slots_a_piece, threads_, [&](std::size_t first, std::size_t end) {
      GroupFinder finder(store_, tree_, exclusion_margin_, {.shares = true, .has_hope = has_hope});
      for (auto slot = static_cast<std::uint32_t>(begin + first); slot < begin + end; ++slot)
        wave[first / slots_a_piece].add(slot, find_or_keep(finder, slot));
    });
    found = 0;
    for (const Piece& piece : wave) {
      found += piece.groups.size();
      store(piece);
    }
  }
  groups_.members_.shrink_to_fit();
  return std::move(groups_);
}

Groups GroupBuilder::build() {
  return make([](GroupFinder& finder, std::uint32_t slot) { return finder.find(slot); });
}

Groups GroupBuilder::unbuilt(std::size_t max_bytes) const {
  // Room for as many as most meshes' groups have in the mean, and a third more.
  constexpr std::size_t members_a_group = 32;
  const std::size_t left = max_bytes - std::min(max_bytes, store_.size() * sizeof(Group));
  return {store_.size(), std::min(left / sizeof(std::uint32_t), members_a_group * store_.size())};
}

/// What can be nearest in a prism is within its farthest() of it: triangles whose prism what moved does not
/// come so near to keep their members.
Groups GroupBuilder::rebuild(const Groups& groups, const std::vector<Aabb>& moved) {
  if (groups.is_lazy()) {
    Groups all = unbuilt(max_bytes_);
    for (std::uint32_t slot = 0; slot < store_.size(); ++slot) {
      if (groups.is_unbuilt(slot) || changes(slot, moved)) continue;
      const Group& kept = groups.of(slot);
      all.put(slot, groups.members(kept), kept.height(), kept.margin());
    }
    return all;
  }
  return make([&](GroupFinder& finder, std::uint32_t slot) -> GroupFinder::Found {
    if (changes(slot, moved)) return finder.find(slot);
    const Group& kept = groups.of(slot);
    return {groups.members(kept), kept.height(), kept.margin()};
  });
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

void GroupBuilder::store(const Piece& piece) {
  for (const Piece::Found& found : piece.groups) {
    const std::size_t stored = Groups::rounded_up(found.count);
    const std::size_t bytes =
        groups_.groups_.size() * sizeof(Group) + (groups_.members_.size() + stored) * sizeof(std::uint32_t);
    ran_out_ = ran_out_ || bytes > max_bytes_;
    if (ran_out_) return;
    groups_.groups_[found.slot] = {static_cast<std::uint32_t>(groups_.members_.size()), found.count,
                                   found.height, found.margin};
    const std::uint32_t* members = piece.members.data() + found.first;
    groups_.members_.insert(groups_.members_.end(), members, members + stored);
    groups_.count_.add(1);
  }
}

}  // namespace touchmark::grid
