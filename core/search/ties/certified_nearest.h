/// How a search that compares distances in double still decides exactly: a floating-point filter before an
/// exact predicate.
///
/// distance_error bounds any computed distance of a query. Where a distance is farther from the radius or the
/// reach than that, and its triangle surely the first of the nearest, it decides; elsewhere nearest_of_ties.h
/// does. The reported distance is within 16 u M. Proofs: docs/exactness.md, E3 (contact), E4 (which triangle
/// is named), E5 (the distance).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>

#include "core/aabb.h"
#include "core/detector.h"
#include "core/geometry/distance_error.h"
#include "core/geometry/point_triangle.h"
#include "core/probe.h"
#include "core/search/ties/closest_candidates.h"
#include "core/search/ties/nearest_of_ties.h"

namespace touchmark {

/// Does the least computed distance decide, and is it good enough to be reported? A quick look; where it says
/// no, is_certain_on may still say yes.
inline bool is_certain(double distance, double reach, double error) noexcept {
  return distance > error && std::abs(distance - reach) > error;
}

/// Does the least computed distance decide, with regard to the triangle of that distance? On it but for
/// rounding, below 8 u M, the distance is good as it is. The true one is not negative, and that of this
/// triangle not above 15 u M.
inline bool is_certain_on(const PreparedTriangle& triangle, double distance, const Vec3& center, double reach,
                          double error) noexcept {
  if (!(std::abs(distance - reach) > error)) return false;
  double largest = 0;
  for (const Vec3& corner : triangle.corner)
    largest = std::max(largest, (center - corner).cwiseAbs().maxCoeff());
  constexpr double relative_error = 8 * (std::numeric_limits<double>::epsilon() / 2);
  return distance > error || distance <= relative_error * largest;
}

/// Does the least computed distance decide, and is its triangle the one to name?
inline bool is_certain_first(const ClosestCandidates& candidates, std::span<const PreparedTriangle> triangles,
                             double distance, const Vec3& center, double reach, double error) noexcept {
  return (is_certain(distance, reach, error) ||
          is_certain_on(triangles[candidates.at()], distance, center, reach, error)) &&
         candidates.is_surely_first(error);
}

/// What `nearest` answers where is_certain says no, or the nearest as computed is not surely the first of the
/// nearest: of those that the search has taken, which was shown all whose computed distance is at most the
/// least one, or the reach, and the error.
[[gnu::noinline, gnu::cold]] std::optional<Contact> nearest_of_ties(const ClosestCandidates& candidates,
                                                                    const Vec3& center, double reach,
                                                                    double error, const TriangleIds& ids,
                                                                    std::uint64_t& exact_decisions) noexcept;

/// Ends a search for `nearest`: returns the contact of the nearest candidate, or of the exactly nearest where
/// doubles leave open which that is, or nothing beyond the reach. The search has shown `candidates` what
/// nearest_of_ties asks for. `decides_exactly` is false where contact is as doubles have it.
inline std::optional<Contact> contact_of(const ClosestCandidates& candidates,
                                         std::span<const PreparedTriangle> triangles, const Vec3& center,
                                         double reach, double error, const TriangleIds& ids, Work& work,
                                         bool decides_exactly = true) noexcept {
  if (!candidates.found()) return std::nullopt;
  const double distance = std::sqrt(candidates.best().squared_distance);
  if (decides_exactly && !is_certain_first(candidates, triangles, distance, center, reach, error))
    return nearest_of_ties(candidates, center, reach, error, ids, work.exact_decisions);
  if (distance > reach) return std::nullopt;
  const PreparedTriangle& nearest = triangles[candidates.at()];
  return contact_on(nearest, center, ids[nearest.index]);
}

/// Returns the answer of `nearest` by a look at every triangle, for any finite numbers: where distance_error
/// is infinite they are measured as scaled by a power of two. `bounds` are the triangles'; nothing for a
/// centre that is not finite. Every look at a triangle is counted: two, where they are measured so.
std::optional<Contact> nearest_of_all(std::span<const PreparedTriangle> triangles, const Aabb& bounds,
                                      const Vec3& center, double reach, const TriangleIds& ids,
                                      Work& work) noexcept;

}  // namespace touchmark
