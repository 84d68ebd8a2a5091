// The nearest triangle of one of many points, of which little is remembered (followed_point.h). A query looks
// at those listed near the point that can be nearest now, by the planes that they are behind. A list that
// does not cover what can be is made anew.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "core/bvh/search.h"
#include "core/search/plane_filter/listed_plane.h"
#include "core/simd/lanes.h"
#include "core/simd/prefetch.h"
#include "core/sphere_cluster/queries/bounds.h"
#include "core/sphere_cluster/queries/nearest_visitor.h"
#include "core/sphere_cluster/queries/queries.h"

namespace touchmark::spheres {
namespace {

using ShortList = decltype(FollowedPoint::list);
using GatheredList = bvh::PlaneList<64>;

double distance_of_best(const NearestVisitor& visitor) noexcept {
  return std::sqrt(visitor.candidates.best().squared_distance);
}

/// How near those listed can be to where the point has moved.
class ListedBounds {
 public:
  ListedBounds(const ShortList& list, const bvh::MoveInFrame& move, float length) noexcept
      : slack_(length * 0x1p-18F), count_(list.count) {
    if (count_ == 0) return;
    const Lanes x = broadcast(move.x), y = broadcast(move.y), z = broadcast(move.z);
    for (std::uint32_t k = 0; k < bound_.size(); ++k) {
      const std::uint32_t i = 4 * k;
      bound_[k] = load(list.bound + i) + x * load(list.x + i) + y * load(list.y + i) + z * load(list.z + i);
    }
  }
  /// Returns those that may be within the limit, as bits. Bounds and what is added to them are off by less
  /// than 2^-20 of what they are and of the move: docs/exactness.md, E14.
  unsigned within(float limit) const noexcept {
    if (count_ == 0) return 0;
    const float padded = std::min(limit * (1 + 0x1p-18F) + slack_, bvh::farthest);
    unsigned near = 0;
    for (std::uint32_t k = 0; k < bound_.size(); ++k) near |= at_most(bound_[k], padded) << 4 * k;
    return near;
  }

 private:
  std::array<Lanes, ShortList::capacity / 4> bound_;
  float slack_;
  std::uint32_t count_;
};

/// Puts a listed triangle behind the plane across the offset that was found from it at a point that has moved
/// so far from the list's.
void set_plane(ShortList& list, std::uint32_t i, const PreparedTriangle& triangle, const Vec3& point,
               const Offset& found, const bvh::MoveInFrame& move, double error,
               const FilterFrame& frame) noexcept {
  if (!set_plane_across(list, i, triangle, point, found, error, frame.scale())) return;
  list.bound[i] -= move.along(list.x[i], list.y[i], list.z[i]);
}

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
  const auto limit_within = [&](double distance) {
    const double in_frame = (distance + 4 * error) * bvh.frame().scale() * (1 + 0x1p-20);
    return static_cast<float>(std::min(in_frame, static_cast<double>(bvh::farthest)));
  };
  double farthest = reach;
  const ListedBounds bounds(list, move, length);
  unsigned near = bounds.within(limit_within(reach));
  const auto look_at = [&](std::uint32_t i) {
    ++visitor.work.triangles;
    const Offset offset = bvh::offset_at(bvh, list.slot[i], visitor.center);
    visitor.update(list.slot[i], offset);
    const double found = std::sqrt(offset.squared);
    if (found < farthest) {
      farthest = found;
      followed.nearest = i;
    } else if (found > farthest + 4 * error) {
      set_plane(list, i, bvh.parts().triangles[list.slot[i]], visitor.center, offset, move, error,
                bvh.frame());
      return;
    }
    near &= bounds.within(limit_within(farthest));
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
  return farthest + 4 * error + uncovered < followed.covered;
}

/// Lists what is near the point, or near where it goes, as far as `farthest` and a margin. Returns false
/// where that is too much.
bool list_anew(const WideBvh& bvh, const Vec3& center, double farthest, FollowedPoint& followed,
               Work& work) noexcept {
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
  const bool is_listed =
      bvh::list_near(bvh, point, bvh.frame().limit(limit * limit), max_refill_work(bvh), found, work);
  constexpr std::uint32_t few = 12, many = 24;
  if (!is_listed || found.count > many)
    followed.margin *= 0.5F;
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

/// True if nothing is within reach, by what was sampled. Then that is what is remembered of the point.
bool is_sampled_clear(const WideBvh& bvh, const FilterPoint& point, const Vec3& center, double reach,
                      FollowedPoint& followed) noexcept {
  double clearance = sampled_clearance(bvh, point);
  if (!(clearance > reach)) {
    if (followed.epoch == bvh.epoch() && followed.list.count > 0) return false;
    clearance = tight_sampled_clearance(bvh, point);
  }
  if (!(clearance > reach)) return false;
  followed.epoch = bvh.epoch();
  followed.center = center;
  followed.covered = clearance;
  followed.list.count = followed.nearest = 0;
  return true;
}

}  // namespace

std::optional<Contact> nearest(const Surface& surface, const Vec3& center, double reach,
                               FollowedPoint& followed, Work& work) noexcept {
  const WideBvh& bvh = surface.bvh;
  const FilterPoint point = bvh.frame().point(center);
  if (!bvh.can_search(point)) return nearest_of_every(bvh, center, reach, work);
  const double error = bvh.frame().kernel_error(point.plane_error);
  NearestVisitor visitor(bvh.parts(), bvh.frame(), center,
                         bvh.frame().limit((reach + error) * (reach + error)), error);
  bool is_covered = followed.epoch == bvh.epoch() && search_listed(bvh, reach, error, followed, visitor);
  if (!is_covered) {
    if (!visitor.candidates.found() && is_sampled_clear(bvh, point, center, reach, followed))
      return std::nullopt;
    double farthest = std::min(reach, sampled_distance(bvh, point));
    if (visitor.candidates.found()) farthest = std::min(farthest, distance_of_best(visitor));
    if (!followed.backoff.waits()) {
      is_covered = list_anew(bvh, center, farthest + error, followed, visitor.work) &&
                   search_listed(bvh, reach, error, followed, visitor);
      is_covered ? followed.backoff.paid() : followed.backoff.failed();
    }
  }
  const bool is_exhausted =
      !is_covered &&
      bvh::traverse(bvh, point, visitor, visitor.work.total() + max_nearest_work(bvh)) == bvh::exhausted;
  work += visitor.work;
  if (is_exhausted) return scan_of(bvh, surface.certified, work).nearest(center, reach, work);
  if (!visitor.candidates.found()) return std::nullopt;
  return contact_found(surface, visitor, reach, error, distance_of_best(visitor), work);
}

}  // namespace touchmark::spheres
