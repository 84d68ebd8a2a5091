/// Looks for the nearest triangle among the few that are listed around a point (core/bvh/followed_point.h),
/// by the planes that they are behind, and lists them.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>

#include "core/bvh/followed_point.h"
#include "core/bvh/search.h"
#include "core/point_queries/bounds.h"
#include "core/point_queries/nearest_visitor.h"
#include "core/search/plane_filter/listed_plane.h"
#include "core/simd/prefetch.h"

// Unnamed, though in a header, since the visitor is.
namespace touchmark::queries {
namespace {

using bvh::FollowedPoint;
using ShortList = decltype(FollowedPoint::list);
using GatheredList = bvh::PlaneList<64>;

/// Keeps the nearest of what was found, as many as there is room for. Returns a bound of how near what is not
/// kept is, squared.
float keep_nearest(const GatheredList& found, ShortList& list) noexcept {
  std::array<std::uint32_t, GatheredList::capacity> order;
  for (std::uint32_t i = 0; i < found.count; ++i) {
    std::uint32_t to = i;
    for (; to > 0 && found.bound[i] < found.bound[order[to - 1]]; --to) order[to] = order[to - 1];
    order[to] = i;
  }
  list.count = std::min(found.count, ShortList::capacity);
  for (std::uint32_t i = 0; i < list.count; ++i) list.copy(i, found, order[i]);
  list.fill_up(ShortList::capacity);
  if (found.count == list.count) return found.unlisted;
  const float next = found.bound[order[list.count]] * (1 - 0x1p-20F);
  return std::min(found.unlisted, next * next);
}

/// Shows the visitor those listed that may be nearest. Returns true if nothing else can be nearest: then
/// nothing that was not shown is within the least distance, or the reach, and the error.
bool search_listed(const WideBvh& bvh, double reach, double error, FollowedPoint& followed,
                   NearestVisitor& visitor) noexcept {
  ShortList& list = followed.list;
  const Vec3 moved = visitor.center - followed.center;
  const bvh::MoveInFrame move(moved, bvh.frame().scale());
  const auto length = static_cast<float>(moved.norm() * bvh.frame().scale() * (1 + 0x1p-20));
  const auto within = [&](double distance) {
    const double in_frame = (distance + 4 * error) * bvh.frame().scale() * (1 + 0x1p-20);
    const auto limit = static_cast<float>(std::min(in_frame, static_cast<double>(bvh::farthest)));
    return bvh::with_isa(bvh.simd(),
                         [&](auto isa) { return isa.listed_within(followed, move, length, limit); });
  };
  double farthest = reach;
  unsigned near = list.count == 0 ? 0 : within(reach);
  const auto look_at = [&](std::uint32_t i) {
    ++visitor.work.triangles;
    const Offset offset = bvh::offset_at(bvh, list.slot[i], visitor.center);
    visitor.update(list.slot[i], offset);
    const double found = std::sqrt(offset.squared);
    if (found < farthest) {
      farthest = found;
      followed.nearest = i;
    } else if (found > farthest + 4 * error) {
      set_plane_across(list, i, bvh.parts().triangles[list.slot[i]], followed.center, offset, error,
                       bvh.frame().scale());
      return;
    }
    near &= within(farthest);
  };
  // What was nearest the last time is often nearer than the others can be.
  if (const std::uint32_t first = followed.nearest; (near >> first & 1) != 0) {
    near &= ~(1U << first);
    look_at(first);
  }
  for (unsigned left = near; left != 0; left &= left - 1)
    prefetch_lines(&bvh.parts().triangles[list.slot[std::countr_zero(left)]], sizeof(PreparedTriangle));
  while (near != 0) {
    const auto i = static_cast<std::uint32_t>(std::countr_zero(near));
    near &= near - 1;
    look_at(i);
  }
  const double uncovered = moved.norm() * (1 + 0x1p-40) + error;
  return followed.covers(farthest + 4 * error, uncovered);
}

/// Lists what is near the point, or near where it goes, as far as `farthest` and a margin. Returns false
/// where that is too much, or more work than the budget.
bool list_anew(const WideBvh& bvh, const Vec3& center, double farthest, FollowedPoint& followed,
               std::uint64_t budget, Work& work) noexcept {
  const double margin = double{followed.margin} * bvh.mean_leaf_radius();
  Vec3 about = center;
  double ahead = 0;
  if (followed.epoch == bvh.epoch() && followed.list.count > 0) {
    const Vec3 moved = center - followed.center;
    ahead = moved.norm();
    const double part = std::min(0.5, 0.5 * margin / ahead);
    if (ahead > 0) about += part * moved;
    ahead *= part;
  }
  followed.epoch = {};
  FilterPoint point = bvh.frame().point(about);
  if (!bvh.can_search(point)) return false;
  const double limit = farthest + ahead + margin;
  GatheredList found;
  const bool is_listed = bvh::list_near(bvh, point, bvh.frame().limit(limit * limit),
                                        std::min(budget, max_refill_work(bvh)), found, work);
  constexpr std::uint32_t few = 12, many = 24;
  if (!is_listed || found.count > many)
    followed.margin = std::max(0.5F * followed.margin, 0.05F);
  else if (found.count < few)
    followed.margin = std::min(1.25F * followed.margin, 1.0F);
  if (!is_listed) return false;
  followed.nearest = 0;
  const float unlisted = keep_nearest(found, followed.list);
  followed.epoch = bvh.epoch();
  followed.center = about;
  followed.covered =
      clearance_from(bvh, unlisted, std::numeric_limits<double>::infinity(), clearance_pad(bvh, point));
  return true;
}

}  // namespace
}  // namespace touchmark::queries
