#include "core/scene/near_bodies.h"

#include <algorithm>
#include <cmath>

#include "core/scene/seen_body.h"

namespace touchmark {

// It is defined here so that it is inlined where it is asked most.
double Clearance::remaining(const Vec3& point, const SceneBodies& bodies) const noexcept {
  // A few roundings of the way and of both differences; what is not a number clears nothing.
  constexpr double rounding = 8 * std::numeric_limits<double>::epsilon();
  const double moved = bodies.moves() == moves ? 0 : bodies.motion() - motion;
  const double spent = (point - center).norm() + moved;
  return lower - spent - rounding * (spent + (lower < 0x1p1000 ? lower : 0));
}

double lower_distance(const SceneBodies& bodies, std::uint32_t body, const Vec3& point) noexcept {
  const PlacedBody& placed = bodies[body];
  return lower_distance(bodies.bounds_of(placed), SeenBody(placed.pose, double{placed.rigid}, point));
}

double lower_distance(const Aabb& bounds, const SeenBody& seen) noexcept {
  const double distance = std::sqrt(bounds.squared_distance(seen.center()));
  const double lower = seen.in_scene(distance, 4 * std::numeric_limits<double>::epsilon() * distance).lower;
  return lower > 0 ? lower : 0;  // also of what is not a number
}

std::size_t NearBodies::slot_of(const BodyId& id) const noexcept {
  for (const Entry& entry : listed())
    if (entry.id == id) return entry.slot;
  return room;
}

void NearBodies::add(const Entry& entry) noexcept {
  std::size_t at = count_ < room ? count_++ : room - 1;
  for (; at > 0 && entries_[at - 1].lower > entry.lower; --at) entries_[at] = entries_[at - 1];
  entries_[at] = entry;
}

bool NearBodies::pays_to_list(const Vec3& point) noexcept {
  // A list is made where it may serve so many ticks. Where it would not, it is tried again in a while.
  constexpr double ticks_listed = 4, growth_of_gap = 1.004;
  // One query that moves less, such as a second one at a place, is not the end of jumps.
  step_ = was_asked_ ? std::max((point - last_).norm(), 0.5 * step_) : 0;
  was_asked_ = true;
  last_ = point;
  is_jumping_ = !(ticks_listed * step_ <= gap_);
  if (is_jumping_) gap_ *= growth_of_gap;
  return !is_jumping_;
}

void NearBodies::learn_gap(double reach) noexcept {
  constexpr double least = 0x1p-10;
  const double gap = others_.lower - reach;
  gap_ = gap > least * reach ? gap : least * reach;  // also where it is no number
}

NearBodies::Looked NearBodies::list(const Vec3& point, double reach, const SceneBodies& bodies) noexcept {
  const std::array<Entry, room> before = entries_;
  const std::size_t count_before = count_;
  count_ = 0;
  Looked looked;
  // A body that is farther than all that fill the list now is none of the nearest.
  double limit = std::numeric_limits<double>::infinity();
  const auto is_there = [&](const Entry& entry) { return bodies.has(entry.id); };
  if (count_before == room && std::ranges::all_of(before, is_there)) {
    limit = 0;
    for (const Entry& entry : before) limit = std::max(limit, lower_distance(bodies, entry.id.index, point));
    looked.bodies += room;
  }
  const auto farthest = [&] { return count_ < room ? limit : entries_[room - 1].lower; };
  looked.boxes = bodies.tree().for_each_within(point, farthest(), [&](std::uint32_t body) {
    ++looked.bodies;
    const double lower = lower_distance(bodies, body, point);
    if (lower < farthest() || (lower == limit && count_ < room)) add({bodies.id(body), room, lower, {}});
    return farthest();
  });
  others_ = Clearance::at(point, farthest(), bodies);
  know_all_are_there(bodies);
  // Who was listed before keeps its slot.
  std::array<bool, room> taken{};
  for (Entry& entry : listed()) {
    for (std::size_t i = 0; i < count_before; ++i)
      if (before[i].id == entry.id) entry.slot = before[i].slot;
    if (entry.slot < room) taken[entry.slot] = true;
  }
  for (Entry& entry : listed()) {
    if (entry.slot < room) continue;
    entry.slot = static_cast<std::uint32_t>(std::find(taken.begin(), taken.end(), false) - taken.begin());
    taken[entry.slot] = true;
  }
  part(point, reach, bodies);
  return looked;
}

void NearBodies::part(const Vec3& point, double reach, const SceneBodies& bodies) noexcept {
  // A quarter of the way to the farthest of them leaves the last ones alone for a while, and keeps the first
  // few.
  double farthest = 0;
  for (const Entry& entry : listed()) farthest = std::max(farthest, entry.lower);
  const double limit = reach + std::max(0.0, 0.25 * (farthest - reach));
  const auto end = entries_.begin() + static_cast<std::ptrdiff_t>(count_);
  const auto last =
      std::partition(entries_.begin(), end, [&](const Entry& entry) { return !(entry.lower > limit); });
  near_count_ = static_cast<std::size_t>(last - entries_.begin());
  double lower = std::numeric_limits<double>::infinity();
  for (const Entry& entry : listed().subspan(near_count_)) lower = std::min(lower, entry.lower);
  listed_last_ = Clearance::at(point, lower, bodies);
}

std::size_t NearBodies::look_again(const Vec3& point, double reach, const SceneBodies& bodies) noexcept {
  const bool is_parted = listed_last_.clears(point, reach, bodies);
  const auto begin = entries_.begin(), end = begin + static_cast<std::ptrdiff_t>(count_);
  const auto removed = [&](const Entry& entry) { return !bodies.has(entry.id); };
  const bool are_all_there = epoch_ == bodies.epoch() && removals_ == bodies.removals();
  if (is_parted && !are_all_there) {
    const auto near_end = begin + static_cast<std::ptrdiff_t>(near_count_);
    const auto kept = std::remove_if(begin, near_end, removed);
    count_ -= static_cast<std::size_t>(near_end - kept);
    std::move(near_end, end, kept);
    near_count_ = static_cast<std::size_t>(kept - begin);
  } else if (!is_parted) {
    count_ = static_cast<std::size_t>(std::remove_if(begin, end, removed) - begin);
    near_count_ = count_;
    know_all_are_there(bodies);
  }
  for (Entry& entry : near()) {
    entry.lower = entry.seen.epoch == bodies.epoch() ? entry.seen.remaining(point, bodies) : 0;
    if (entry.lower > reach) continue;
    entry.lower = 0;
    entry.raise(point, lower_distance(bodies, entry.id.index, point), bodies);
  }
  const std::size_t looked = near_count_;
  if (!is_parted) part(point, reach, bodies);
  return looked;
}

void NearBodies::conclude(const Vec3& point, const SceneBodies& bodies) noexcept {
  double lower = others_.is_about(bodies) ? others_.remaining(point, bodies) : 0;
  lower = std::min(lower, listed_last_.is_about(bodies) ? listed_last_.remaining(point, bodies) : 0);
  for (const Entry& entry : near()) lower = std::min(lower, entry.lower);
  all_ = Clearance::at(point, lower, bodies);
}

}  // namespace touchmark
