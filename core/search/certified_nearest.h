/// How a search that compares distances in double still decides exactly, at the price of two comparisons.
///
/// distance_error bounds what any computed distance of a query may be off by, either way: 256 u M, M the
/// largest coordinate difference between the centre and the mesh's box; five times what the kernel's analysis
/// gives. It is a function of mesh and centre alone, so that all detectors draw the same line. Then:
///
/// - Whoever looks for triangles within `reach` looks within reach + error. A triangle whose true distance is
///   at most the reach has a computed one of at most that, so no exact answer is lost to culling.
/// - `touches` decides triangle by triangle: where the computed distance is farther than the error from the
///   radius it decides, else whole numbers do. Some triangle touches exactly if one of those says so.
/// - `nearest` keeps the triangle of the least computed distance, d. Every true distance is at least
///   d - error / 2 and this one's at most d + error / 2; so where d and the reach are farther apart than the
///   error, d decides whether any triangle is within reach. Where they are not, or where d is within the
///   error of zero but not negligible, a true nearest one is among those whose computed distance is at most
///   d + error. Of these the exactly nearest is found, the first of the mesh where several are, and it alone
///   is compared with the reach.
///
/// Which triangle is named is exact, too. With D the true distances, a nearest one j has D_j <= D_best, and
/// the kernel's is at most 48 u M above the true distance and 14 u M below (point_triangle.h, m <= sqrt(3)
/// M):
///   d_j <= D_j + 48 u M <= D_best + 48 u M <= d + 62 u M < d + error.
/// So every search looks at all triangles of computed distances up to d + error, and remembers those that it
/// was shown (nearest_so_far.h): where there is none besides the best, that is the one to name. It is, too,
/// where all of them have its very d and share the corner or edge, surely nearest to the centre, that it is
/// the distance of: they are exactly as far, and of equal candidates the first is kept (shared_feature.h).
/// Else the exactly nearest of them is found as above. The contact then is the kernel's on the triangle to be
/// named where that is certain, so that it does not matter how many a search has remembered in vain.
///
/// What is to be shown is within the padding of every search: boxes are asked for d + error; single precision
/// (plane_filter.h, spheres and boxes alike) leaves room for 2^-23 of M and more; scans look at all within
/// the reach and the error; and a group leaves out what loses by 8192 u in its frame, whose M is below 4.
///
/// So the reported distance is within 16 u M, M now of the nearest triangle: there is a step from the edge to
/// the face and a slide along an edge, each across the offset, in the kernel's error of 48 u M. Where the
/// distance d is above 200 u M these matter by half their square over d only, less than 5 u M. What is left
/// is
/// - over the face: the difference to the nearer corner, the normal's components (rounded, then divided by
///   their norm) and their products come to |w_k n_k| (5 - 2 n_k^2) u each, the first sum to |x + y| u, the
///   norm and the second sum to 3.5 |h| u; at w_k = M this is greatest along the diagonal: 14.8 u M. (The
///   square root of a square is exact.)
/// - beside an edge: (1 + 2 cos + 3.5 sin) u |w| <= 5.1 sqrt(3) u M, and those 5;
/// - off a corner: 3.5 sqrt(3) u M.
/// The worst found by climbing, over 5 million triangles and centres, is 8.0 u M (certified_bound_test).
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
#include "core/search/closest_candidates.h"
#include "core/search/nearest_of_ties.h"

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
