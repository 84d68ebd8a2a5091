#include "core/point_queries/sampled.h"

#include "core/bvh/sampler.h"
#include "core/search/distance_field/distance_field_filling.h"  // IWYU pragma: keep

namespace touchmark::queries {

bool rejects_once_sampled(const WideBvh& bvh, const FilterPoint& point, const Vec3& center, double reach,
                          PointMemory& memory, std::uint64_t& budget, Work& work) noexcept {
  // With a reach as long as the mesh no sample helps.
  if (!(reach < bvh.radius())) return false;
  bvh::Sampler distance_at(bvh, max_work(bvh) / 2, memory.slot);
  bool is_known_far = false;
  while (!is_known_far && bvh.distances().sample_near(point, distance_at))
    is_known_far = rejects_by_distance_field(bvh, point, center, reach, memory);
  work += distance_at.work();
  budget = remaining(budget, distance_at.work().total());
  return is_known_far;
}

}  // namespace touchmark::queries
