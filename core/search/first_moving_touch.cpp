#include "core/search/first_moving_touch.h"

#include <algorithm>

#include "core/geometry/moving_triangle_sweep.h"

namespace touchmark {

std::optional<double> FirstMovingTouch::fraction_of(const PreparedTriangle& triangle,
                                                    std::uint64_t& exact_decisions) const noexcept {
  const double limit = std::min(fraction_, 1.0);
  if (has_moved(triangle, motion_.after()))
    return moving_sweep_hit(triangle.corner, motion_.corners_at(triangle.index, 1), sweep_, limit,
                            exact_decisions);
  const std::optional<TouchBounds> bounds = touch_bounds(triangle, sweep_, limit, exact_decisions);
  if (!bounds) return std::nullopt;
  return touch_fraction(triangle, sweep_, *bounds, exact_decisions);
}

void FirstMovingTouch::consider(const PreparedTriangle& triangle, std::uint64_t& exact_decisions) noexcept {
  const std::optional<double> fraction = fraction_of(triangle, exact_decisions);
  if (!fraction || *fraction > fraction_) return;
  if (*fraction == fraction_ && triangle.index >= triangle_->index) return;
  triangle_ = &triangle;
  fraction_ = *fraction;
}

std::optional<Impact> FirstMovingTouch::impact(const TriangleIds& ids) const noexcept {
  if (triangle_ == nullptr) return std::nullopt;
  const std::uint32_t index = triangle_->index;
  const TriangleCorners corners = motion_.corners_at(index, fraction_);
  return Impact{fraction_, contact_on(prepare(corners[0], corners[1], corners[2], index),
                                      position_at(sweep_, fraction_), ids[index])};
}

}  // namespace touchmark
