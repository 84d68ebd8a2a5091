#include "core/scene/body_query.h"

#include "core/geometry/distance_error.h"

namespace touchmark {

double distance_error(const Accuracy& accuracy, const Aabb& bounds, const Vec3& center) noexcept {
  return accuracy.relative * largest_difference(bounds, center) + accuracy.absolute;
}

}  // namespace touchmark
