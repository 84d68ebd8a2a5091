// The nearest triangle of one of many points, of which little is remembered (core/bvh/followed_point.h). A
// query looks at those listed near the point that can be nearest now. A list that does not cover what can be
// is made anew.
#include <algorithm>
#include <cmath>

#include "core/point_queries/listed_search.h"
#include "core/point_queries/queries.h"

namespace touchmark::queries {
namespace {

double distance_of_best(const NearestVisitor& visitor) noexcept {
  return std::sqrt(visitor.candidates.best().squared_distance);
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
      is_covered = list_anew(bvh, center, farthest + error, followed, any_work, visitor.work) &&
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

}  // namespace touchmark::queries
