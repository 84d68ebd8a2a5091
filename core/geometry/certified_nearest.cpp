#include "core/geometry/certified_nearest.h"

#include <algorithm>
#include <cmath>
#include <compare>

#include "core/geometry/shared_feature.h"

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
  return ties.contact(reach, infinity, ids, work.exact_decisions);
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
      if (on_same_feature(foot, foot_) || have_same_corners(triangle.corner, nearest_->corner)) {
        order = std::partial_ordering::equivalent;
      } else if (is_nearer_inside(foot_, nearest_->corner, foot)) {
        order = std::partial_ordering::greater;
      } else if (is_nearer_inside(foot, triangle.corner, foot_)) {
        order = std::partial_ordering::less;
      } else if (foot.inside && foot_.inside) {
        order = compare_inside(triangle.corner, nearest_->corner, center_);
      }
    }
    if (order == std::partial_ordering::unordered) {
      order = compare_exactly(triangle.corner, nearest_->corner, center_);
      exactly_ = true;
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

std::optional<Contact> NearestOfTies::contact(double reach, double error, std::span<const TriangleId> ids,
                                              std::uint64_t& exact_decisions) noexcept {
  if (nearest_ == nullptr) return std::nullopt;
  const bool within = is_within(reach);
  if (exactly_) ++exact_decisions;
  if (!within) return std::nullopt;
  const TriangleId id = ids.empty() ? nearest_->index : ids[nearest_->index];
  // The same bits as where the search was certain of this triangle at once.
  const double computed = std::sqrt(squared_distance(*nearest_, center_));
  if (is_certain_on(*nearest_, computed, center_, reach, error)) return contact_on(*nearest_, center_, id);
  const Foot& foot = foot_.foot;
  const bool coincident = foot.direction.isZero(0);
  return Contact{center_ - foot.offset, coincident ? face_normal(*nearest_) : foot.direction,
                 std::min(foot.distance.rounded(), reach), id};
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
  NearestSoFar so_far(error);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    so_far.take({squared_distance(triangles[i], center), triangles[i].index}, static_cast<std::uint32_t>(i));
  const PreparedTriangle& nearest = triangles[so_far.at()];
  const double distance = std::sqrt(so_far.best().squared_distance);
  if (!is_certain_first(so_far, triangles, distance, center, reach, error)) {
    work.triangles += triangles.size();
    return nearest_of_ties(
        center, distance, reach, error, ids, work.exact_decisions,
        [&](double, const auto& visit) { std::for_each(triangles.begin(), triangles.end(), visit); });
  }
  if (distance > reach) return std::nullopt;
  return contact_on(nearest, center, ids.empty() ? nearest.index : ids[nearest.index]);
}

}  // namespace touchmark
