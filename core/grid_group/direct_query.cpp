#include <algorithm>
#include <cmath>
#include <limits>

#include "core/grid_group/direct_grid.h"
#include "core/grid_group/nearest_search.h"

namespace touchmark::grid {
namespace {

void count(const NearestSearch& search, Work& work) noexcept {
  work.triangles += search.triangles();
  work.boxes += search.boxes();
}

}  // namespace

bool DirectGrid::touches(const Probe& probe, DirectMemory& memory, Work& work) const noexcept {
  if (!(probe.radius >= 0)) return false;
  if (!store_.frame.covers(probe.center)) return far_nearest(probe.center, probe.radius, work).has_value();
  const auto touching = [&](const Candidate& best) {
    return std::sqrt(best.squared_distance) <= probe.radius;
  };
  NearestSearch search(store_, probe.center, probe.radius * probe.radius);
  search.consider(std::min(memory.place, store_.size() - 1));
  if (!touching(search.best())) search.consider_tree(tree_, touching);
  memory.place = search.place();
  count(search, work);
  return touching(search.best());
}

std::optional<Contact> DirectGrid::nearest(const Vec3& center, double reach, DirectMemory& memory,
                                           Work& work) const noexcept {
  if (!(reach >= 0)) return std::nullopt;
  if (!store_.frame.covers(center)) return far_nearest(center, reach, work);
  NearestSearch search(store_, center, reach * reach);
  search.consider(std::min(memory.place, store_.size() - 1));
  search.consider_tree(tree_, [](const Candidate&) { return false; });
  memory.place = search.place();
  count(search, work);
  if (!(std::sqrt(search.best().squared_distance) <= reach)) return std::nullopt;
  return contact_on(store_.exact[search.place()], center, store_.id(search.place()));
}

double DirectGrid::largest_difference(const Vec3& center) const noexcept {
  return (bounds_.max - center).cwiseAbs().cwiseMax((bounds_.min - center).cwiseAbs()).maxCoeff();
}

std::optional<Contact> DirectGrid::far_nearest(const Vec3& center, double reach, Work& work) const noexcept {
  const double box_distance = std::sqrt(bounds_.squared_distance(center));
  ++work.boxes;
  if (box_distance - culling_slack(largest_difference(center)) > reach) return std::nullopt;
  Candidate best;
  const PreparedTriangle* nearest = nullptr;
  for (const PreparedTriangle& triangle : store_.exact) {
    const Candidate candidate{squared_distance(triangle, center), triangle.index};
    if (!(candidate < best)) continue;
    best = candidate;
    nearest = &triangle;
  }
  work.triangles += store_.exact.size();
  if (nearest == nullptr || !(std::sqrt(best.squared_distance) <= reach)) return std::nullopt;
  return contact_on(*nearest, center, store_.id(static_cast<std::uint32_t>(nearest - store_.exact.data())));
}

}  // namespace touchmark::grid
