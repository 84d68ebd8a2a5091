// The triangles around a point, for a caller that keeps them.
#include <limits>

#include "core/search/listed_triangles.h"
#include "core/sphere_cluster/tree/cylinder_bvh.h"
#include "core/sphere_cluster/tree/near_triangles.h"
#include "core/sphere_cluster/tree/search.h"  // IWYU pragma: keep

namespace touchmark {

bool SphereTree::list_triangles(const Vec3& center, double radius, ListedTriangles& into,
                                Work& work) const noexcept {
  const FilterPoint point = frame_.point(center);
  if (!can_search(point)) return false;
  into.count = 0;
  into.error = frame_.kernel_error(point.plane_error);
  const double limit = radius + into.error;
  into.covered = sampled_clearance(point);
  if (!(into.covered > limit))
    into.covered = static_cast<double>(distances_.tight_lower_bound(point)) * frame_.unit();
  if (into.covered > limit) return true;
  spheres::NearTrianglesUpTo<ListedTriangles::capacity> found;
  const bool is_listed = simd_ == Simd::portable
                             ? spheres::portable::list_near(parts_, point, frame_.limit(limit * limit),
                                                            nearest_limit(), found, work)
                             : spheres::avx2::list_near(parts_, point, frame_.limit(limit * limit),
                                                        nearest_limit(), found, work);
  if (!is_listed) return false;
  into.count = found.count;
  for (std::uint32_t i = 0; i < found.count; ++i) {
    into.triangle[i] = &parts_.triangles[found.slot[i]];
    into.bound[i] = static_cast<float>(found.bound[i] * frame_.unit());
    into.x[i] = found.x[i];
    into.y[i] = found.y[i];
    into.z[i] = found.z[i];
  }
  into.covered =
      clearance_from(found.unlisted, std::numeric_limits<double>::infinity(), clearance_pad(point));
  return true;
}

}  // namespace touchmark
