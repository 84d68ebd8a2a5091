#include "core/geometry/certified_nearest.h"

#include <algorithm>
#include <cmath>
#include <compare>

namespace touchmark {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// By kernel distances of a copy scaled by a power of two.
std::optional<Contact> nearest_at_any_scale(std::span<const PreparedTriangle> triangles, const Aabb& bounds,
                                            const Vec3& center, double reach, std::span<const TriangleId> ids,
                                            Work& work) noexcept {
  work.triangles += 2 * triangles.size();
  const double scale = unit_for(largest_difference(bounds, center));
  const Vec3 point = scale * center;
  const auto distance_to = [&](const PreparedTriangle& triangle) {
    return std::sqrt(squared_distance(scaled(triangle, scale), point));
  };
  double least = infinity;
  for (const PreparedTriangle& triangle : triangles) least = std::min(least, distance_to(triangle));
  const double limit = least + distance_error({scale * bounds.min, scale * bounds.max}, point);
  NearestOfTies ties(center);
  for (const PreparedTriangle& triangle : triangles)
    if (distance_to(triangle) <= limit) ties.consider(triangle);
  return ties.contact(reach, ids, work.exact_decisions);
}

}  // namespace

double unit_for(double largest_difference) noexcept {
  constexpr int most = 1000;
  if (!(largest_difference > 0)) return 1;
  const int exponent = std::isinf(largest_difference) ? most : std::ilogb(largest_difference);
  return std::ldexp(1.0, std::clamp(-exponent, -most, most));
}

CloseFoot NearestOfTies::foot_of(const PreparedTriangle& triangle) noexcept {
  if (const std::optional<CloseFoot> close = close_foot(triangle.corner, center_)) return *close;
  exactly_ = true;
  return {foot_exactly(triangle.corner, center_), std::nullopt};
}

void NearestOfTies::consider(const PreparedTriangle& triangle) noexcept {
  if (&triangle == nearest_) return;
  const CloseFoot foot = foot_of(triangle);
  if (nearest_ != nullptr) {
    std::partial_ordering order = compare(foot.foot, foot_.foot);
    if (order == std::partial_ordering::unordered) {
      if (on_same_feature(foot, foot_)) {
        order = std::partial_ordering::equivalent;
      } else {
        order = compare_exactly(triangle.corner, nearest_->corner, center_);
        exactly_ = true;
      }
    }
    if (order > 0 || (order == 0 && triangle.index > nearest_->index)) return;
  }
  nearest_ = &triangle;
  foot_ = foot;
}

bool NearestOfTies::is_within(double reach) noexcept {
  if (std::isinf(reach)) return true;
  const std::partial_ordering order = compare(foot_.foot, {.distance = {reach, 0}});
  if (order != std::partial_ordering::unordered) return order <= 0;
  exactly_ = true;
  return within_exactly(nearest_->corner, center_, reach);
}

std::optional<Contact> NearestOfTies::contact(double reach, std::span<const TriangleId> ids,
                                              std::uint64_t& exact_decisions) noexcept {
  if (nearest_ == nullptr) return std::nullopt;
  const bool within = is_within(reach);
  if (exactly_) ++exact_decisions;
  if (!within) return std::nullopt;
  const Foot& foot = foot_.foot;
  const bool coincident = foot.direction.isZero(0);
  return Contact{center_ - foot.offset, coincident ? face_normal(*nearest_) : foot.direction,
                 std::min(foot.distance.rounded(), reach),
                 ids.empty() ? nearest_->index : ids[nearest_->index]};
}

std::optional<Contact> nearest_of_all(std::span<const PreparedTriangle> triangles, const Aabb& bounds,
                                      const Vec3& center, double reach, std::span<const TriangleId> ids,
                                      Work& work) noexcept {
  if (!center.allFinite() || !(reach >= 0)) return std::nullopt;
  const double error = distance_error(bounds, center);
  if (std::isinf(error)) {
    return nearest_at_any_scale(triangles, bounds, center, reach, ids, work);
  }
  work.triangles += triangles.size();
  const auto [nearest, best] = nearest_as_computed(triangles, center);
  const double distance = std::sqrt(best.squared_distance);
  if (!is_certain(distance, reach, error) && !is_certain_on(*nearest, distance, center, reach, error)) {
    work.triangles += triangles.size();
    return nearest_of_ties(
        center, distance, reach, error, ids, work.exact_decisions,
        [&](double, const auto& visit) { std::for_each(triangles.begin(), triangles.end(), visit); });
  }
  if (distance > reach) return std::nullopt;
  return contact_on(*nearest, center, ids.empty() ? best.index : ids[best.index]);
}

}  // namespace touchmark
