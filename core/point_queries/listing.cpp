// The triangles around a point, for a caller that keeps them.
#include <algorithm>
#include <limits>

#include "core/bvh/search.h"
#include "core/point_queries/bounds.h"
#include "core/point_queries/queries.h"
#include "core/search/around.h"

namespace touchmark::queries {

bool list_triangles(const Surface& surface, const Vec3& center, double radius, ListedTriangles& into,
                    LimitedWork& work) noexcept {
  const WideBvh& bvh = surface.bvh;
  const FilterFrame& frame = bvh.frame();
  const FilterPoint point = frame.point(center);
  if (!bvh.can_search(point)) return false;
  into.count = 0;
  into.error = frame.kernel_error(point.plane_error);
  const double limit = radius + into.error;
  into.covered = sampled_clearance(bvh, point);
  if (!(into.covered > limit)) into.covered = tight_sampled_clearance(bvh, point);
  if (into.covered > limit) return true;
  bvh::PlaneList<ListedTriangles::capacity> found;
  if (!bvh::list_near(bvh, point, frame.limit(limit * limit), std::min(max_nearest_work(bvh), work.left()),
                      found, work))
    return false;
  into.count = found.count;
  for (std::uint32_t i = 0; i < found.count; ++i) {
    into.triangle[i] = &bvh.parts().triangles[found.slot[i]];
    into.bound[i] = static_cast<float>(found.bound[i] * frame.unit());
    into.x[i] = found.x[i];
    into.y[i] = found.y[i];
    into.z[i] = found.z[i];
  }
  into.covered =
      clearance_from(bvh, found.unlisted, std::numeric_limits<double>::infinity(), clearance_pad(bvh, point));
  return true;
}

}  // namespace touchmark::queries
