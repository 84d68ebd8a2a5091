#include "core/scene/posed_predicates.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "core/exact/big_integer.h"
#include "core/exact/double_double.h"
#include "core/exact/double_double_vector.h"
#include "core/exact/exact_closest_point.h"
#include "core/scene/image_lattice.h"

namespace touchmark {
namespace {

using exact::Corners;
using exact::Vector;

bool all_finite(const PosedTriangle& triangle, const Vec3& point) noexcept {
  return point.allFinite() && triangle.corner[0].allFinite() && triangle.corner[1].allFinite() &&
         triangle.corner[2].allFinite();
}

using Closest = exact::ExactClosestPoint<image_degree>;

Closest closest_of(const ImageLattice& lattice, const PosedTriangle& triangle, const Vec3& point) noexcept {
  return exact::exact_closest_point<image_degree>(lattice(triangle, lattice(point)));
}

/// How the distance compares with this one, which is at least 0.
std::strong_ordering compare(const Closest& closest, const Coordinate& distance) noexcept {
  return closest.numerator <=> distance * distance * closest.denominator;
}

/// Is the distance to the surface, which is so far from the image, at most r?
bool is_within(const Closest& closest, const Coordinate& radius, const Coordinate& r) noexcept {
  if (compare(closest, radius + r) > 0) return false;
  return r >= radius || compare(closest, radius - r) >= 0;
}

/// How sqrt(a) + more compares with sqrt(b). Where `more` is at least 0 that is 2 more sqrt(a) against what
/// b exceeds a + more^2 by, both times the denominators; where that is not below 0 their squares tell.
std::strong_ordering compare_roots(const Closest& a, const Coordinate& more, const Closest& b) noexcept {
  if (more.sign() < 0) return 0 <=> compare_roots(b, -more, a);
  const auto denominator = a.denominator * b.denominator;
  const auto excess = b.numerator * a.denominator - a.numerator * b.denominator - more * more * denominator;
  if (excess.sign() < 0) return std::strong_ordering::greater;
  const auto squared = (more * more) * (a.numerator * a.denominator) * (b.denominator * b.denominator);
  return squared.times(4) <=> excess * excess;
}

/// How sqrt(a) + sqrt(b) compares with the sum, which is at least 0: as 2 sqrt(a b) with what its square
/// exceeds a + b by.
std::strong_ordering compare_sum_of_roots(const Closest& a, const Closest& b,
                                          const Coordinate& sum) noexcept {
  const auto denominator = a.denominator * b.denominator;
  const auto excess = sum * sum * denominator - a.numerator * b.denominator - b.numerator * a.denominator;
  if (excess.sign() < 0) return std::strong_ordering::greater;
  return ((a.numerator * b.numerator) * denominator).times(4) <=> excess * excess;
}

/// How the distances to two surfaces compare, each so far from its image.
std::strong_ordering compare_surfaces(const Closest& a, const Coordinate& radius_a, const Closest& b,
                                      const Coordinate& radius_b) noexcept {
  const bool outside_a = compare(a, radius_a) >= 0, outside_b = compare(b, radius_b) >= 0;
  if (outside_a != outside_b) {
    const std::strong_ordering order = compare_sum_of_roots(a, b, radius_a + radius_b);
    return outside_a ? order : 0 <=> order;
  }
  const std::strong_ordering order = compare_roots(a, radius_b - radius_a, b);
  return outside_a ? order : 0 <=> order;
}

}  // namespace

bool within_exactly(const PosedTriangle& triangle, const Vec3& point, double radius) noexcept {
  if (!(radius >= 0) || !all_finite(triangle, point)) return false;
  if (std::isinf(radius)) return true;
  ImageLattice lattice;
  lattice.add(triangle);
  lattice.add(point);
  lattice.add(radius);
  return is_within(closest_of(lattice, triangle, point), lattice(triangle.radius), lattice(radius));
}

bool path_within_exactly(const PosedTriangle& triangle, const Vec3& from, const Vec3& to, double fraction,
                         double radius) noexcept {
  if (!(radius >= 0) || !all_finite(triangle, from) || !to.allFinite()) return false;
  if (std::isinf(radius)) return true;
  ImageLattice lattice;
  lattice.add(triangle);
  lattice.add(from);
  lattice.add(to);
  lattice.add(radius);
  // On a grid so much finer that the part ends on it, too.
  const exact::Limb fine = fraction < 1 ? exact::Limb{1} << 53 : 1;
  const auto part = static_cast<exact::Limb>(fraction * static_cast<double>(fine));
  const Vector<image_degree> origin = lattice(from);
  exact::ExactPath<image_degree> path{times(lattice(to) - origin, part), lattice(triangle, origin), {}};
  for (Vector<image_degree>& corner : path.w) corner = times(corner, fine);
  const Coordinate own = lattice(triangle.radius).times(fine), r = lattice(radius).times(fine);
  path.squared_radius = (own + r) * (own + r);
  if (!comes_within(path)) return false;
  if (r >= own) return true;
  // The distance to the image is convex along the way: greatest at an end.
  const auto reaches_the_surface = [&](const Corners<image_degree>& w) {
    return compare(exact::exact_closest_point<image_degree>(w), own - r) >= 0;
  };
  return reaches_the_surface(path.w) ||
         reaches_the_surface({path.w[0] - path.path, path.w[1] - path.path, path.w[2] - path.path});
}

std::optional<bool> within_by_sides(const PosedTriangle& triangle, const Vec3& from, const Vec3& to,
                                    double radius) noexcept {
  using double_double::cross, double_double::dot;
  using SeenFromStart = double_double::Vector;
  const SeenFromStart way = double_double::difference(to, from);
  std::array<SeenFromStart, 3> corner;
  double terms = 0, largest = 0;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto row = static_cast<Eigen::Index>(k);
    const DoubleDouble shift = two_sum(triangle.pose->translation[row], -from[row]);
    const double length = std::abs(triangle.pose->translation[row]) + std::abs(from[row]);
    largest = std::max(largest, std::abs(way[k].high));
    for (std::size_t i = 0; i < 3; ++i) {
      DoubleDouble sum = shift;
      double sum_of_terms = length;
      for (Eigen::Index j = 0; j < 3; ++j) {
        const DoubleDouble product = two_product(triangle.pose->rotation(row, j), triangle.corner[i][j]);
        sum = sum + product;
        sum_of_terms += std::abs(product.high);
      }
      corner[i][k] = sum;
      terms = std::max(terms, sum_of_terms);
      largest = std::max(largest, std::abs(sum.high));
    }
  }
  const double error = 0x1p-100 * terms;
  if (!(std::max({terms, largest, radius}) < 0x1p230 && largest > std::max(0x1p-200, 0x1p10 * error)))
    return std::nullopt;
  const double bound = largest * (largest + 2 * radius) * (20 * error + 0x1p-94 * largest);
  const auto sign = [bound](const DoubleDouble& x, double times) {
    return x.high > times * bound ? 1 : x.high < -times * bound ? -1 : 0;
  };
  const SeenFromStart opposite = cross(corner[1], corner[2]);
  const DoubleDouble start = -dot(corner[0], opposite);
  const std::array<DoubleDouble, 3> edge = {dot(way, cross(corner[0], corner[1])), dot(way, opposite),
                                            dot(way, cross(corner[2], corner[0]))};
  const DoubleDouble end = edge[0] + edge[1] + edge[2] + start;
  if (radius > 0) {
    SeenFromStart one, other;
    for (std::size_t k = 0; k < 3; ++k) {
      one[k] = corner[1][k] - corner[0][k];
      other[k] = corner[2][k] - corner[0][k];
    }
    const SeenFromStart normal = cross(one, other);
    const DoubleDouble reach = square_root(dot(normal, normal)) * DoubleDouble{radius};
    const bool below = start.high < 0;
    const bool apart =
        sign((below ? -start : start) - reach, 1) > 0 && sign((below ? -end : end) - reach, 5) > 0;
    return apart ? std::optional(false) : std::nullopt;
  }
  const int before = sign(start, 1), after = sign(end, 5);
  if (before * after > 0) return false;
  const auto [least, most] = std::minmax({sign(edge[0], 1), sign(edge[1], 1), sign(edge[2], 1)});
  if (least < 0 && most > 0) return false;
  if (before * after < 0 && least * most > 0) return true;
  return std::nullopt;
}

bool lies_inside(const PosedTriangle& triangle, const Vec3& point) noexcept {
  ImageLattice lattice;
  lattice.add(triangle);
  lattice.add(point);
  return compare(closest_of(lattice, triangle, point), lattice(triangle.radius)) < 0;
}

std::strong_ordering compare_exactly(const PosedTriangle& a, const PosedTriangle& b,
                                     const Vec3& point) noexcept {
  ImageLattice lattice;
  lattice.add(a);
  lattice.add(b);
  lattice.add(point);
  const Closest of_a = closest_of(lattice, a, point), of_b = closest_of(lattice, b, point);
  if (a.radius == b.radius && a.radius == 0) return exact::compare(of_a, of_b);
  return compare_surfaces(of_a, lattice(a.radius), of_b, lattice(b.radius));
}

ClosestPoint closest_point_exactly(const PosedTriangle& triangle, const Vec3& point) noexcept {
  ImageLattice lattice;
  lattice.add(triangle);
  lattice.add(point);
  return exact::rounded(closest_of(lattice, triangle, point), lattice.exponent());
}

}  // namespace touchmark
