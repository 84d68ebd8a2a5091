/// What a search of the hierarchy for the nearest is for: a visitor as core/sphere_cluster/tree/search.h asks
/// for.
#pragma once

#include <algorithm>
#include <cstdint>

#include "core/detector.h"
#include "core/geometry/point_triangle.h"
#include "core/search/closest_candidates.h"
#include "core/search/plane_filter.h"
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

  /// Not an aggregate, whose initialization would clear all of what is yet to be written.
  NearestVisitor(const TreeParts& parts, const FilterFrame& tree_frame, const Vec3& point, float first_limit,
                 double error) noexcept
      : tree(parts),
        frame(tree_frame),
        center(point),
        limit(first_limit),
        candidates(parts.triangles.data(), point, error) {}

  bool accepts(std::uint32_t at) const noexcept { return at != candidates.at(); }
  void update(std::uint32_t at, const Offset& found) noexcept {
    if (!candidates.update({found.squared, tree.triangles[at].index}, at)) return;
    offset = found.vector;
    limit = std::min(limit, frame.limit(found.squared));
  }
};

}  // namespace
}  // namespace touchmark::spheres
