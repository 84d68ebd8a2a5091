#include "core/mesh_motion.h"

#include <algorithm>

#include "core/mesh_update.h"

namespace touchmark {

MeshMotion::MeshMotion(const TriangleMesh& before, const TriangleMesh& after)
    : before_(&before), after_(&after) {
  Connectivity(before).expect(after);
  for (std::size_t i = 0; i < before.vertices().size(); ++i)
    max_shift_ = std::max(max_shift_, (after.vertices()[i] - before.vertices()[i]).cwiseAbs().maxCoeff());
  max_shift_ *= 1.75;  // more than the root of 3
}

std::array<Vec3, 3> MeshMotion::corners_at(std::uint32_t triangle, double time) const noexcept {
  std::array<Vec3, 3> corners;
  for (int i = 0; i < 3; ++i) {
    const Vec3 &from = before_->corner(triangle, i), &to = after_->corner(triangle, i);
    corners[static_cast<std::size_t>(i)] = time < 1 ? Vec3(from + time * (to - from)) : to;
  }
  return corners;
}

}  // namespace touchmark
