// The nearest triangle of one of many points, of which little is remembered (followed_point.h). A query looks
// at those listed near the point that can be nearest now: bounds of their distances shrink by what the point
// moves, and are refreshed by each look. A list that does not cover what can be is made anew by a search from
// the root.
#include <algorithm>
#include <cmath>
#include <limits>

#include "core/search/certified_nearest.h"
#include "core/sphere_cluster/tree/cylinder_bvh.h"
#include "core/sphere_cluster/tree/search.h"  // IWYU pragma: keep
#include "core/sphere_cluster/tree/visitors.h"

namespace touchmark {
namespace {

using spheres::FollowedPoint, spheres::NearestVisitor;

/// How much farther than the nearest triangle others are listed, in mean radii of the leaves: more makes
/// lists that serve longer moves and take longer to make.
constexpr double listed_margin = 1;

double distance_of_best(const NearestVisitor& visitor) noexcept {
  return std::sqrt(visitor.candidates.best().squared_distance);
}

/// Tells what was found of the triangle it was shown.
struct RefreshingVisitor {
  NearestVisitor& nearest;
  const Vec3& center = nearest.center;
  Work& work = nearest.work;
  double found = 0;  ///< its distance

  static constexpr bool accepts(std::uint32_t) noexcept { return true; }
  void update(std::uint32_t at, const Offset& offset) noexcept {
    found = std::sqrt(offset.squared);
    nearest.update(at, offset);
  }
};

/// Lists the nearest of all triangles that it is shown, as far as there is room and within the margin.
struct ListingVisitor {
  NearestVisitor& nearest;
  FollowedPoint& list;
  double reach, margin;
  const Vec3& center;
  float limit;
  Work work{};
  double unlisted = std::numeric_limits<double>::infinity();  ///< the least distance of those left out

  static constexpr bool accepts(std::uint32_t) noexcept { return true; }
  void update(std::uint32_t at, const Offset& found) noexcept {
    nearest.update(at, found);
    insert(at, std::sqrt(found.squared));
    const double best = distance_of_best(nearest);
    double farthest = std::min(reach, best) + margin;
    if (list.count == FollowedPoint::capacity)
      farthest = std::min(farthest, std::max(best, in_mesh(list.distance[list.count - 1])));
    limit = std::min(limit, nearest.frame.limit(farthest * farthest));
  }

 private:
  double in_mesh(float distance) const noexcept {
    return static_cast<double>(distance) * nearest.frame.unit();
  }
  void insert(std::uint32_t at, double distance) noexcept {
    const float rounded_down = nearest.frame.to_frame_rounded_down(distance);
    std::uint32_t to = list.count;
    if (to < FollowedPoint::capacity) {
      ++list.count;
    } else {
      if (!(rounded_down < list.distance[to - 1])) {
        unlisted = std::min(unlisted, in_mesh(rounded_down));
        return;
      }
      unlisted = std::min(unlisted, in_mesh(list.distance[--to]));
    }
    for (; to > 0 && rounded_down < list.distance[to - 1]; --to) {
      list.slot[to] = list.slot[to - 1];
      list.distance[to] = list.distance[to - 1];
    }
    list.slot[to] = at;
    list.distance[to] = rounded_down;
  }
};

}  // namespace

/// Shows the visitor those listed that may be nearest, and takes the point along. Returns true if nothing
/// else can be nearest: then nothing that was not shown is within the least distance, or the reach, and the
/// error.
template <class Visitor>
bool SphereTree::search_listed(double reach, double error, FollowedPoint& list,
                               Visitor& visitor) const noexcept {
  const double moved = (visitor.center - list.center).norm() * (1 + 0x1p-40) + error;
  list.covered -= moved;
  list.center = visitor.center;
  const auto moved_in_frame = static_cast<float>(moved * frame_.scale() * (1 + 0x1p-20));
  for (float& distance : list.distance) distance = distance * (1 - 0x1p-22F) - moved_in_frame;
  const auto limit_within = [&](double distance) {
    const double in_frame = (distance + 4 * error) * frame_.scale() * (1 + 0x1p-20);
    return static_cast<float>(std::min(in_frame, static_cast<double>(spheres::farthest)));
  };
  float limit = limit_within(reach);
  double farthest = reach;
  const auto look_at = [&](std::uint32_t i) {
    if (list.distance[i] > limit) return;
    RefreshingVisitor refreshing{visitor};
    visit(list.slot[i], refreshing);
    list.distance[i] = frame_.to_frame_rounded_down(refreshing.found - error);
    if (!(refreshing.found < farthest)) return;
    farthest = refreshing.found;
    limit = limit_within(farthest);
    list.nearest = i;
  };
  // What was nearest the last time is often nearer than the others can be.
  const std::uint32_t first = list.nearest;
  if (list.count > 0) look_at(first);
  for (std::uint32_t i = 0; i < list.count; ++i)
    if (i != first) look_at(i);
  return farthest + 4 * error < list.covered;
}

/// Shows the visitor all that may be nearest, and lists what is near. Returns false where that is too much
/// work.
template <class Visitor>
bool SphereTree::list_anew(const FilterPoint& point, double reach, double error, FollowedPoint& list,
                           Visitor& visitor) const noexcept {
  const double margin = listed_margin * mean_leaf_radius_;
  const double sampled = static_cast<double>(distances_.upper_bound(point)) * frame_.unit();
  const double farthest = std::min(reach, sampled) + error + margin;
  list.count = list.nearest = 0;
  list.epoch = {};
  ListingVisitor listing{visitor, list, reach, margin, visitor.center, frame_.limit(farthest * farthest)};
  const float unseen = traverse(point, listing, work_limit());
  visitor.work += listing.work;
  if (unseen == spheres::exhausted) return false;
  list.epoch = epoch_;
  list.center = visitor.center;
  list.covered = clearance_from(unseen, listing.unlisted, clearance_pad(point));
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
  if (list.epoch == epoch_) {
    NearestVisitor visitor(parts_, frame_, center, spheres::farthest, error);
    const bool is_covered = search_listed(reach, error, list, visitor);
    work += visitor.work;
    if (is_covered) return contact_found(visitor, center, reach, error, work);
  }
  if (is_sampled_clear(point, center, reach, list)) return std::nullopt;
  NearestVisitor visitor(parts_, frame_, center, spheres::farthest, error);
  const bool is_listed = list_anew(point, reach, error, list, visitor);
  work += visitor.work;
  if (!is_listed) return fallback().nearest(center, reach, work);
  return contact_found(visitor, center, reach, error, work);
}

}  // namespace touchmark
