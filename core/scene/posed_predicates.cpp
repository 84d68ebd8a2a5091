#include "core/scene/posed_predicates.h"

#include <algorithm>
#include <climits>
#include <cmath>
#include <cstddef>

#include "core/exact/big_integer.h"
#include "core/exact/exact_closest_point.h"
#include "core/exact/integer_lattice.h"

namespace touchmark {
namespace {

using exact::BigInteger;
using exact::Corners;
using exact::Parts;
using exact::Vector;

/// Coordinates of images: polynomials of degree 2.
constexpr int image_degree = 2;
using Coordinate = BigInteger<image_degree>;

/// The coarsest power of two of which all plain numbers put in and all products of a rotation's entry and a
/// corner's coordinate are multiples.
class ImageLattice {
 public:
  void add(double x) noexcept {
    if (x != 0) exponent_ = std::min(exponent_, Parts(x).exponent);
  }
  void add(const Vec3& v) noexcept {
    for (const double x : {v.x(), v.y(), v.z()}) add(x);
  }
  void add(const PosedTriangle& triangle) noexcept {
    add(triangle.pose->translation);
    int entries = 0, coordinates = 0;  // at most 0, so that their sum is no more than either
    for (const double entry : triangle.pose->rotation.reshaped()) include(entry, entries);
    for (const Vec3& corner : triangle.corner)
      for (const double x : {corner.x(), corner.y(), corner.z()}) include(x, coordinates);
    exponent_ = std::min(exponent_, entries + coordinates);
  }

  int exponent() const noexcept { return exponent_ == INT_MAX ? 0 : exponent_; }
  Coordinate operator()(double x) const noexcept { return of(x, 1, 0); }
  Vector<image_degree> operator()(const Vec3& v) const noexcept {
    return {(*this)(v.x()), (*this)(v.y()), (*this)(v.z())};
  }
  /// Returns the images of the corners as seen from the origin given.
  Corners<image_degree> operator()(const PosedTriangle& triangle,
                                   const Vector<image_degree>& origin) const noexcept {
    Corners<image_degree> images;
    for (std::size_t i = 0; i < 3; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const auto row = static_cast<Eigen::Index>(k);
        Coordinate sum = (*this)(triangle.pose->translation[row]) - origin[k];
        for (Eigen::Index j = 0; j < 3; ++j)
          sum = sum + product(triangle.pose->rotation(row, j), triangle.corner[i][j]);
        images[i][k] = sum;
      }
    }
    return images;
  }

 private:
  static void include(double x, int& exponent) noexcept {
    if (x != 0) exponent = std::min(exponent, Parts(x).exponent);
  }
  /// Returns x times the factor times 2^shift.
  Coordinate of(double x, exact::Limb factor, int shift) const noexcept {
    if (x == 0) return {};
    const Parts parts(x);
    return Coordinate::of(parts.mantissa, static_cast<unsigned>(parts.exponent + shift - exponent()), x < 0)
        .times(factor);
  }
  Coordinate product(double entry, double x) const noexcept {
    if (entry == 0) return {};
    const Parts parts(entry);
    const Coordinate magnitude = of(x, parts.mantissa, parts.exponent);
    return entry < 0 ? -magnitude : magnitude;
  }

  int exponent_ = INT_MAX;
};

bool all_finite(const PosedTriangle& triangle, const Vec3& point) noexcept {
  return point.allFinite() && triangle.corner[0].allFinite() && triangle.corner[1].allFinite() &&
         triangle.corner[2].allFinite();
}

exact::ExactClosestPoint<image_degree> closest_of(const ImageLattice& lattice, const PosedTriangle& triangle,
                                                  const Vec3& point) noexcept {
  return exact::exact_closest_point<image_degree>(lattice(triangle, lattice(point)));
}

}  // namespace

bool within_exactly(const PosedTriangle& triangle, const Vec3& point, double radius) noexcept {
  if (!(radius >= 0) || !all_finite(triangle, point)) return false;
  if (std::isinf(radius)) return true;
  ImageLattice lattice;
  lattice.add(triangle);
  lattice.add(point);
  lattice.add(radius);
  const exact::ExactClosestPoint<image_degree> closest = closest_of(lattice, triangle, point);
  const Coordinate r = lattice(radius);
  return closest.numerator <= r * r * closest.denominator;
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
  const Coordinate r = lattice(radius).times(fine);
  path.squared_radius = r * r;
  return comes_within(path);
}

std::strong_ordering compare_exactly(const PosedTriangle& a, const PosedTriangle& b,
                                     const Vec3& point) noexcept {
  ImageLattice lattice;
  lattice.add(a);
  lattice.add(b);
  lattice.add(point);
  return compare(closest_of(lattice, a, point), closest_of(lattice, b, point));
}

ClosestPoint closest_point_exactly(const PosedTriangle& triangle, const Vec3& point) noexcept {
  ImageLattice lattice;
  lattice.add(triangle);
  lattice.add(point);
  return exact::rounded(closest_of(lattice, triangle, point), lattice.exponent());
}

}  // namespace touchmark
