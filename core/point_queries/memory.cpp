#include "core/point_queries/memory.h"

namespace touchmark::queries {

// As memory.h says; and a short list of triangles takes no more than half a kilobyte.
static_assert(sizeof(PointMemory) <= 11 * 1024 && sizeof(bvh::PlaneList<16, 0>) <= 512);

void remember_box(const WideBvh& bvh, const Vec3& center, double reach, double clearance,
                  PointMemory& memory) noexcept {
  memory.claim(bvh.epoch());
  // A clearance that lasts twice as long as these questions serves better than the box.
  constexpr std::uint16_t questions = 64;
  const double half = 0.5 * (clearance - reach);
  memory.for_box = (center - memory.center).squaredNorm() < half * half ? std::uint16_t{0} : questions;
  memory.remember(center, clearance * (1 - 0x1p-40), std::numeric_limits<double>::infinity());
}

}  // namespace touchmark::queries
