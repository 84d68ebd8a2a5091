/// Nearest and touching: what the session knows, else the group that serves the point, else the hierarchy.
#include <algorithm>
#include <bit>
#include <cmath>

#include "core/geometry/certified_nearest.h"
#include "core/grid_group/direct_grid.h"
#include "core/grid_group/nearest_search.h"

namespace touchmark::grid {
namespace {

/// Calls visit(triangle) for every triangle that the filter does not put beyond the distance. False when it
/// has tested more than `most` triangles and boxes before the end.
template <class Visit>
bool for_each_near(const TriangleStore& store, const BoxTree& tree, const Vec3& center, double distance,
                   std::uint64_t most, Work& work, const Visit& visit) noexcept {
  const std::uint64_t before = work.boxes + work.triangles;
  const FilterPoint point = store.frame.point(center);
  const float limit = store.frame.limit(distance * distance);
  BoxStack stack;
  const auto open = [&](std::uint32_t level, std::uint32_t node) {
    work.boxes += BoxTree::arity;
    stack.push(lower_bounds(tree.node(level, node), point), limit, node, level);
  };
  open(static_cast<std::uint32_t>(tree.levels()) - 1, 0);
  while (!stack.empty()) {
    if (work.boxes + work.triangles - before > most) return false;
    const BoxStack::Entry next = stack.pop();
    if (next.level > 0) {
      open(next.level - 1, next.index);
      continue;
    }
    const std::uint32_t first = next.index * TriangleStore::block_size;
    work.triangles += TriangleStore::block_size;
    for (std::uint32_t at = first; at < first + TriangleStore::block_size; at += 4) {
      const TrianglePlanes* planes = &store.planes[at];
      const Lanes bounds = lower_bounds(planes[0], planes[1], planes[2], planes[3], point);
      for (unsigned left = at_most(bounds, limit); left != 0; left &= left - 1)
        visit(store.exact[at + static_cast<std::uint32_t>(std::countr_zero(left))]);
    }
  }
  return true;
}

}  // namespace

void DirectGrid::remember(const Vec3& center, float tau, double lower, double upper,
                          DirectMemory& memory) const noexcept {
  // Twice culling_slack, for the kernel's error here: tau is 2^-21 of a length above the largest difference.
  // What the error grows by elsewhere goes with the displacement and is in moved_less.
  const double slack = static_cast<double>(tau) * (0x1p-24 * (1 + 0x1p-20)) / store_.frame.scale();
  memory.center = center;
  memory.lower = lower - slack;
  memory.upper = upper + slack;
}

DirectGrid::Start DirectGrid::start_at(const Vec3& center, const FilterPoint& point, double reach,
                                       DirectMemory& memory, Work& work) const noexcept {
  if (memory.owner == serial_) {
    if (const Group* group = serving(memory.place, point, work)) return {false, memory.place, group};
  } else {
    memory = DirectMemory();
    memory.owner = serial_;
  }
  if (!distances_.empty()) {
    // Few bytes, which stay in the cache: what is far needs no cell.
    remember(center, point.tau, static_cast<double>(distances_.at_least(point)) / store_.frame.scale(),
             std::numeric_limits<double>::infinity(), memory);
    if (memory.lower > reach) return {true, memory.place, nullptr};
  }
  const Vec3 in_frame = store_.frame.to_frame(center);
  if (!cells_.holds(in_frame)) {
    remember(center, point.tau, std::sqrt(bounds_.squared_distance(center)),
             std::numeric_limits<double>::infinity(), memory);
    return {memory.lower > reach, memory.place, nullptr};
  }
  ++work.cells;
  const Cell cell = cells_.at(in_frame);
  const Vec3 middle = store_.frame.origin() + cell.middle / store_.frame.scale();
  remember(middle, store_.frame.tau(cell.middle), cell.distance / store_.frame.scale(),
           std::numeric_limits<double>::infinity(), memory);
  if (surely_free(center, reach, memory)) return {true, cell.place, nullptr};
  return {false, cell.place, serving(cell.place, point, work)};
}

DirectGrid::Located DirectGrid::locate(const Vec3& center, double reach, Sought sought, DirectMemory& memory,
                                       Work& work) const noexcept {
  const FilterPoint point = store_.frame.point(center);
  Start start = start_at(center, point, reach, memory, work);
  if (start.beyond) return {};
  NearestSearch search(store_, center, point, reach);
  // A cell's triangle may be a neighbour of the one that is needed.
  for (int hop = 0; hop < 2 && start.group == nullptr && groups_.of(start.place).count() > 0; ++hop) {
    const std::uint32_t next = search.closest_of(groups_.members(groups_.of(start.place)));
    if (next == start.place) break;
    start = {false, next, serving(next, search.point(), work)};
  }
  double squared_lower = reach * reach;
  bool gave_up = false;
  if (start.group != nullptr) {
    squared_lower = store_.frame.squared(search.consider_group(groups_.members(*start.group)));
  } else {
    search.consider(start.place);
    gave_up = !search.consider_tree(tree_, most_work_before_all(store_.size()));
    if (!gave_up) grow(search.found() ? search.place() : start.place, start.place, center, work);
  }
  work.triangles += search.triangles();
  work.boxes += search.boxes();
  if (gave_up) return {.gave_up = true};
  if (!search.found()) {
    remember(center, search.point().tau, std::sqrt(squared_lower), std::numeric_limits<double>::infinity(),
             memory);
    return {};
  }
  memory.place = search.place();
  return {&store_.exact[search.place()],
          search.offset(),
          squared_lower,
          search.point().tau,
          search.error(),
          search.triangles() + search.boxes(),
          false,
          sought == Sought::touch || search.is_surely_first()};
}

bool DirectGrid::touches(const Probe& probe, DirectMemory& memory, Work& work) const noexcept {
  if (!(probe.radius >= 0)) return false;
  if (!store_.frame.covers(probe.center)) return far_nearest(probe.center, probe.radius, work).has_value();
  if (memory.owner == serial_ && memory.moved_less(probe.center, probe.radius - memory.upper)) return true;
  const Located located = locate(probe.center, probe.radius, Sought::touch, memory, work);
  if (located.gave_up) return all().touches(probe, work);
  if (located.triangle == nullptr) return false;
  const double distance = std::sqrt(located.offset.squared);
  const bool touching =
      !certified_ || std::abs(distance - probe.radius) > located.error
          ? distance <= probe.radius
          : nearest_tie(probe.center, distance, probe.radius, located.error, located.spent, work).has_value();
  const double lower = touching ? distance : std::min(std::sqrt(located.squared_lower), distance);
  remember(probe.center, located.tau, lower, distance, memory);
  return touching;
}

std::optional<Contact> DirectGrid::nearest(const Vec3& center, double reach, DirectMemory& memory,
                                           Work& work) const noexcept {
  if (!(reach >= 0)) return std::nullopt;
  if (!store_.frame.covers(center)) return far_nearest(center, reach, work);
  const Located located = locate(center, reach, Sought::contact, memory, work);
  if (located.gave_up) return all().nearest(center, reach, work);
  if (located.triangle == nullptr) return std::nullopt;
  const Contact contact = contact_at(*located.triangle, center, located.offset, store_.id(memory.place));
  const bool within = contact.distance <= reach;
  const double lower =
      within ? contact.distance : std::min(std::sqrt(located.squared_lower), contact.distance);
  remember(center, located.tau, lower, contact.distance, memory);
  if (certified_ && !(located.surely_first && is_certain(contact.distance, reach, located.error))) {
    const double error = distance_error(bounds_, center);
    if (!located.surely_first || !is_certain_on(*located.triangle, contact.distance, center, reach, error))
      return nearest_tie(center, contact.distance, reach, error, located.spent, work);
  }
  if (!within) return std::nullopt;
  return contact;
}

std::optional<Contact> DirectGrid::nearest_tie(const Vec3& center, double distance, double reach,
                                               double error, std::uint64_t spent, Work& work) const noexcept {
  const std::uint64_t most = left_of(most_work_before_all(store_.size()), spent);
  return nearest_of_ties(center, distance, reach, error, store_.ids, work.exact_decisions,
                         [&](double within, const auto& visit) {
                           if (for_each_near(store_, tree_, center, within, most, work, visit)) return;
                           work.triangles += store_.size();
                           std::for_each(store_.exact.begin(), store_.exact.end(), visit);
                         });
}

std::optional<Contact> DirectGrid::far_nearest(const Vec3& center, double reach, Work& work) const noexcept {
  const double box_distance = std::sqrt(bounds_.squared_distance(center));
  ++work.boxes;
  if (box_distance - distance_error(bounds_, center) > reach) return std::nullopt;
  return nearest_of_all(store_.exact, bounds_, center, reach, store_.ids, work);
}

}  // namespace touchmark::grid
