#include "bench/oracle/exact/interval_distance.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

#include <Eigen/Geometry>

#include "bench/oracle/float_limits.h"

namespace touchmark::bench::oracle {
namespace {

// How the bounds come about. Let W be the corners relative to the point (for a segment: relative to either
// end), M the largest length among them, u = 2^-53. The distance is the least length in the convex hull of W.
//
// Stored: each w is one rounded difference a component, so off by at most u |w| <= 1.01 u M, and so is the
// hull.
//
// Above: the length of any x = sum l_i w_i with l_i >= 0 and sum l_i = 1. However wrong the weights are,
// only the evaluation of x counts: normalising the weights 4 u M, the products u M, the sums 5 u M at most
// (six points), the length 3 u M, the stored differences 1.01 u M. For the form w + t (v - w), 0 <= t <= 1:
// difference 2, product 2, sum 1, and twice that for nested ones (segment against edge). All below 16 u M.
//
// Below: for any vector g, min g.w_i / |g|, since a linear function is least at a corner. g need not be
// anything in particular. Each g.w_i is off by 3.01 u |g| M, |g| by 2.51 u |g|, the quotient (at most M) by
// u M, which with the stored differences makes 7.6 u M, the final subtraction 8.6.
//
// Underflow: M is scaled to within 2^-100 .. 2^100, where squares of what matters (u M) are normal; a g so
// short that its square is not is not used.
constexpr double roundings_above = 20 * unit_roundoff;
constexpr double roundings_below = 12 * unit_roundoff;
constexpr double shortest_squared = 0x1p-900;

using Corners = std::array<Vec3, 3>;

/// The shortest vector found so far in the hull of W, and directions worth trying from below.
struct Shortest {
  Vec3 vector = Vec3::Zero();
  double squared = std::numeric_limits<double>::infinity();

  void offer(const Vec3& x) noexcept {
    const double length = x.squaredNorm();
    if (length < squared) {
      squared = length;
      vector = x;
    }
  }
};

Vec3 on_segment(const Vec3& w, const Vec3& v) noexcept {
  const Vec3 edge = v - w;
  const double length = edge.squaredNorm();
  const double along = -w.dot(edge);
  if (!(along > 0)) return w;
  if (!(along < length)) return v;
  return w + (along / length) * edge;
}

/// The foot of the perpendicular if its weights are not negative.
std::optional<Vec3> on_face(const Corners& w, const Vec3& normal) noexcept {
  const double l2 = w[0].cross(w[1]).dot(normal), l0 = w[1].cross(w[2]).dot(normal),
               l1 = w[2].cross(w[0]).dot(normal);
  const double sum = l0 + l1 + l2;
  if (!(l0 >= 0 && l1 >= 0 && l2 >= 0 && sum > 0)) return std::nullopt;
  return Vec3((l0 / sum) * w[0] + (l1 / sum) * w[1] + (l2 / sum) * w[2]);
}

void offer_triangle(const Corners& w, const Vec3& normal, Shortest& shortest) noexcept {
  for (std::size_t i = 0; i < 3; ++i) shortest.offer(on_segment(w[i], w[(i + 1) % 3]));
  if (const std::optional<Vec3> foot = on_face(w, normal)) shortest.offer(*foot);
}

/// The insides of the path (w0 to w1, v0 to v1: the same edge seen from both ends) and of an edge.
void offer_edge(const Vec3& w0, const Vec3& v0, const Vec3& w1, const Vec3& v1, Shortest& shortest) noexcept {
  const Vec3 edge = v0 - w0, path = w0 - w1;
  const double a = path.squaredNorm(), b = path.dot(edge), e = edge.squaredNorm();
  const double determinant = a * e - b * b;
  if (!(determinant > 0)) return;
  const double d = path.dot(w0), f = edge.dot(w0);
  const double s = std::clamp((d * e - b * f) / determinant, 0.0, 1.0);
  const Vec3 w = w0 + s * (w1 - w0), v = v0 + s * (v1 - v0);
  shortest.offer(on_segment(w, v));
}

void offer_crossing(const Corners& from, const Corners& to, const Vec3& normal, Shortest& shortest) noexcept {
  const double start = from[0].dot(normal), end = to[0].dot(normal);
  if (!(start * end < 0)) return;
  const double s = start / (start - end);
  Corners w;
  for (std::size_t i = 0; i < 3; ++i) w[i] = from[i] + s * (to[i] - from[i]);
  if (const std::optional<Vec3> foot = on_face(w, normal)) shortest.offer(*foot);
}

double below(const Vec3& g, std::span<const Vec3> hull, double largest) noexcept {
  const double squared = g.squaredNorm();
  if (!(squared > shortest_squared)) return 0;
  double least = std::numeric_limits<double>::infinity();
  for (const Vec3& w : hull) least = std::min(least, g.dot(w));
  return std::max(0.0, least / std::sqrt(squared) - roundings_below * largest);
}

/// The bounds of the hull's least length; `normal` may be zero.
Interval bounds(const Shortest& shortest, const Vec3& normal, std::span<const Vec3> hull) noexcept {
  double largest = 0;
  for (const Vec3& w : hull) largest = std::max(largest, w.squaredNorm());
  largest = std::sqrt(largest);
  double lo = below(shortest.vector, hull, largest);
  if (normal.dot(hull[0]) > 0) lo = std::max(lo, below(normal, hull, largest));
  if (normal.dot(hull[0]) < 0) lo = std::max(lo, below(-normal, hull, largest));
  const double hi = std::sqrt(shortest.squared) + roundings_above * largest;
  return {std::min(lo, hi), hi};
}

/// Brings W to a magnitude at which nothing over- or underflows. False if it is zero or overflowed already.
bool scale(std::span<Vec3> hull, int& exponent) noexcept {
  double largest = 0;
  bool finite = true;
  for (const Vec3& w : hull) {
    largest = std::max(largest, w.cwiseAbs().maxCoeff());
    finite = finite && w.allFinite();
  }
  if (!finite || largest == 0) return false;
  exponent = 0;
  if (largest > 0x1p-99 && largest < 0x1p99) return true;
  exponent = std::ilogb(largest);
  for (Vec3& w : hull)
    for (double& x : w) x = std::ldexp(x, -exponent);
  return true;
}

Interval scaled_back(Interval bounds, int exponent) noexcept {
  if (exponent == 0) return bounds;
  return {std::max(0.0, std::nextafter(std::ldexp(bounds.lo, exponent), -infinity)),
          std::nextafter(std::ldexp(bounds.hi, exponent), infinity)};
}

/// What is known when W cannot be computed with: a rounded difference is zero only if it is zero.
Interval without_arithmetic(std::span<const Vec3> hull) noexcept {
  for (const Vec3& w : hull)
    if (!w.isZero(0)) return {0, std::numeric_limits<double>::infinity()};
  return {0, 0};
}

}  // namespace

Interval distance_interval(const Vec3& point, const Triangle& triangle) noexcept {
  Corners w = {triangle[0] - point, triangle[1] - point, triangle[2] - point};
  int exponent = 0;
  if (!scale(w, exponent)) return without_arithmetic(w);
  const Vec3 normal = (w[1] - w[0]).cross(w[2] - w[0]);
  Shortest shortest;
  offer_triangle(w, normal, shortest);
  return scaled_back(bounds(shortest, normal, w), exponent);
}

Interval segment_distance_interval(const Vec3& from, const Vec3& to, const Triangle& triangle) noexcept {
  std::array<Vec3, 6> hull = {triangle[0] - from, triangle[1] - from, triangle[2] - from,
                              triangle[0] - to,   triangle[1] - to,   triangle[2] - to};
  int exponent = 0;
  if (!scale(hull, exponent)) return without_arithmetic(hull);
  const Corners w0 = {hull[0], hull[1], hull[2]}, w1 = {hull[3], hull[4], hull[5]};
  const Vec3 normal = (w0[1] - w0[0]).cross(w0[2] - w0[0]);
  Shortest shortest;
  offer_triangle(w0, normal, shortest);
  offer_triangle(w1, normal, shortest);
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    shortest.offer(on_segment(w0[i], w1[i]));
    offer_edge(w0[i], w0[j], w1[i], w1[j], shortest);
  }
  offer_crossing(w0, w1, normal, shortest);
  return scaled_back(bounds(shortest, normal, hull), exponent);
}

}  // namespace touchmark::bench::oracle
