// Sweeps and contacts among the triangles listed around a point. A list is made for whoever asks for
// contacts, of what is a little farther than asked, so that the next questions are about the same.
#include "core/point_queries/neighborhood.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/bvh/search.h"
#include "core/geometry/sphere_triangle_sweep.h"
#include "core/point_queries/near_leaves.h"
#include "core/search/contacts_within.h"
#include "core/search/first_touch.h"
#include "core/search/plane_filter/listed_plane.h"
#include "core/simd/prefetch.h"

namespace touchmark::queries {
namespace {

/// The places in a list of the triangles that a question is about.
struct PlacesInList {
  std::array<std::uint32_t, decltype(Neighborhood::list)::padded_capacity> at;
  std::uint32_t count = 0;
};

/// Bounds and what is added to them are off by less than 2^-20 of what they are and of the moves:
/// docs/exactness.md, E14.
void find_places(const WideBvh& bvh, const Vec3& from, const Vec3& to, double reach, const Neighborhood& near,
                 PlacesInList& places) noexcept {
  const Vec3 begin = from - near.center, end = to - near.center;
  const double longest = std::sqrt(std::max(begin.squaredNorm(), end.squaredNorm()));
  const double limit = (reach * (1 + 0x1p-17) + longest * 0x1p-17) * bvh.frame().scale();
  const auto rounded = static_cast<float>(std::min(limit, static_cast<double>(bvh::farthest)));
  const bvh::MoveInFrame first(begin, bvh.frame().scale()), last(end, bvh.frame().scale());
  places.count = bvh::with_isa(bvh.simd(), [&](auto isa) {
    return isa.places_within(near.list, first, last, rounded, places.at.data());
  });
  for (std::uint32_t i = 0; i < places.count; ++i)
    prefetch_lines(&bvh.parts().triangles[near.list.slot[places.at[i]]], sizeof(PreparedTriangle));
}

/// Lists what is within the reach of the way between two points, and a margin that is for the next questions:
/// most of it ahead. Returns false where that is too much, or where lists have not paid lately.
bool list_around(const WideBvh& bvh, const Vec3& from, const Vec3& to, double reach, std::uint64_t budget,
                 Neighborhood& near, Work& work) noexcept {
  // Each answer looks through the whole list, and its making costs as much as some answers do: one that gives
  // far more of them is too long.
  constexpr std::uint32_t enough = 96, many = 160, few_answers = 16, many_answers = 48;
  constexpr float min_margin = 0x1p-6F;
  if (near.backoff.waits()) return false;
  const Vec3 way = to - from;
  const double length = way.norm();
  const double margin = std::max(double{near.margin} * bvh.mean_leaf_radius(), 0.25 * length);
  // Within a tick of long ways a list would not serve the next one.
  if (near.max_path > 3 * std::max(length, margin)) return false;
  const std::uint32_t answered = near.answered;
  const bool paid = answered >= Neighborhood::answers_that_pay;
  near.answered = Neighborhood::answers_that_pay;
  if (!paid) {
    near.backoff.failed();
    return false;
  }
  near.covered = -1;
  near.measured_count = 0;
  const double ahead = 0.5 * length + (length > 0 ? 0.5 * margin : 0.0);
  Vec3 about = length > 0 ? Vec3(from + (ahead / length) * way) : from;
  if (!bvh.can_search(about)) about = from;
  const FilterPoint point = bvh.frame().point(about);
  const double farther = std::max((from - about).norm(), (to - about).norm());
  const double limit = reach + farther + margin + bvh.frame().kernel_error(point.plane_error);
  near.list.start_anew();
  Work spent;
  const bool is_listed =
      bvh::list_near(bvh, point, bvh.frame().limit(limit * limit), budget, near.list, spent);
  work += spent;
  if (!is_listed || near.list.count > many)
    near.margin = std::max(0.5F * near.margin, min_margin);
  else if (answered > many_answers)
    near.margin = std::max(0.8F * near.margin, min_margin);
  else if (answered < few_answers && near.list.count < enough)
    near.margin = std::min(1.25F * near.margin, 1.0F);
  if (!is_listed) {
    near.backoff.failed();
    return false;
  }
  near.backoff.last /= 2;
  near.answered = 0;
  near.list.fill_up((near.list.count + bvh::width - 1) / bvh::width * bvh::width);
  near.center = about;
  near.covered = clearance_from(bvh, near.list.unlisted, std::numeric_limits<double>::infinity(),
                                clearance_pad(bvh, point));
  return true;
}

/// Leaves those places whose triangles no plane keeps apart from the ball; the others get that plane.
void keep_apart(const WideBvh& bvh, const Sweep& sweep, Neighborhood& near, PlacesInList& places,
                Work& work) noexcept {
  const bvh::SweptBall ball(sweep, 1, bvh.frame().scale());
  const bvh::MoveInFrame shift(near.center - sweep.from, bvh.frame().scale());
  const float shift_error = ball.rounding * (std::abs(shift.x) + std::abs(shift.y) + std::abs(shift.z));
  auto& list = near.list;
  std::uint32_t left = 0;
  for (std::uint32_t first = 0; first < places.count; first += bvh::width) {
    const std::uint32_t count = std::min(places.count - first, bvh::width);
    std::array<std::uint32_t, bvh::width> slots;
    for (std::uint32_t k = 0; k < count; ++k) slots[k] = list.slot[places.at[first + k]];
    bvh::EightPlanes planes;
    const unsigned apart = bvh::with_isa(bvh.simd(), [&](auto isa) {
      return isa.kept_apart(bvh.parts().triangles.data(), slots.data(), count, ball, planes);
    });
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
      list.bound[place] = planes.height[k] + shift.along(planes.x[k], planes.y[k], planes.z[k]) - shift_error;
    }
  }
  places.count = left;
}

}  // namespace

/// A ball that holds both ends holds the way.
bool is_listed(const Vec3& from, const Vec3& to, double reach, const Neighborhood& near) noexcept {
  const double room = (near.covered - reach) * (1 - 0x1p-40);
  return room > 0 && (from - near.center).squaredNorm() < room * room &&
         (to - near.center).squaredNorm() < room * room;
}

bool sweep_listed(const WideBvh& bvh, const Sweep& sweep, double reach, std::uint64_t budget,
                  FirstTouch& first, PointMemory& memory, LimitedWork& work) noexcept {
  Neighborhood& near = memory.neighborhood;
  auto& list = near.list;
  if (!(near.contacts_reach >= 0) || !stays_among_listed_leaves(bvh, sweep.from - near.measured_at))
    return false;
  const Vec3 way = sweep.to - sweep.from;
  const double squared_way = way.squaredNorm();
  near.max_path = std::max(std::sqrt(squared_way), 0.9 * near.max_path);
  const double error = bvh.frame().kernel_error(
      std::max(bvh.frame().point(sweep.from).plane_error, bvh.frame().point(sweep.to).plane_error));
  const double farthest = reach + 2 * error;
  if (!is_listed(sweep.from, sweep.to, farthest, near) &&
      !(list_around(bvh, sweep.from, sweep.to, std::max(farthest, near.contacts_reach), budget, near, work) &&
        is_listed(sweep.from, sweep.to, farthest, near)))
    return false;
  ++near.answered;
  PlacesInList places;
  find_places(bvh, sweep.from, sweep.to, farthest, near, places);
  if (places.count >= bvh::min_at_once) keep_apart(bvh, sweep, near, places, work);
  const bool is_measured = sweep.from == near.measured_at;
  std::uint32_t next = 0;
  for (std::uint32_t i = 0; i < places.count; ++i) {
    const std::uint32_t place = places.at[i], slot = list.slot[place];
    const PreparedTriangle& triangle = bvh.parts().triangles[slot];
    ++work.triangles;
    while (next < near.measured_count && near.measured[next].place < place) ++next;
    Offset offset;
    Vec3 end = sweep.from;
    const bool is_known = is_measured && next < near.measured_count && near.measured[next].place == place;
    if (is_known) {
      offset = near.measured[next].offset;
    } else {
      const Vec3 away(double{list.x[place]}, double{list.y[place]}, double{list.z[place]});
      if (away.dot(way) < 0) end = sweep.to;
      ++work.triangles;
      offset = bvh::offset_at(bvh, slot, end);
    }
    if (plane_keeps_apart(triangle, sweep, offset)) {
      if (!is_known) set_plane_across(list, place, triangle, near.center, offset, error, bvh.frame().scale());
      continue;
    }
    // The place of the way that is nearest to what was found is often about where the triangle is nearest.
    const double part = std::clamp((end - offset.vector - sweep.from).dot(way) / squared_way, 0.0, 1.0);
    if (part > 0) {
      const Vec3 nearer = sweep.from + part * way;
      ++work.triangles;
      if (plane_keeps_apart(triangle, sweep, bvh::offset_at(bvh, slot, nearer))) continue;
    }
    if (work.exceeds_limit()) return true;
    first.consider(triangle, work.exact_decisions);
  }
  return true;
}

bool contacts_listed(const WideBvh& bvh, const Vec3& center, double reach, double error,
                     ContactsWithin& found, PointMemory& memory, LimitedWork& work) noexcept {
  Neighborhood& near = memory.neighborhood;
  auto& list = near.list;
  const bool pays = near.contacts_reach >= 0 && stays_among_listed_leaves(bvh, center - near.measured_at);
  // Reaches change from question to question: the next list is to serve about the largest of the last few.
  near.contacts_reach = std::max(reach, 0.9 * near.contacts_reach);
  near.measured_at = center;
  near.measured_count = 0;
  const double farthest = reach + 2 * error;
  if (!is_listed(center, center, farthest, near) &&
      !(pays &&
        list_around(bvh, center, center, farthest, std::min(max_refill_work(bvh) / 2, work.left()), near,
                    work) &&
        is_listed(center, center, farthest, near)))
    return false;
  ++near.answered;
  PlacesInList places;
  find_places(bvh, center, center, farthest, near, places);
  for (std::uint32_t i = 0; i < places.count; ++i) {
    const std::uint32_t place = places.at[i], slot = list.slot[place];
    ++work.triangles;
    const Offset offset = bvh::offset_at(bvh, slot, center);
    const double distance = std::sqrt(offset.squared);
    if (distance > reach + 4 * error) {
      set_plane_across(list, place, bvh.parts().triangles[slot], near.center, offset, error,
                       bvh.frame().scale());
      continue;
    }
    if (near.measured_count < near.measured.size()) near.measured[near.measured_count++] = {place, offset};
    found.consider(slot, offset, work);
    if (work.exceeds_limit()) return true;
  }
  return true;
}

}  // namespace touchmark::queries
