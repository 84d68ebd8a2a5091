/// What a search of the hierarchy for the nearest is for: a visitor as core/sphere_cluster/tree/search.h asks
/// for.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>

#include "core/detector.h"
#include "core/geometry/point_triangle.h"
#include "core/search/closest_candidates.h"
#include "core/search/plane_filter.h"
#include "core/search/shared_corner.h"
#include "core/sphere_cluster/tree/node.h"

// Unnamed, though in a header, so that the compiler knows all callers of what is instantiated for a visitor.
namespace touchmark::spheres {
namespace {

/// Keeps the least candidate; the limit follows it.
struct NearestVisitor {
  const TreeParts& tree;
  const FilterFrame& frame;
  const Vec3& center;
  float limit;
  ClosestCandidates candidates;
  Work work;
  Vec3 offset;  ///< to the nearest so far
  SharedCorner corner;
  std::uint32_t corner_of = std::numeric_limits<std::uint32_t>::max();  ///< the slot that it was asked of
  bool names_all = false;  ///< it is asked for all that are as far as the nearest, not for the first

  /// Not an aggregate, whose initialization would clear all of what is yet to be written.
  NearestVisitor(const TreeParts& parts, const FilterFrame& tree_frame, const Vec3& point, float first_limit,
                 double error) noexcept
      : tree(parts),
        frame(tree_frame),
        center(point),
        limit(first_limit),
        candidates(parts.triangles.data(), point, error) {}

  bool accepts(std::uint32_t at) const noexcept { return at != candidates.at(); }
  /// Is it known, without the kernel, that the triangle is as far as the nearest? Then it is taken.
  bool takes_as_far(std::uint32_t at) noexcept {
    if (corner_of == candidates.at() && !corner.is_known()) return false;
    return looks_as_far(at);
  }
  void update(std::uint32_t at, const Offset& found) noexcept {
    if (!candidates.update({found.squared, tree.triangles[at].index}, at)) return;
    offset = found.vector;
    limit = std::min(limit, frame.limit(found.squared));
  }

 private:
  [[gnu::noinline]] bool looks_as_far(std::uint32_t at) noexcept {
    if (names_all || !candidates.found()) return false;
    if (corner_of != candidates.at()) {
      corner_of = candidates.at();
      corner.find(tree.triangles[corner_of], center, offset, candidates.closeness());
    }
    if (!corner.is_known() || !corner.is_nearest_of(tree.triangles[at])) return false;
    candidates.take_as_far(tree.triangles[at].index, at);
    corner_of = candidates.at();
    return true;
  }
};

}  // namespace
}  // namespace touchmark::spheres
