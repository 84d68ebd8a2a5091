// The nearest triangle of one of many points, of which little is remembered (followed_point.h). A query looks
// at those listed near the point that can be nearest now, by the planes that they are behind. A list that
// does not cover what can be is made anew.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>

#include "core/search/certified_nearest.h"
#include "core/search/listed_plane.h"
#include "core/simd/lanes.h"
#include "core/simd/prefetch.h"
#include "core/sphere_cluster/tree/cylinder_bvh.h"
#include "core/sphere_cluster/tree/search.h"  // IWYU pragma: keep
#include "core/sphere_cluster/tree/visitors.h"

namespace touchmark {
namespace {

using spheres::FollowedPoint, spheres::NearestVisitor, spheres::NearTriangles;

double distance_of_best(const NearestVisitor& visitor) noexcept {
  return std::sqrt(visitor.candidates.best().squared_distance);
}

/// Tells what was found of the triangle it was shown.
struct RefreshingVisitor {
  NearestVisitor& nearest;
  const Vec3& center = nearest.center;
  Work& work = nearest.work;
  Offset found{};

  static constexpr bool accepts(std::uint32_t) noexcept { return true; }
  void update(std::uint32_t at, const Offset& offset) noexcept {
    found = offset;
    nearest.update(at, offset);
  }
};

/// From where the list was made to the point, in the frame.
struct MoveInFrame {
  float x, y, z, length;

  MoveInFrame(const Vec3& move, double scale) noexcept
      : x(static_cast<float>(move.x() * scale)),
        y(static_cast<float>(move.y() * scale)),
        z(static_cast<float>(move.z() * scale)),
        length(static_cast<float>(move.norm() * scale * (1 + 0x1p-20))) {}
};

/// How near those listed can be to where the point has moved.
class ListedBounds {
 public:
  ListedBounds(const FollowedPoint& list, const MoveInFrame& move) noexcept
      : slack_(move.length * 0x1p-18F), count_(list.count) {
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
    const float padded = std::min(limit * (1 + 0x1p-18F) + slack_, spheres::farthest);
    unsigned near = 0;
    for (std::uint32_t k = 0; k < bound_.size(); ++k) near |= at_most(bound_[k], padded) << 4 * k;
    return near;
  }

 private:
  std::array<Lanes, FollowedPoint::capacity / 4> bound_;
  float slack_;
  std::uint32_t count_;
};

/// Puts a listed triangle behind the plane across the offset that was found from it at a point that has moved
/// so far from the list's.
void set_plane(FollowedPoint& list, std::uint32_t i, const PreparedTriangle& triangle, const Vec3& point,
               const Offset& found, const MoveInFrame& move, double error,
               const FilterFrame& frame) noexcept {
  if (!set_plane_across(list, i, triangle, point, found, error, frame.scale())) return;
  list.bound[i] -= list.x[i] * move.x + list.y[i] * move.y + list.z[i] * move.z;
}

/// Keeps the nearest of what was found, as many as there is room for. Returns what is not kept is how near,
/// squared.
float keep_nearest(const NearTriangles& found, FollowedPoint& list) noexcept {
  std::array<std::uint32_t, NearTriangles::capacity> order;
  for (std::uint32_t i = 0; i < found.count; ++i) {
    std::uint32_t to = i;
    for (; to > 0 && found.bound[i] < found.bound[order[to - 1]]; --to) order[to] = order[to - 1];
    order[to] = i;
  }
  list.nearest = 0;
  list.count = std::min(found.count, FollowedPoint::capacity);
  for (std::uint32_t i = 0; i < list.count; ++i) {
    const std::uint32_t from = order[i];
    list.slot[i] = found.slot[from];
    list.bound[i] = found.bound[from];
    list.x[i] = found.x[from];
    list.y[i] = found.y[from];
    list.z[i] = found.z[from];
  }
  for (std::uint32_t i = list.count; i < FollowedPoint::capacity; ++i) {
    list.slot[i] = 0;
    list.bound[i] = std::numeric_limits<float>::infinity();
    list.x[i] = list.y[i] = list.z[i] = 0;
  }
  if (found.count == list.count) return found.unlisted;
  const float next = found.bound[order[list.count]] * (1 - 0x1p-20F);
  return std::min(found.unlisted, next * next);
}

}  // namespace

/// Shows the visitor those listed that may be nearest. Returns true if nothing else can be nearest: then
/// nothing that was not shown is within the least distance, or the reach, and the error.
template <class Visitor>
bool SphereTree::search_listed(double reach, double error, FollowedPoint& list,
                               Visitor& visitor) const noexcept {
  const Vec3 moved = visitor.center - list.center;
  const MoveInFrame move(moved, frame_.scale());
  const auto limit_within = [&](double distance) {
    const double in_frame = (distance + 4 * error) * frame_.scale() * (1 + 0x1p-20);
    return static_cast<float>(std::min(in_frame, static_cast<double>(spheres::farthest)));
  };
  double farthest = reach;
  const ListedBounds bounds(list, move);
  unsigned near = bounds.within(limit_within(reach));
  const auto look_at = [&](std::uint32_t i) {
    RefreshingVisitor refreshing{visitor};
    visit(list.slot[i], refreshing);
    const double found = std::sqrt(refreshing.found.squared);
    if (found < farthest) {
      farthest = found;
      list.nearest = i;
    } else if (found > farthest + 4 * error) {
      set_plane(list, i, parts_.triangles[list.slot[i]], visitor.center, refreshing.found, move, error,
                frame_);
      return;
    }
    near &= bounds.within(limit_within(farthest));
  };
  // What was nearest the last time is often nearer than the others can be.
  if (const std::uint32_t first = list.nearest; (near >> first & 1) != 0) {
    near &= ~(1U << first);
    look_at(first);
  }
  for (unsigned left = near; left != 0; left &= left - 1)
    prefetch_lines(&parts_.triangles[list.slot[std::countr_zero(left)]], sizeof(PreparedTriangle));
  while (near != 0) {
    const auto i = static_cast<std::uint32_t>(std::countr_zero(near));
    near &= near - 1;
    look_at(i);
  }
  const double uncovered = moved.norm() * (1 + 0x1p-40) + error;
  return farthest + 4 * error + uncovered < list.covered;
}

/// Lists what is near the point, or near where it goes, as far as `farthest` and a margin. Returns false
/// where that is too much.
bool SphereTree::list_anew(const Vec3& center, double farthest, FollowedPoint& list,
                           Work& work) const noexcept {
  const double margin = double{list.margin} * mean_leaf_radius_;
  Vec3 about = center;
  double ahead = 0;
  if (list.epoch == epoch_ && list.count > 0) {
    const Vec3 moved = center - list.center;
    ahead = moved.norm();
    const double part = std::min(0.5, 0.5 * margin / ahead);
    if (ahead > 0) about += part * moved;
    ahead *= part;
  }
  list.epoch = {};
  FilterPoint point = frame_.point(about);
  if (!can_search(point)) return false;
  const double limit = farthest + ahead + margin;
  NearTriangles found;
  const bool is_listed =
      simd_ == Simd::portable
          ? spheres::portable::list_near(parts_, point, frame_.limit(limit * limit), refill_limit(), found,
                                         work)
          : spheres::avx2::list_near(parts_, point, frame_.limit(limit * limit), refill_limit(), found, work);
  constexpr std::uint32_t few = 12, many = 24;
  if (!is_listed || found.count > many)
    list.margin *= 0.5F;
  else if (found.count < few)
    list.margin = std::min(1.25F * list.margin, 1.0F);
  if (!is_listed) return false;
  const float unlisted = keep_nearest(found, list);
  list.epoch = epoch_;
  list.center = about;
  list.covered = clearance_from(unlisted, std::numeric_limits<double>::infinity(), clearance_pad(point));
  return true;
}

/// Is nothing within reach, by what was sampled? Then that is what is remembered of the point.
bool SphereTree::is_sampled_clear(const FilterPoint& point, const Vec3& center, double reach,
                                  FollowedPoint& list) const noexcept {
  double clearance = static_cast<double>(distances_.lower_bound(point)) * frame_.unit();
  if (!(clearance > reach)) {
    if (list.epoch == epoch_ && list.count > 0) return false;
    clearance = static_cast<double>(distances_.tight_lower_bound(point)) * frame_.unit();
  }
  if (!(clearance > reach)) return false;
  list.epoch = epoch_;
  list.center = center;
  list.covered = clearance;
  list.count = list.nearest = 0;
  return true;
}

/// Returns the contact of what the visitor was shown; the search has shown all that nearest_of_ties asks for.
template <class Visitor>
std::optional<Contact> SphereTree::contact_found(const Visitor& visitor, const Vec3& center, double reach,
                                                 double error, Work& work) const noexcept {
  const ClosestCandidates& candidates = visitor.candidates;
  if (!candidates.found()) return std::nullopt;
  const double distance = distance_of_best(visitor);
  if (certified_ && !(is_certain(distance, reach, error) && candidates.is_surely_first(error)))
    return contact_of(candidates, parts_.triangles, center, reach, distance_error(bounds_, center), ids_,
                      work);
  if (distance > reach) return std::nullopt;
  return contact_at(parts_.triangles[candidates.at()], center,
                    {visitor.offset, candidates.best().squared_distance}, ids_[candidates.best().index]);
}

std::optional<Contact> SphereTree::nearest(const Vec3& center, double reach, FollowedPoint& list,
                                           Work& work) const noexcept {
  const FilterPoint point = frame_.point(center);
  if (!can_search(point)) return nearest_without(center, reach, work);
  const double error = frame_.kernel_error(point.plane_error);
  NearestVisitor visitor(parts_, frame_, center, frame_.limit((reach + error) * (reach + error)), error);
  bool is_covered = list.epoch == epoch_ && search_listed(reach, error, list, visitor);
  if (!is_covered) {
    if (!visitor.candidates.found() && is_sampled_clear(point, center, reach, list)) return std::nullopt;
    double farthest = std::min(reach, static_cast<double>(distances_.upper_bound(point)) * frame_.unit());
    if (visitor.candidates.found()) farthest = std::min(farthest, distance_of_best(visitor));
    is_covered = list.cooldown == 0 && list_anew(center, farthest + error, list, visitor.work) &&
                 search_listed(reach, error, list, visitor);
    if (list.cooldown > 0) {
      --list.cooldown;
    } else {
      list.last_cooldown =
          is_covered ? 0 : static_cast<std::uint16_t>(std::min(2 * list.last_cooldown + 1, 255));
      list.cooldown = list.last_cooldown;
    }
  }
  const bool is_exhausted =
      !is_covered && traverse(point, visitor, visitor.work.total() + nearest_limit()) == spheres::exhausted;
  work += visitor.work;
  if (is_exhausted) return fallback(work).nearest(center, reach, work);
  return contact_found(visitor, center, reach, error, work);
}

}  // namespace touchmark
