/// The visitor of a search for the nearest triangle (core/bvh/traversal.h), and the contact that it found.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <optional>

#include "core/bvh/node.h"
#include "core/detector.h"
#include "core/geometry/distance_error.h"
#include "core/geometry/point_triangle.h"
#include "core/point_queries/surface.h"
#include "core/search/plane_filter/plane_filter.h"
#include "core/search/ties/certified_nearest.h"
#include "core/search/ties/closest_candidates.h"
#include "core/search/ties/shared_corner.h"

// Unnamed, though in a header, so that the compiler knows all callers of what is instantiated for a visitor.
namespace touchmark::queries {
namespace {

/// Keeps the least candidate; the limit follows it.
struct NearestVisitor {
  const bvh::Parts& tree;
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
  NearestVisitor(const bvh::Parts& parts, const FilterFrame& tree_frame, const Vec3& point, float first_limit,
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

/// Returns the contact of what the visitor was shown, within the reach; the search has shown all that
/// nearest_of_ties asks for. Something was found, at `distance`.
[[maybe_unused, gnu::always_inline]] inline std::optional<Contact> contact_found(
    const Surface& surface, const NearestVisitor& visitor, double reach, double error, double distance,
    Work& work) noexcept {
  const WideBvh& bvh = surface.bvh;
  const ClosestCandidates& candidates = visitor.candidates;
  if (surface.certified && !(is_certain(distance, reach, error) && candidates.is_surely_first(error)))
    return contact_of(candidates, bvh.parts().triangles, visitor.center, reach,
                      distance_error(bvh.bounds(), visitor.center), bvh.ids(), work);
  if (distance > reach) return std::nullopt;
  return contact_at(bvh.parts().triangles[candidates.at()], visitor.center,
                    {visitor.offset, candidates.best().squared_distance}, bvh.ids()[candidates.best().index]);
}

}  // namespace
}  // namespace touchmark::queries
