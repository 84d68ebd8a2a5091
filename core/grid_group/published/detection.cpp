/// Collision detection as published: the HIP against every group, then the triangles of the groups that hold
/// it.
#include <cmath>

#include "core/geometry/sweep_box.h"
#include "core/grid_group/published/published_grid_group.h"
#include "core/search/first_touch.h"
#include "core/search/ties/certified_nearest.h"

namespace touchmark {
namespace {

/// Within the x, y and z ranges widened by `by`? Written so that a NaN is held.
bool holds(const Aabb& box, const Vec3& point, double by) noexcept {
  bool outside = false;
  for (int k = 0; k < 3; ++k) {
    outside |= point[k] < box.min[k] - by;
    outside |= point[k] > box.max[k] + by;
  }
  return !outside;
}

bool holds(const Sphere& sphere, const Vec3& point, double by) noexcept {
  const double radius = sphere.radius + by;
  return !((point - sphere.center).squaredNorm() > radius * radius);
}

bool passes(const Aabb& box, const Sweep& sweep, double by) noexcept {
  return enters(box, sweep, by, 1) <= 1;
}

bool passes(const Sphere& sphere, const Sweep& sweep, double by) noexcept {
  const double radius = sphere.radius + by;
  return !(squared_distance_to_path(sweep, sphere.center) > radius * radius);
}

}  // namespace

template <class Visit>
bool PublishedGridGroup::search_members(std::size_t group, Work& work, const Visit& visit) const noexcept {
  const std::span<const std::uint32_t> triangles = members(group);
  for (std::size_t i = 0; i < triangles.size(); ++i) {
    if (visit(triangles_[triangles[i]])) {
      work.triangles += i + 1;
      return true;
    }
  }
  work.triangles += triangles.size();
  return false;
}

template <class Visit>
void PublishedGridGroup::search(const Vec3& center, double reach, Work& work,
                                const Visit& visit) const noexcept {
  // The kernel may call near what is this much farther.
  const double by = reach + culling_pad(largest_difference(bounds_, center));
  const auto scan = [&](const auto& shapes) {
    for (std::size_t group = 0; group < shapes.size(); ++group) {
      ++work.cells;
      if (holds(shapes[group], center, by) && search_members(group, work, visit)) return;
    }
  };
  boxes_.empty() ? scan(spheres_) : scan(boxes_);
}

bool PublishedGridGroup::touches(const Probe& probe, Session& session) const noexcept {
  if (!(probe.radius >= 0)) return false;
  const Vec3& center = probe.center;
  const double error = distance_error(bounds_, center);
  if (!is_grouped() || std::isinf(error)) return fallback().touches(probe, session.work);
  bool touching = false;
  WithinRadius is_within(center, probe.radius, error);
  const auto visit = [&](const PreparedTriangle& triangle) {
    const double distance = std::sqrt(squared_distance(triangle, center));
    return touching = is_within(triangle, distance, session.work.exact_decisions);
  };
  search(center, probe.radius + error, session.work, visit);
  return touching;
}

std::optional<Contact> PublishedGridGroup::nearest(const Probe& probe, double reach,
                                                   Session& session) const noexcept {
  if (!(reach >= 0)) return std::nullopt;
  const Vec3& center = probe.center;
  const double error = distance_error(bounds_, center);
  if (!is_grouped() || std::isinf(error)) return fallback().nearest(center, reach, session.work);
  ClosestCandidates candidates(triangles_.data(), center, error);
  const auto consider = [&](const PreparedTriangle& triangle) {
    candidates.update({squared_distance(triangle, center), triangle.index}, triangle.index);
    return false;
  };
  search(center, reach + error, session.work, consider);
  return contact_of(candidates, triangles_, center, reach, error, ids_, session.work);
}

std::optional<Impact> PublishedGridGroup::first_hit(const Sweep& sweep, Session& session) const noexcept {
  if (!(sweep.radius >= 0)) return std::nullopt;
  Work& work = session.work;
  const double difference = largest_difference(bounds_, sweep);
  if (!is_grouped() || !fourth_powers_fit(difference)) return fallback().first_hit(sweep, work);
  const double by = padded_sweep_radius(sweep, difference);
  FirstTouch first(sweep);
  const auto scan = [&](const auto& shapes) {
    for (std::size_t group = 0; group < shapes.size(); ++group) {
      ++work.cells;
      if (!passes(shapes[group], sweep, by)) continue;
      search_members(group, work, [&](const PreparedTriangle& triangle) {
        first.consider(triangle, work.exact_decisions);
        return false;
      });
    }
  };
  boxes_.empty() ? scan(spheres_) : scan(boxes_);
  return impact_of(first, ids_, true, [&](double reach) { return nearest({sweep.from, 0}, reach, session); });
}

std::size_t PublishedGridGroup::contacts(const Probe& probe, double reach, Session& session,
                                         std::span<Contact> into) const noexcept {
  return reach >= 0 ? fallback().contacts(probe.center, reach, into, session.work) : 0;
}

}  // namespace touchmark
