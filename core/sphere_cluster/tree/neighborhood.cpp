// Sweeps and contacts among the triangles listed around a point (neighborhood.h). A list is made for whoever
// asks for contacts, of what is a little farther than asked, so that the next questions are about the same.
#include "core/sphere_cluster/tree/neighborhood.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/geometry/sphere_triangle_sweep.h"
#include "core/search/contacts_within.h"
#include "core/search/first_touch.h"
#include "core/search/listed_plane.h"
#include "core/simd/prefetch.h"
#include "core/sphere_cluster/tree/cylinder_bvh.h"
#include "core/sphere_cluster/tree/search.h"  // IWYU pragma: keep

namespace touchmark {
namespace {

using spheres::MoveFromCenter, spheres::Neighborhood, spheres::PlacesInList;

/// Tells what was found of the triangle it was shown.
struct MeasuringVisitor {
  const Vec3& center;
  Work& work;
  Offset found{};

  static constexpr bool accepts(std::uint32_t) noexcept { return true; }
  void update(std::uint32_t, const Offset& offset) noexcept { found = offset; }
};

MoveFromCenter in_frame(const Vec3& move, double scale) noexcept {
  return {static_cast<float>(move.x() * scale), static_cast<float>(move.y() * scale),
          static_cast<float>(move.z() * scale)};
}

}  // namespace

/// Bounds and what is added to them are off by less than 2^-20 of what they are and of the moves:
/// docs/exactness.md, E14.
void SphereTree::find_places(const Vec3& from, const Vec3& to, double reach, const Neighborhood& list,
                             PlacesInList& places) const noexcept {
  const Vec3 begin = from - list.center, end = to - list.center;
  const double longest = std::sqrt(std::max(begin.squaredNorm(), end.squaredNorm()));
  const double limit = (reach * (1 + 0x1p-17) + longest * 0x1p-17) * frame_.scale();
  const auto rounded = static_cast<float>(std::min(limit, static_cast<double>(spheres::farthest)));
  const MoveFromCenter first = in_frame(begin, frame_.scale()), last = in_frame(end, frame_.scale());
  places.count = simd_ == Simd::portable
                     ? spheres::portable::places_within(list, first, last, rounded, places.at.data())
                     : spheres::avx2::places_within(list, first, last, rounded, places.at.data());
  for (std::uint32_t i = 0; i < places.count; ++i)
    prefetch_lines(&parts_.triangles[list.slot[places.at[i]]], sizeof(PreparedTriangle));
}

/// Is everything within the reach of the way between two points listed? A ball that holds both ends holds the
/// way.
bool SphereTree::is_listed(const Vec3& from, const Vec3& to, double reach,
                           const Neighborhood& list) const noexcept {
  const double room = (list.covered - reach) * (1 - 0x1p-40);
  return room > 0 && (from - list.center).squaredNorm() < room * room &&
         (to - list.center).squaredNorm() < room * room;
}

/// Lists what is within the reach of the way between two points, and a margin that is for the next questions:
/// most of it ahead. Returns false where that is too much, or where lists have not paid lately.
bool SphereTree::list_around(const Vec3& from, const Vec3& to, double reach, std::uint64_t budget,
                             Neighborhood& list, Work& work) const noexcept {
  // Each answer looks through the whole list, and its making costs as much as some answers do: one that gives
  // far more of them is too long.
  constexpr std::uint32_t enough = 96, many = 160, few_answers = 16, many_answers = 48;
  constexpr float least_margin = 0x1p-6F;
  if (list.cooldown > 0) {
    --list.cooldown;
    return false;
  }
  const Vec3 way = to - from;
  const double length = way.norm();
  const double margin = std::max(double{list.margin} * mean_leaf_radius_, 0.25 * length);
  // Within a tick of long ways a list would not serve the next one.
  if (list.longest_way > 3 * std::max(length, margin)) return false;
  const std::uint32_t answered = list.answered;
  const bool paid = answered >= Neighborhood::answers_that_pay;
  list.answered = Neighborhood::answers_that_pay;
  if (!paid) {
    list.wait();
    return false;
  }
  list.covered = -1;
  list.measured_count = 0;
  const double ahead = 0.5 * length + (length > 0 ? 0.5 * margin : 0.0);
  Vec3 about = length > 0 ? Vec3(from + (ahead / length) * way) : from;
  if (!can_search(about)) about = from;
  const FilterPoint point = frame_.point(about);
  const double farther = std::max((from - about).norm(), (to - about).norm());
  const double limit = reach + farther + margin + frame_.kernel_error(point.plane_error);
  list.count = 0;
  list.unlisted = spheres::farthest;
  Work spent;
  const bool is_listed =
      simd_ == Simd::portable
          ? spheres::portable::list_near(parts_, point, frame_.limit(limit * limit), budget, list, spent)
          : spheres::avx2::list_near(parts_, point, frame_.limit(limit * limit), budget, list, spent);
  work += spent;
  if (!is_listed || list.count > many)
    list.margin = std::max(0.5F * list.margin, least_margin);
  else if (answered > many_answers)
    list.margin = std::max(0.8F * list.margin, least_margin);
  else if (answered < few_answers && list.count < enough)
    list.margin = std::min(1.25F * list.margin, 1.0F);
  if (!is_listed) {
    list.wait();
    return false;
  }
  list.last_cooldown /= 2;
  list.answered = 0;
  list.finish();
  list.center = about;
  list.covered = clearance_from(list.unlisted, std::numeric_limits<double>::infinity(), clearance_pad(point));
  return true;
}

/// Leaves those places whose triangles no plane keeps apart from the ball; the others get that plane.
void SphereTree::keep_apart(const Sweep& sweep, Neighborhood& list, PlacesInList& places,
                            Work& work) const noexcept {
  const spheres::SweptBall ball(sweep, 1, frame_.scale());
  const MoveFromCenter shift = in_frame(list.center - sweep.from, frame_.scale());
  const float shift_error = ball.rounding * (std::abs(shift.x) + std::abs(shift.y) + std::abs(shift.z));
  std::uint32_t left = 0;
  for (std::uint32_t first = 0; first < places.count; first += spheres::tree_width) {
    const std::uint32_t count = std::min(places.count - first, spheres::tree_width);
    std::array<std::uint32_t, spheres::tree_width> slots;
    for (std::uint32_t k = 0; k < count; ++k) slots[k] = list.slot[places.at[first + k]];
    spheres::EightPlanes planes;
    const unsigned apart =
        simd_ == Simd::portable
            ? spheres::portable::kept_apart(parts_.triangles.data(), slots.data(), count, ball, planes)
            : spheres::avx2::kept_apart(parts_.triangles.data(), slots.data(), count, ball, planes);
    for (std::uint32_t k = 0; k < count; ++k) {
      const std::uint32_t place = places.at[first + k];
      if ((apart >> k & 1) == 0) {
        places.at[left++] = place;
        continue;
      }
      ++work.triangles;
      list.x[place] = planes.x[k];
      list.y[place] = planes.y[k];
      list.z[place] = planes.z[k];
      list.bound[place] = planes.height[k] +
                          (planes.x[k] * shift.x + planes.y[k] * shift.y + planes.z[k] * shift.z) -
                          shift_error;
    }
  }
  places.count = left;
}

/// Looks for the first touch among the listed triangles. Returns false where they may not be all there are.
bool SphereTree::sweep_listed(const Sweep& sweep, double reach, std::uint64_t budget, FirstTouch& first,
                              Memory& memory, Work& work) const noexcept {
  Neighborhood& list = memory.neighborhood;
  if (!(list.contacts_reach >= 0) || !certified_ || !is_slow(sweep.from - list.measured_at)) return false;
  const Vec3 way = sweep.to - sweep.from;
  const double squared_way = way.squaredNorm();
  list.longest_way = std::max(std::sqrt(squared_way), 0.9 * list.longest_way);
  const double error =
      frame_.kernel_error(std::max(frame_.point(sweep.from).plane_error, frame_.point(sweep.to).plane_error));
  const double farthest = reach + 2 * error;
  if (!is_listed(sweep.from, sweep.to, farthest, list) &&
      !(list_around(sweep.from, sweep.to, std::max(farthest, list.contacts_reach), budget, list, work) &&
        is_listed(sweep.from, sweep.to, farthest, list)))
    return false;
  ++list.answered;
  PlacesInList places;
  find_places(sweep.from, sweep.to, farthest, list, places);
  if (places.count >= spheres::fewest_at_once) keep_apart(sweep, list, places, work);
  const bool is_measured = sweep.from == list.measured_at;
  std::uint32_t next = 0;
  for (std::uint32_t i = 0; i < places.count; ++i) {
    const std::uint32_t place = places.at[i], slot = list.slot[place];
    const PreparedTriangle& triangle = parts_.triangles[slot];
    ++work.triangles;
    while (next < list.measured_count && list.measured[next].place < place) ++next;
    Offset offset;
    Vec3 end = sweep.from;
    const bool is_known = is_measured && next < list.measured_count && list.measured[next].place == place;
    if (is_known) {
      offset = list.measured[next].offset;
    } else {
      const Vec3 away(double{list.x[place]}, double{list.y[place]}, double{list.z[place]});
      if (away.dot(way) < 0) end = sweep.to;
      MeasuringVisitor visitor{end, work};
      visit(slot, visitor);
      offset = visitor.found;
    }
    if (plane_keeps_apart(triangle, sweep, offset)) {
      if (!is_known) set_plane_across(list, place, triangle, list.center, offset, error, frame_.scale());
      continue;
    }
    // The place of the way that is nearest to what was found is often about where the triangle is nearest.
    const double part = std::clamp((end - offset.vector - sweep.from).dot(way) / squared_way, 0.0, 1.0);
    if (part > 0) {
      const Vec3 nearer = sweep.from + part * way;
      MeasuringVisitor visitor{nearer, work};
      visit(slot, visitor);
      if (plane_keeps_apart(triangle, sweep, visitor.found)) continue;
    }
    first.consider(triangle, slot, work.exact_decisions);
  }
  return true;
}

/// Shows all triangles within the reach, of those listed. Returns false where they may not be all there are.
bool SphereTree::contacts_listed(const Vec3& center, double reach, double error, ContactsWithin& found,
                                 Memory& memory, Work& work) const noexcept {
  Neighborhood& list = memory.neighborhood;
  const bool pays = list.contacts_reach >= 0 && is_slow(center - list.measured_at);
  // Reaches change from question to question: the next list is to serve about the largest of the last few.
  list.contacts_reach = std::max(reach, 0.9 * list.contacts_reach);
  list.measured_at = center;
  list.measured_count = 0;
  const double farthest = reach + 2 * error;
  if (!is_listed(center, center, farthest, list) &&
      !(pays && list_around(center, center, farthest, refill_limit() / 2, list, work) &&
        is_listed(center, center, farthest, list)))
    return false;
  ++list.answered;
  PlacesInList places;
  find_places(center, center, farthest, list, places);
  for (std::uint32_t i = 0; i < places.count; ++i) {
    const std::uint32_t place = places.at[i], slot = list.slot[place];
    MeasuringVisitor visitor{center, work};
    visit(slot, visitor);
    const double distance = std::sqrt(visitor.found.squared);
    if (distance > reach + 4 * error) {
      set_plane_across(list, place, parts_.triangles[slot], list.center, visitor.found, error,
                       frame_.scale());
      continue;
    }
    if (list.measured_count < list.measured.size())
      list.measured[list.measured_count++] = {place, visitor.found};
    found.consider(slot, visitor.found, work);
  }
  return true;
}

}  // namespace touchmark
