/// Is anything within the radius? A triangle that surely is ends the search.
#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>

#include "core/float_limits.h"
#include "core/search/nearest_of_ties.h"
#include "core/search/side_bound.h"
#include "core/sphere_cluster/tree/cylinder_bvh.h"
#include "core/sphere_cluster/tree/search.h"  // IWYU pragma: keep

namespace touchmark {
namespace {

constexpr std::uint32_t nowhere = std::numeric_limits<std::uint32_t>::max();

/// Is content with any triangle that is surely within the radius, and keeps those that doubles leave open.
struct TouchVisitor {
  /// Not an aggregate, whose initialization would clear all of what is yet to be written.
  TouchVisitor(const spheres::TreeParts& parts, const Vec3& point, double touch_radius, double kernel_error,
               bool is_certified) noexcept
      : tree(parts),
        center(point),
        radius(touch_radius),
        within(is_certified ? -kernel_error : std::numeric_limits<double>::denorm_min()),
        open_up_to(is_certified ? kernel_error : -std::numeric_limits<double>::infinity()) {}

  const spheres::TreeParts& tree;
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
[[gnu::cold, gnu::noinline]] void decide_open(TouchVisitor& visitor, double error, Work& work) noexcept {
  WithinRadius is_within(visitor.center, visitor.radius, error);
  const std::size_t count = std::min<std::size_t>(visitor.open_count, visitor.open.size());
  for (std::size_t i = 0; i < count && visitor.kept_at == nowhere; ++i) {
    const PreparedTriangle& triangle = visitor.tree.triangles[visitor.open[i]];
    const double distance = std::sqrt(squared_distance(triangle, visitor.center));
    if (is_within(triangle, distance, work.exact_decisions)) visitor.keep(visitor.open[i], distance);
  }
}

}  // namespace

bool SphereTree::touches(const Probe& probe, Memory& memory, Work& work) const noexcept {
  const Vec3& center = probe.center;
  const double radius = probe.radius;
  claim(memory);
  if constexpr (tracing)
    if (visits != nullptr) visits->frame = &frame_;
  const FilterPoint point = frame_.point(center);
  if (!can_search(point)) return nearest_without(center, radius, work).has_value();
  const bool was_near = memory.is_near();
  if (was_near &&
      (accepts_by_distance_field(point, center, radius, memory) || still_touches(point, probe, memory, work)))
    return true;
  std::uint64_t budget = work_limit();
  if (rejects_by_distance_field(point, center, radius, memory) ||
      (lazy_ && rejects_once_sampled(point, center, radius, memory, budget, work)))
    return false;
  if (!was_near && accepts_by_distance_field(point, center, radius, memory)) return true;
  const double error = frame_.kernel_error(point.plane_error);
  TouchVisitor visitor(parts_, center, radius, error, certified_);
  visitor.limit = frame_.limit((radius + error) * (radius + error));
  visitor.enough = frame_.to_frame_rounded_down(radius - error);
  const float unseen = traverse(point, visitor, budget);
  work += visitor.work;
  if (visitor.kept_at == nowhere && visitor.open_count > 0) decide_open(visitor, error, work);
  if (unseen == spheres::exhausted || visitor.leaves_too_many_open()) {
    memory.forget_distance();
    return fallback(work).touches(probe, work);
  }
  if (visitor.kept_at == nowhere) {
    remember_touch(center, clearance_from(unseen, visitor.least, clearance_pad(point)), infinity, memory);
    return false;
  }
  remember_touch(center, 0, visitor.least, memory);
  memory.slot = visitor.kept_at;
  remember_planes(memory);
  return true;
}

/// Does what was near last still touch? By its planes, else by the kernel.
[[gnu::always_inline]] inline bool SphereTree::still_touches(const FilterPoint& point, const Probe& probe,
                                                             Memory& memory, Work& work) const noexcept {
  const Vec3& center = probe.center;
  const double radius = probe.radius;
  const double error = frame_.kernel_error(point.plane_error);
  if (memory.touched_slot == memory.slot) {
    ++work.triangles;
    const Lanes values = plane_values(memory.touched, point);
    if (squared_lower_bound(values, point) > frame_.limit((radius + error) * (radius + error))) return false;
    const double enough = radius - error;
    double farthest = frame_.from_frame_rounded_up(distance_upper_bound(memory.touched, values, point));
    if (!(farthest < enough))
      farthest = frame_.from_frame_rounded_up(side_upper_bound(memory.touched, values, point));
    if (farthest < enough) {
      remember_touch(center, 0, farthest, memory);
      return true;
    }
  } else if (!(std::abs(memory.upper - (center - memory.center).norm()) <= radius)) {
    return false;  // it came from elsewhere
  }
  TouchVisitor visitor(parts_, center, radius, error, certified_);
  visit(memory.slot, visitor);
  if (visitor.open_count > 0) decide_open(visitor, error, work);
  work += visitor.work;
  if (visitor.kept_at == nowhere) return false;
  remember_touch(center, 0, visitor.least, memory);
  return true;
}

/// Does something surely touch, by what was sampled? It may be another triangle than the one remembered,
/// which later queries only start from.
[[gnu::always_inline]] inline bool SphereTree::accepts_by_distance_field(const FilterPoint& point,
                                                                         const Vec3& center, double radius,
                                                                         Memory& memory) const noexcept {
  const double farthest = static_cast<double>(distances_.upper_bound(point)) * frame_.unit();
  if (!(farthest < radius - frame_.kernel_error(point.plane_error))) return false;
  remember_touch(center, 0, farthest, memory);
  return true;
}

/// Takes the planes of the triangle that touches out of its block, whose eight lines they are spread over.
void SphereTree::remember_planes(Memory& memory) const noexcept {
  const spheres::TriangleBlock& block = parts_.blocks[memory.slot / spheres::tree_width];
  const std::uint32_t at = memory.slot % spheres::tree_width;
  for (int k = 0; k < 4; ++k) {
    memory.touched.x[k] = block.x[k][at];
    memory.touched.y[k] = block.y[k][at];
    memory.touched.z[k] = block.z[k][at];
    memory.touched.offset[k] = block.offset[k][at];
  }
  memory.touched_slot = memory.slot;
}

}  // namespace touchmark
