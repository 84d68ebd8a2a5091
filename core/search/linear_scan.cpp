#include "core/search/linear_scan.h"

#include <algorithm>
#include <cmath>

#include "core/search/contacts_within.h"
#include "core/search/first_moving_touch.h"
#include "core/search/ties/certified_nearest.h"

namespace touchmark {

bool LinearScan::touches(const Probe& probe, Work& work) const noexcept {
  if (!(probe.radius >= 0) || !probe.center.allFinite()) return false;
  const double error = is_certified ? distance_error(bounds, probe.center) : 0;
  if (std::isinf(error)) return nearest(probe.center, probe.radius, work).has_value();
  std::uint64_t tested = 0;
  WithinRadius is_within(probe.center, probe.radius, error);
  const bool touching =
      std::any_of(triangles.begin(), triangles.end(), [&](const PreparedTriangle& triangle) {
        ++tested;
        const double distance = std::sqrt(squared_distance(triangle, probe.center));
        if (!is_certified) return distance <= probe.radius;
        return is_within(triangle, distance, work.exact_decisions);
      });
  work.triangles += tested;
  return touching;
}

std::optional<Contact> LinearScan::nearest(const Vec3& center, double reach, Work& work) const noexcept {
  return is_certified ? nearest_of_all(triangles, bounds, center, reach, ids, work)
                      : nearest_as_computed(center, reach, work);
}

std::optional<Impact> LinearScan::first_hit(const Sweep& sweep, Work& work) const noexcept {
  if (!(sweep.radius >= 0)) return std::nullopt;
  return impact_of(first_touch(sweep, work), ids, is_certified,
                   [&](double reach) { return nearest(sweep.from, reach, work); });
}

std::optional<Impact> LinearScan::first_hit_moving(const Sweep& sweep, const MeshMotion& motion,
                                                   Work& work) const noexcept {
  FirstMovingTouch first(sweep, motion);
  for (const PreparedTriangle& triangle : triangles) first.consider(triangle, work.exact_decisions);
  work.triangles += triangles.size();
  return first.impact(ids);
}

std::size_t LinearScan::contacts(const Vec3& center, double reach, std::span<Contact> into,
                                 Work& work) const noexcept {
  if (!(reach >= 0) || !center.allFinite()) return 0;
  ContactsWithin found({triangles, bounds, ids, center, reach, into, is_certified});
  for (std::uint32_t slot = 0; slot < triangles.size(); ++slot) found.consider(slot, work);
  work.triangles += std::isinf(found.error()) ? 2 * triangles.size() : triangles.size();
  return found.finish(work);
}

FirstTouch LinearScan::first_touch(const Sweep& sweep, Work& work) const noexcept {
  FirstTouch first(sweep);
  for (std::uint32_t slot = 0; slot < triangles.size(); ++slot)
    first.consider(triangles[slot], work.exact_decisions);
  work.triangles += triangles.size();
  return first;
}

std::optional<Contact> LinearScan::nearest_as_computed(const Vec3& center, double reach,
                                                       Work& work) const noexcept {
  const auto [triangle, candidate] = touchmark::nearest_as_computed(triangles, center);
  work.triangles += triangles.size();
  if (triangle == nullptr || std::sqrt(candidate.squared_distance) > reach) return std::nullopt;
  return contact_on(*triangle, center, ids[candidate.index]);
}

}  // namespace touchmark
