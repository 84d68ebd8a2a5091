#include "core/search/ties/certified_nearest.h"

#include <algorithm>
#include <cmath>

#include "core/float_limits.h"

namespace touchmark {
namespace {

/// Answers by kernel distances of a copy scaled by a power of two.
std::optional<Contact> nearest_at_any_scale(std::span<const PreparedTriangle> triangles, const Aabb& bounds,
                                            const Vec3& center, double reach, const TriangleIds& ids,
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
  const std::optional<Contact> contact = ties.contact(reach, infinity, ids);
  work.exact_decisions += ties.exact_decisions();
  return contact;
}

}  // namespace

double unit_for(double largest_difference) noexcept {
  constexpr int max_exponent = 1000;
  if (!(largest_difference > 0)) return 1;
  const int exponent = std::isinf(largest_difference) ? max_exponent : std::ilogb(largest_difference);
  return std::ldexp(1.0, std::clamp(-exponent, -max_exponent, max_exponent));
}

std::optional<Contact> nearest_of_ties(const ClosestCandidates& candidates, const Vec3& center, double reach,
                                       double error, const TriangleIds& ids,
                                       std::uint64_t& exact_decisions) noexcept {
  NearestOfTies ties(center);
  candidates.pass_to(ties);
  const std::optional<Contact> contact = ties.contact(reach, error, ids);
  exact_decisions += candidates.exact_decisions() + ties.exact_decisions();
  return contact;
}

std::optional<Contact> nearest_of_all(std::span<const PreparedTriangle> triangles, const Aabb& bounds,
                                      const Vec3& center, double reach, const TriangleIds& ids,
                                      Work& work) noexcept {
  if (!center.allFinite() || !(reach >= 0)) return std::nullopt;
  const double error = distance_error(bounds, center);
  if (std::isinf(error)) return nearest_at_any_scale(triangles, bounds, center, reach, ids, work);
  work.triangles += triangles.size();
  ClosestCandidates candidates(triangles.data(), center, error);
  for (std::size_t i = 0; i < triangles.size(); ++i)
    candidates.update({squared_distance(triangles[i], center), triangles[i].index},
                      static_cast<std::uint32_t>(i));
  return contact_of(candidates, triangles, center, reach, error, ids, work);
}

}  // namespace touchmark
