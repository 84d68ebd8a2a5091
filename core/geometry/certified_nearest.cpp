#include "core/geometry/certified_nearest.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <compare>

namespace touchmark {
namespace {

constexpr double infinity = std::numeric_limits<double>::infinity();

/// Equal where double-doubles can't tell.
std::partial_ordering surely(const DoubleDouble& a, const DoubleDouble& b) noexcept {
  const double larger = std::max(a.high, b.high);
  // Below, their lower halves underflow.
  if (!(larger > 0x1p-900 && larger < infinity)) return std::partial_ordering::equivalent;
  const double difference = (a.high - b.high) + (a.low - b.low);
  if (std::abs(difference) > 0x1p-96 * larger) return difference <=> 0;
  return std::partial_ordering::equivalent;
}

/// A power of two that brings the difference near 1, or as near as the range of doubles lets it.
double scale_for(double difference) noexcept {
  constexpr int most = 1000;
  if (!(difference > 0)) return 1;
  const int exponent = std::isinf(difference) ? most : std::ilogb(difference);
  return std::ldexp(1.0, std::clamp(-exponent, -most, most));
}

/// By kernel distances of a copy scaled by a power of two.
std::optional<Contact> nearest_at_any_scale(std::span<const PreparedTriangle> triangles, const Aabb& bounds,
                                            const Vec3& center, double reach,
                                            std::span<const TriangleId> ids) noexcept {
  const double scale = scale_for(largest_difference(bounds, center));
  const Vec3 point = scale * center;
  const auto distance_to = [&](const PreparedTriangle& t) {
    const std::array<Vec3, 3> corner = {scale * t.corner[0], scale * t.corner[1], scale * t.corner[2]};
    return std::sqrt(squared_distance({corner, t.normal, t.index}, point));
  };
  double least = infinity;
  for (const PreparedTriangle& triangle : triangles) least = std::min(least, distance_to(triangle));
  const Aabb scaled = {scale * bounds.min, scale * bounds.max};
  const double limit = least + distance_error(scaled, point);
  NearestOfTies ties(center);
  for (const PreparedTriangle& triangle : triangles)
    if (distance_to(triangle) <= limit) ties.consider(triangle);
  return ties.contact(reach, ids);
}

}  // namespace

void NearestOfTies::consider(const PreparedTriangle& triangle) noexcept {
  if (&triangle == nearest_) return;
  const ExactFoot foot = foot_exactly(triangle.corner, center_);
  if (nearest_ != nullptr) {
    std::partial_ordering order = surely(foot.distance, foot_.distance);
    if (order == 0) order = compare_exactly(triangle.corner, nearest_->corner, center_);
    if (order > 0 || (order == 0 && triangle.index > nearest_->index)) return;
  }
  nearest_ = &triangle;
  foot_ = foot;
}

std::optional<Contact> NearestOfTies::contact(double reach, std::span<const TriangleId> ids) const noexcept {
  if (nearest_ == nullptr) return std::nullopt;
  if (reach < infinity) {
    const std::partial_ordering order = surely(foot_.distance, {reach, 0});
    if (order > 0 || (order == 0 && !within_exactly(nearest_->corner, center_, reach))) return std::nullopt;
  }
  const bool coincident = foot_.direction.isZero(0);
  return Contact{center_ - foot_.offset, coincident ? face_normal(*nearest_) : foot_.direction,
                 std::min(foot_.distance.rounded(), reach),
                 ids.empty() ? nearest_->index : ids[nearest_->index]};
}

std::optional<Contact> nearest_of_all(std::span<const PreparedTriangle> triangles, const Aabb& bounds,
                                      const Vec3& center, double reach, std::span<const TriangleId> ids,
                                      std::uint64_t& exact_decisions) noexcept {
  if (!center.allFinite() || !(reach >= 0)) return std::nullopt;
  const double error = distance_error(bounds, center);
  if (std::isinf(error)) {
    ++exact_decisions;
    return nearest_at_any_scale(triangles, bounds, center, reach, ids);
  }
  Candidate best;
  const PreparedTriangle* nearest = nullptr;
  for (const PreparedTriangle& triangle : triangles) {
    const Candidate candidate{squared_distance(triangle, center), triangle.index};
    if (!(candidate < best)) continue;
    best = candidate;
    nearest = &triangle;
  }
  const double distance = std::sqrt(best.squared_distance);
  if (!is_certain(distance, reach, error) && !is_certain_on(*nearest, distance, center, reach, error)) {
    return nearest_of_ties(
        center, distance, reach, error, ids, exact_decisions,
        [&](double, const auto& visit) { std::for_each(triangles.begin(), triangles.end(), visit); });
  }
  if (distance > reach) return std::nullopt;
  return contact_on(*nearest, center, ids.empty() ? best.index : ids[best.index]);
}

}  // namespace touchmark
