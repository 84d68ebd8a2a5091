#include "bench/results/steps_surroundings.h"

#include <algorithm>
#include <numeric>
#include <set>
#include <utility>

#include "bench/workload/sample_steps.h"
#include "core/geometry/point_triangle.h"

namespace touchmark::bench::results {

std::vector<std::size_t> slowest_steps(const measurement::StepLog& log, std::size_t count) {
  std::vector<std::size_t> places(log.ns.size());
  std::iota(places.begin(), places.end(), 0);
  const std::size_t kept = std::min(count, places.size());
  std::partial_sort(
      places.begin(), places.begin() + static_cast<std::ptrdiff_t>(kept), places.end(),
      [&](std::size_t a, std::size_t b) { return log.ns[a] != log.ns[b] ? log.ns[a] > log.ns[b] : a < b; });
  places.resize(kept);
  for (std::size_t& place : places) place = workload::step_at(log.ranges, place);
  return places;
}

std::vector<std::size_t> noted_steps(const std::vector<const measurement::ResultRow*>& rows) {
  std::vector<std::vector<std::size_t>> wishes;
  for (const measurement::ResultRow* row : rows) {
    wishes.push_back(slowest_steps(*row->log, slowest_noted));
    std::vector<std::size_t>& wrong = wishes.emplace_back();
    const std::vector<std::uint8_t>& charged = row->log->charged;
    for (std::size_t i = 0; i < charged.size() && wrong.size() < wrong_noted; ++i)
      if (charged[i] != 0) wrong.push_back(workload::step_at(row->log->ranges, i));
  }
  std::set<std::size_t> noted;
  for (std::size_t turn = 0; turn < std::max(slowest_noted, wrong_noted); ++turn)
    for (const std::vector<std::size_t>& wish : wishes)
      if (turn < wish.size() && noted.size() < max_noted) noted.insert(wish[turn]);
  return {noted.begin(), noted.end()};
}

Surroundings::Surroundings(const TriangleMesh& mesh) : mesh_(mesh), places_(mesh.size()) {}

std::vector<std::uint32_t> Surroundings::around(const Vec3& center) {
  if (!center.allFinite() || looked_at_ > max_looked_at) return {};
  looked_at_ += mesh_.size();
  std::vector<std::pair<double, std::uint32_t>> by_distance;
  by_distance.reserve(mesh_.size());
  for (std::uint32_t i = 0; i < mesh_.size(); ++i)
    by_distance.emplace_back(squared_distance(prepare(mesh_, i), center), i);
  const std::size_t kept = std::min(triangles_around, by_distance.size());
  std::partial_sort(by_distance.begin(), by_distance.begin() + static_cast<std::ptrdiff_t>(kept),
                    by_distance.end());
  std::vector<std::uint32_t> around;
  for (std::size_t i = 0; i < kept; ++i) {
    std::uint32_t& place = places_[by_distance[i].second];
    if (place == 0) {
      chosen_.push_back(by_distance[i].second);
      place = static_cast<std::uint32_t>(chosen_.size());
    }
    around.push_back(place - 1);
  }
  return around;
}

}  // namespace touchmark::bench::results
