#include "core/search/first_touch.h"

namespace touchmark {

std::optional<Impact> moving_impact_of(const FirstTouch& first, std::span<const PreparedTriangle> triangles,
                                       const TriangleIds& ids, const MeshMotion& motion) noexcept {
  if (!first.found()) return std::nullopt;
  const std::uint32_t index = triangles[first.slot()].index;
  const TriangleCorners corners = motion.corners_at(index, first.fraction());
  return Impact{first.fraction(), contact_on(prepare(corners[0], corners[1], corners[2], index),
                                             position_at(first.sweep(), first.fraction()), ids[index])};
}

}  // namespace touchmark
