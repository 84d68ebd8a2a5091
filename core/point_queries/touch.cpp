/// Is anything within the radius? A triangle that surely is ends the search.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>

#include "core/bvh/search.h"
#include "core/float_limits.h"
#include "core/point_queries/bounds.h"
#include "core/point_queries/queries.h"
#include "core/point_queries/sampled.h"
#include "core/search/plane_filter/side_bound.h"
#include "core/search/ties/nearest_of_ties.h"
#include "core/search/tracing.h"

namespace touchmark::queries {
namespace {

constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

/// Ends with any triangle that is surely within the radius, and keeps those that doubles leave open.
struct TouchVisitor {
  /// Not an aggregate, whose initialization would clear all of what is yet to be written.
  TouchVisitor(const bvh::Parts& parts, const Vec3& point, double touch_radius, double kernel_error,
               bool is_certified) noexcept
      : tree(parts),
        center(point),
        radius(touch_radius),
        within(is_certified ? -kernel_error : std::numeric_limits<double>::denorm_min()),
        open_up_to(is_certified ? kernel_error : -std::numeric_limits<double>::infinity()) {}

  const bvh::Parts& tree;
  const Vec3& center;
  double radius;
  double within;      ///< a computed distance that exceeds the radius by less than this is surely within it
  double open_up_to;  ///< one that exceeds it by more than this is surely not
  float limit = -1;
  float enough = -1;  ///< in the tree's frame: a triangle no farther is surely within the radius
  LimitedWork work{};
  double least = std::numeric_limits<double>::infinity();  ///< distance of the one kept, else of those shown
  std::uint32_t kept_at = nowhere;
  std::uint32_t open_count = 0;
  std::array<std::uint32_t, 16> open;     ///< slots that doubles leave open, not decided yet
  std::optional<WithinRadius> is_within;  ///< what deciding these has told of the others

  bool accepts(std::uint32_t) const noexcept { return kept_at == nowhere; }
  void update(std::uint32_t at, const Offset& found) noexcept {
    const double distance = std::sqrt(found.squared);
    least = std::min(least, distance);
    const double excess = distance - radius;
    if (excess < within) return keep(at, distance);
    if (excess <= open_up_to) leave_open(at);
  }
  void update_within(std::uint32_t at) noexcept { keep(at, radius); }
  void keep(std::uint32_t at, double distance) noexcept {
    kept_at = at;
    least = distance;
    limit = -1;  // nothing is within it: the search ends
  }

  /// Keeps the first of those left open that is within the radius, if there is one.
  [[gnu::cold, gnu::noinline]] void decide_open() noexcept {
    if (!is_within) is_within.emplace(center, radius, open_up_to);
    for (std::size_t i = 0; i < open_count && kept_at == nowhere && !work.exceeds_limit(); ++i) {
      const PreparedTriangle& triangle = tree.triangles[open[i]];
      const double distance = std::sqrt(squared_distance(triangle, center));
      if ((*is_within)(triangle, distance, work.exact_decisions)) keep(open[i], distance);
    }
    open_count = 0;
    if (work.undecided) limit = -1;
  }

 private:
  /// Decides before there is no more room: a point on the border of very many then ends at the first that
  /// touches.
  void leave_open(std::uint32_t at) noexcept {
    open[open_count++] = at;
    if (open_count == open.size()) decide_open();
  }
};

/// True if something surely touches, by what was sampled. It may be another triangle than the one remembered,
/// which later queries only start from.
[[gnu::always_inline]] inline bool accepts_by_distance_field(const WideBvh& bvh, const FilterPoint& point,
                                                             const Vec3& center, double radius,
                                                             PointMemory& memory) noexcept {
  const double farthest = sampled_distance(bvh, point);
  if (!(farthest < radius - bvh.frame().kernel_error(point.plane_error))) return false;
  memory.remember(center, 0, farthest);
  return true;
}

/// True if what was near last still touches: by its planes, else by the kernel.
[[gnu::always_inline]] inline bool still_touches(const Surface& surface, const FilterPoint& point,
                                                 const Probe& probe, PointMemory& memory,
                                                 LimitedWork& work) noexcept {
  const WideBvh& bvh = surface.bvh;
  const FilterFrame& frame = bvh.frame();
  const Vec3& center = probe.center;
  const double radius = probe.radius;
  const double error = frame.kernel_error(point.plane_error);
  if (memory.touched_slot == memory.slot) {
    ++work.triangles;
    const Lanes values = plane_values(memory.touched, point);
    if (squared_lower_bound(values, point) > frame.limit((radius + error) * (radius + error))) return false;
    const double enough = radius - error;
    double farthest = frame.from_frame_rounded_up(distance_upper_bound(memory.touched, values, point));
    if (!(farthest < enough))
      farthest = frame.from_frame_rounded_up(side_upper_bound(memory.touched, values, point));
    if (farthest < enough) {
      memory.remember(center, 0, farthest);
      return true;
    }
  } else if (!(std::abs(memory.upper - (center - memory.center).norm()) <= radius)) {
    return false;  // it came from elsewhere
  }
  TouchVisitor visitor(bvh.parts(), center, radius, error, surface.certified);
  bvh::visit(bvh, memory.slot, visitor);
  if (visitor.open_count > 0) visitor.decide_open();
  work.take(visitor.work);
  if (visitor.kept_at == nowhere) return false;
  memory.remember(center, 0, visitor.least);
  return true;
}

/// Not inline: a copy of the planes aligns the stack, which costs whoever calls.
[[gnu::noinline]] void remember_touched(const WideBvh& bvh, std::uint32_t slot,
                                        PointMemory& memory) noexcept {
  memory.slot = memory.touched_slot = slot;
  memory.touched = bvh.parts().blocks[slot / bvh::width].planes(slot % bvh::width);
}

}  // namespace

bool touches(const Surface& surface, const Probe& probe, PointMemory& memory, LimitedWork& work) noexcept {
  const WideBvh& bvh = surface.bvh;
  const Vec3& center = probe.center;
  const double radius = probe.radius;
  memory.claim(bvh.epoch());
  if constexpr (tracing)
    if (visits != nullptr) visits->frame = &bvh.frame();
  const FilterPoint point = bvh.frame().point(center);
  if (!bvh.can_search(point))
    return must_end(bvh, work) || nearest_of_every(bvh, center, radius, work).has_value();
  const bool was_near = memory.is_near();
  if (was_near && (accepts_by_distance_field(bvh, point, center, radius, memory) ||
                   still_touches(surface, point, probe, memory, work)))
    return true;
  std::uint64_t budget = std::min(max_work(bvh), work.left());
  if (rejects_by_distance_field(bvh, point, center, radius, memory) ||
      (bvh.is_lazy() && rejects_once_sampled(bvh, point, center, radius, memory, budget, work)))
    return false;
  if (!was_near && accepts_by_distance_field(bvh, point, center, radius, memory)) return true;
  const double error = bvh.frame().kernel_error(point.plane_error);
  TouchVisitor visitor(bvh.parts(), center, radius, error, surface.certified);
  visitor.limit = bvh.frame().limit((radius + error) * (radius + error));
  visitor.enough = bvh.frame().to_frame_rounded_down(radius - error);
  visitor.work = work.rest();
  const float unseen = bvh::traverse(bvh, point, visitor, budget);
  if (visitor.kept_at == nowhere && visitor.open_count > 0) visitor.decide_open();
  work.take(visitor.work);
  if (visitor.kept_at == nowhere && (unseen == bvh::exhausted || visitor.work.undecided)) {
    memory.forget_distance();
    return visitor.work.undecided || must_end(bvh, work) ||
           scan_of(bvh, surface.certified, work).touches(probe, work);
  }
  if (visitor.kept_at == nowhere) {
    memory.remember(center, clearance_from(bvh, unseen, visitor.least, clearance_pad(bvh, point)), infinity);
    return false;
  }
  memory.remember(center, 0, visitor.least);
  remember_touched(bvh, visitor.kept_at, memory);
  return true;
}

}  // namespace touchmark::queries
