/// Nearest and touching: what the session knows, else the group that covers the point, else the hierarchy.
#include <algorithm>
#include <cmath>

#include "core/float_limits.h"
#include "core/grid_group/direct/direct_grid.h"
#include "core/grid_group/direct/nearest_search.h"
#include "core/search/ties/certified_nearest.h"

namespace touchmark::grid {

DirectGrid::Start DirectGrid::start_at(const Vec3& center, const FilterPoint& point, double reach,
                                       DirectMemory& memory, Work& work) const noexcept {
  if (const Group* group = group_covering(memory.slot, point, work)) return {false, memory.slot, group};
  if (memory.is_near() && rejects_by_distance_field(center, point, reach, memory))
    return {true, memory.slot, nullptr};
  const Vec3 in_frame = store_.frame.to_frame(center);
  if (!cells_.holds(in_frame)) {
    remember(center, point.plane_error, std::sqrt(bounds_.squared_distance(center)), infinity, memory);
    return {memory.lower > reach, memory.slot, nullptr};
  }
  ++work.cells;
  if constexpr (tracing) note_cell(in_frame);
  const Cell cell = cells_.at(in_frame);
  // The memory keeps the middle as it is when rounded.
  const double clearance = (cell.distance - cells_.middle_error()) * store_.frame.unit();
  remember(store_.frame.from_frame(cell.middle), store_.frame.plane_error(cell.middle), clearance, infinity,
           memory);
  if (is_clear(center, reach, memory)) return {true, cell.slot, nullptr};
  return {false, cell.slot, group_covering(cell.slot, point, work)};
}

#if TOUCHMARK_TRACING
void DirectGrid::note_group(const Group& group, bool covers) const {
  if (visits == nullptr || group.count() == 0) return;
  Aabb box;
  for (const std::uint32_t member : groups_.members(group))
    for (const Vec3& corner : store_.exact[member].corner) box.extend(corner);
  visits->groups.push_back({box, static_cast<std::uint32_t>(group.count()), covers});
}

void DirectGrid::note_cell(const Vec3& in_frame) const {
  if (visits == nullptr) return;
  const Vec3 middle = cells_.at(in_frame).middle, half = Vec3::Constant(cells_.edge_at(in_frame) / 2);
  visits->cells.push_back({store_.frame.from_frame(middle - half), store_.frame.from_frame(middle + half)});
}
#endif

/// Hops twice at most to that member of a triangle's group which seems nearest, until its own group covers
/// the point.
[[gnu::always_inline]] inline void DirectGrid::look_for_group(NearestSearch& search, Start& start,
                                                              Work& work) const noexcept {
  for (int hop = 0; hop < 2 && start.group == nullptr && groups_.of(start.slot).count() > 0; ++hop) {
    const std::uint32_t next = search.closest_of(groups_.members(groups_.of(start.slot)));
    if (next == start.slot) break;
    start = {false, next, group_covering(next, search.point(), work)};
  }
}

template <DirectGrid::Sought sought>
DirectGrid::Located DirectGrid::locate(const Vec3& center, const FilterPoint& point, double reach,
                                       DirectMemory& memory, Work& work) const noexcept {
  constexpr bool to_touch = sought == Sought::touch;
  const double enough = to_touch ? reach - store_.frame.kernel_error(point.plane_error) : -1;
  Located located{.plane_error = point.plane_error};
  // To touch, a look at one triangle may do.
  const auto does = [&](std::uint32_t slot) {
    if (!to_touch) return false;
    const double within = upper_bound_to(slot, point, work);
    if (!(within < enough)) return false;
    located.within = within;
    return true;
  };
  if (memory.is_near() && does(memory.slot)) return located;
  const Vec3 before = memory.center;
  Start start = start_at(center, point, reach, memory, work);
  if (start.beyond) return {};
  if (start.slot != memory.slot && does(start.slot)) {
    memory.slot = start.slot;
    return located;
  }
  NearestSearch search(store_, center, point, reach);
  if (to_touch) search.seek_touch(reach, certified_);
  // A cell's triangle may be a neighbour of the one that is needed. Where it is beyond the reach most often
  // all are, and after a jump its neighbours are not worth a look each.
  const bool near = start.group != nullptr || search.may_be_near(start.slot) ||
                    (center - before).squaredNorm() < cell() * cell();
  if (near) look_for_group(search, start, work);
  double squared_lower = reach * reach;
  bool exhausted = false;
  if (start.group != nullptr) {
    squared_lower = store_.frame.squared(search.consider_group(groups_.members(*start.group)));
  } else {
    if (near) search.consider(start.slot);
    exhausted = !search.consider_tree(tree_, work_budget(store_.size()));
    if (!exhausted)
      build_lazily(search.found() ? search.slot() : start.slot, start.slot, center,
                   search.triangles() + search.boxes(), work);
  }
  work.triangles += search.triangles();
  work.boxes += search.boxes();
  if (exhausted && !search.touches()) {
    work.exact_decisions += search.exact_decisions();
    return {.exhausted = true};
  }
  return conclude<sought>(search, center, squared_lower, memory, work);
}

/// What a search that came to its end has located.
template <DirectGrid::Sought sought>
[[gnu::always_inline]] inline DirectGrid::Located DirectGrid::conclude(NearestSearch& search,
                                                                       const Vec3& center,
                                                                       double squared_lower,
                                                                       DirectMemory& memory,
                                                                       Work& work) const noexcept {
  constexpr bool to_touch = sought == Sought::touch;
  if (!search.found()) {
    remember(center, search.point().plane_error, std::sqrt(squared_lower), infinity, memory);
    return {};
  }
  const bool is_content = to_touch && search.touches();
  const Offset offset = is_content ? Offset{} : search.offset();
  if (to_touch) {
    const bool touching = is_content || search.touches_at_last(offset.squared);
    work.exact_decisions += search.exact_decisions();
    if (touching) {
      memory.slot = search.slot();
      return {.plane_error = search.point().plane_error, .within = search.within()};
    }
  }
  memory.slot = search.slot();
  const PreparedTriangle* found = &store_.exact[search.slot()];
  const bool is_first = to_touch || !certified_ || search.is_surely_first();
  return {found,
          is_first ? nullptr : &search.exactly_nearest(work.exact_decisions),
          offset,
          squared_lower,
          search.point().plane_error,
          search.error()};
}

bool DirectGrid::touches(const Probe& probe, DirectMemory& memory, Work& work) const noexcept {
  const FilterPoint point = store_.frame.point(probe.center);
  if (!FilterFrame::covers(point)) return far_nearest(probe.center, probe.radius, work).has_value();
  if (rejects_at_start(probe.center, point, probe.radius, memory)) return false;
  if (memory.moved_less(probe.center, probe.radius - memory.upper)) return true;
  const Located located = locate<Sought::touch>(probe.center, point, probe.radius, memory, work);
  if (located.exhausted) return fallback().touches(probe, work);
  if (located.within < infinity) {
    remember(probe.center, located.plane_error, 0, located.within, memory);
    return true;
  }
  if (located.triangle == nullptr) return false;
  const double distance = std::sqrt(located.offset.squared);
  // What doubles left open does not touch: else it would be within.
  const bool touching = distance <= probe.radius && !(certified_ && probe.radius - distance <= located.error);
  const double lower = touching ? distance : std::min(std::sqrt(located.squared_lower), distance);
  remember(probe.center, located.plane_error, lower, distance, memory);
  return touching;
}

std::optional<Contact> DirectGrid::nearest(const Vec3& center, double reach, DirectMemory& memory,
                                           Work& work) const noexcept {
  const FilterPoint point = store_.frame.point(center);
  if (!FilterFrame::covers(point)) return far_nearest(center, reach, work);
  if (rejects_at_start(center, point, reach, memory)) return std::nullopt;
  const Located located = locate<Sought::contact>(center, point, reach, memory, work);
  if (located.exhausted) return fallback().nearest(center, reach, work);
  if (located.triangle == nullptr) return std::nullopt;
  const Contact contact = contact_at(*located.triangle, center, located.offset, store_.id(memory.slot));
  const bool within = contact.distance <= reach;
  const double lower =
      within ? contact.distance : std::min(std::sqrt(located.squared_lower), contact.distance);
  remember(center, located.plane_error, lower, contact.distance, memory);
  if (certified_ && !(located.exactly == nullptr && is_certain(contact.distance, reach, located.error))) {
    const double error = distance_error(bounds_, center);
    const bool is_first = located.exactly == nullptr;
    if (!is_first || !is_certain_on(*located.triangle, contact.distance, center, reach, error))
      return exact_contact(is_first ? *located.triangle : *located.exactly, center, reach, error, work);
  }
  if (!within) return std::nullopt;
  return contact;
}

std::optional<Contact> DirectGrid::exact_contact(const PreparedTriangle& nearest, const Vec3& center,
                                                 double reach, double error, Work& work) const noexcept {
  NearestOfTies only(center);
  only.consider(nearest);
  const std::optional<Contact> contact = only.contact(reach, error, store_.ids);
  work.exact_decisions += only.exact_decisions();
  return contact;
}

std::optional<Contact> DirectGrid::far_nearest(const Vec3& center, double reach, Work& work) const noexcept {
  const double box_distance = std::sqrt(bounds_.squared_distance(center));
  ++work.boxes;
  if (box_distance - distance_error(bounds_, center) > reach) return std::nullopt;
  return nearest_of_all(store_.exact, bounds_, center, reach, store_.ids, work);
}

}  // namespace touchmark::grid
