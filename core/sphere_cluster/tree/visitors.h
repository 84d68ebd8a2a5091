/// What a search of the hierarchy is for: visitors as core/sphere_cluster/tree/search.h asks for.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/detector.h"
#include "core/geometry/point_triangle.h"
#include "core/search/closest_candidates.h"
#include "core/search/nearest_of_ties.h"
#include "core/search/plane_filter.h"
#include "core/sphere_cluster/tree/node.h"

// Unnamed, though in a header, so that the compiler knows all callers of what is instantiated for a visitor.
namespace touchmark::spheres {
namespace {

constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

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

/// Is content with any triangle that is surely within the radius, and keeps those that doubles leave open.
struct TouchVisitor {
  /// Not an aggregate, whose initialization would clear all of what is yet to be written.
  TouchVisitor(const TreeParts& parts, const Vec3& point, double touch_radius, double kernel_error,
               bool is_certified) noexcept
      : tree(parts),
        center(point),
        radius(touch_radius),
        within(is_certified ? -kernel_error : std::numeric_limits<double>::denorm_min()),
        open_up_to(is_certified ? kernel_error : -std::numeric_limits<double>::infinity()) {}

  const TreeParts& tree;
  const Vec3& center;
  double radius;
  double within;      ///< a computed distance that exceeds the radius by less than this is surely within it
  double open_up_to;  ///< one that exceeds it by more than this is surely not
  float limit = -1;
  float enough = -1;  ///< in the tree's frame: a triangle no farther is surely within the radius
  Work work{};
  double least = std::numeric_limits<double>::infinity();  ///< distance of the one kept, else of those shown
  std::uint32_t kept_at = nowhere;
  std::uint32_t open_count = 0;
  std::array<std::uint32_t, 16> open;  ///< the first of those that are left open

  bool accepts(std::uint32_t) const noexcept { return kept_at == nowhere; }
  void update(std::uint32_t at, const Offset& found) noexcept {
    const double distance = std::sqrt(found.squared);
    least = std::min(least, distance);
    const double excess = distance - radius;
    if (excess < within) return keep(at, distance);
    if (excess <= open_up_to) leave_open(at);
  }
  void update_within(std::uint32_t at) noexcept { keep(at, radius); }
  bool leaves_too_many_open() const noexcept { return kept_at == nowhere && open_count > open.size(); }
  void keep(std::uint32_t at, double distance) noexcept {
    kept_at = at;
    least = distance;
    limit = -1;  // nothing is within it: the search ends
  }

 private:
  void leave_open(std::uint32_t at) noexcept {
    if (open_count < open.size()) open[open_count] = at;
    ++open_count;
  }
};

/// Keeps the first of those that doubles left open which is within the radius, if there is one.
[[maybe_unused, gnu::cold, gnu::noinline]] void decide_open(TouchVisitor& visitor, double error,
                                                            Work& work) noexcept {
  WithinRadius is_within(visitor.center, visitor.radius, error);
  const std::size_t count = std::min<std::size_t>(visitor.open_count, visitor.open.size());
  for (std::size_t i = 0; i < count && visitor.kept_at == nowhere; ++i) {
    const PreparedTriangle& triangle = visitor.tree.triangles[visitor.open[i]];
    const double distance = std::sqrt(squared_distance(triangle, visitor.center));
    if (is_within(triangle, distance, work.exact_decisions)) visitor.keep(visitor.open[i], distance);
  }
}

}  // namespace
}  // namespace touchmark::spheres
