/// Makes every triangle's group, at once or after some triangles moved.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/aabb.h"
#include "core/grid_group/direct/group_finder.h"
#include "core/grid_group/direct/groups.h"

namespace touchmark::grid {

class GroupBuilder {
 public:
  /// `exclusion_margin`: see GroupFinder. No more than `max_bytes` are taken; triangles that come too late
  /// get no members.
  GroupBuilder(const TriangleStore& store, const BoxTree& tree, double exclusion_margin,
               std::size_t max_bytes)
      : store_(store),
        exclusion_margin_(exclusion_margin),
        max_bytes_(max_bytes),
        finder_(store, tree, exclusion_margin, {.sharing = 0.2}) {}

  Groups build();
  /// None yet, and room for them.
  Groups unbuilt() const;
  /// Returns the groups of the same triangles after some moved within these boxes of the frame. With lazy
  /// construction those that changed are unbuilt again.
  Groups rebuild(const Groups& groups, const std::vector<Aabb>& moved);
  /// Did the bytes run out?
  bool ran_out() const noexcept { return ran_out_; }

 private:
  void start();
  void add(std::uint32_t slot, const GroupFinder::Found& found);
  bool changes(std::uint32_t slot, const std::vector<Aabb>& moved) const noexcept;

  const TriangleStore& store_;
  double exclusion_margin_;
  std::size_t max_bytes_;
  GroupFinder finder_;
  Groups groups_;
  bool ran_out_ = false;
};

}  // namespace touchmark::grid
