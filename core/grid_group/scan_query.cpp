/// Collision detection as published: the HIP against every group, then the triangles of the groups that hold
/// it.
#include <algorithm>
#include <cmath>

#include "core/geometry/sphere_triangle_sweep.h"
#include "core/geometry/sweep_box.h"
#include "core/grid_group/scan_grid.h"

namespace touchmark::grid {
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
  const Vec3 way = sweep.to - sweep.from, to_center = sphere.center - sweep.from;
  const double squared = way.squaredNorm();
  const double nearest = squared > 0 ? std::clamp(to_center.dot(way) / squared, 0.0, 1.0) : 0;
  const double radius = sphere.radius + by;
  return !((to_center - nearest * way).squaredNorm() > radius * radius);
}

}  // namespace

double ScanGrid::largest_difference(const Vec3& point) const noexcept {
  return std::max((bounds_.max - point).cwiseAbs().maxCoeff(), (point - bounds_.min).cwiseAbs().maxCoeff());
}

template <class Visit>
bool ScanGrid::search_members(std::size_t group, Work& work, const Visit& visit) const noexcept {
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
void ScanGrid::search(const Vec3& center, double reach, Work& work, const Visit& visit) const noexcept {
  // The kernel may call near what is this much farther.
  const double by = reach + culling_slack(largest_difference(center));
  const auto scan = [&](const auto& shapes) {
    for (std::size_t group = 0; group < shapes.size(); ++group) {
      if (holds(shapes[group], center, by) && search_members(group, work, visit)) {
        work.cells += group + 1;
        return;
      }
    }
    work.cells += shapes.size();
  };
  boxes_.empty() ? scan(spheres_) : scan(boxes_);
}

bool ScanGrid::touches(const Probe& probe, Work& work) const noexcept {
  bool touching = false;
  search(probe.center, probe.radius, work, [&](const PreparedTriangle& triangle) {
    return touching = std::sqrt(squared_distance(triangle, probe.center)) <= probe.radius;
  });
  return touching;
}

std::optional<Contact> ScanGrid::nearest(const Vec3& center, double reach, Work& work) const noexcept {
  Candidate best;
  search(center, reach, work, [&](const PreparedTriangle& triangle) {
    best = std::min(best, Candidate{squared_distance(triangle, center), triangle.index});
    return false;
  });
  const bool found = best.index < triangles_.size();
  if (!found || !(std::sqrt(best.squared_distance) <= reach)) return std::nullopt;
  return contact_on(triangles_[best.index], center, id(best.index));
}

std::optional<Impact> ScanGrid::first_hit(const Sweep& sweep, Work& work) const noexcept {
  const double difference = std::max(largest_difference(sweep.from), largest_difference(sweep.to));
  const double by = sweep_widening(sweep, difference);
  HitCandidate first;
  const auto scan = [&](const auto& shapes) {
    work.cells += shapes.size();
    for (std::size_t group = 0; group < shapes.size(); ++group) {
      if (!passes(shapes[group], sweep, by)) continue;
      search_members(group, work, [&](const PreparedTriangle& triangle) {
        const std::optional<double> hit = sweep_hit(triangle, sweep, std::min(first.fraction, 1.0));
        if (hit) first = std::min(first, HitCandidate{*hit, triangle.index});
        return false;
      });
    }
  };
  boxes_.empty() ? scan(spheres_) : scan(boxes_);
  if (first.index >= triangles_.size()) return std::nullopt;
  if (first.fraction > 0) {
    const Vec3 position = position_at(sweep, first.fraction);
    return Impact{first.fraction, contact_on(triangles_[first.index], position, id(first.index))};
  }
  // Touching at the start: of all the triangles touched there the nearest one counts.
  const std::optional<Contact> contact = nearest(sweep.from, sweep.radius, work);
  return contact ? std::optional(Impact{0, *contact}) : std::nullopt;
}

}  // namespace touchmark::grid
