/// Makes every triangle's group, at once or after some triangles moved.
#pragma once

#include <cstddef>
#include <span>

#include "core/aabb.h"
#include "core/bvh/wide_bvh.h"
#include "core/grid_group/direct/groups.h"

namespace touchmark::grid {

struct GroupOptions {
  std::size_t max_bytes = 0;  ///< groups that come too late are left out
  bool lazy = false;          ///< none is made yet
  unsigned threads = 1;
};

/// Returns by how much a triangle must lose to be left out of a group, in the frame.
double exclusion_margin_for(const WideBvh& bvh) noexcept;

Groups build_groups(const WideBvh& bvh, const GroupOptions& options);
/// Returns the groups of the same triangles after some moved within these boxes of the frame. With lazy
/// construction those that changed are unbuilt again.
Groups rebuild_groups(const WideBvh& bvh, const Groups& before, std::span<const Aabb> moved,
                      const GroupOptions& options);

}  // namespace touchmark::grid
