/// The images of stored triangles as whole numbers: the grid on which all the doubles of one question lie.
///
/// For the .cpp files of exact predicates only.
#pragma once

#include <algorithm>
#include <climits>
#include <cstddef>

#include "core/exact/big_integer.h"
#include "core/exact/exact_closest_point.h"
#include "core/exact/integer_lattice.h"
#include "core/scene/posed_predicates.h"

namespace touchmark {

/// Coordinates of images: polynomials of degree 2.
inline constexpr int image_degree = 2;
using Coordinate = exact::BigInteger<image_degree>;

/// The coarsest power of two of which all plain numbers put in and all products of a rotation's entry and a
/// corner's coordinate are multiples.
class ImageLattice {
 public:
  void add(double x) noexcept {
    if (x != 0) exponent_ = std::min(exponent_, exact::Parts(x).exponent);
  }
  void add(const Vec3& v) noexcept {
    for (const double x : {v.x(), v.y(), v.z()}) add(x);
  }
  void add(const PosedTriangle& triangle) noexcept {
    add(triangle.pose->translation);
    add(triangle.radius);
    int entries = 0, coordinates = 0;  // at most 0, so that their sum is no more than either
    for (const double entry : triangle.pose->rotation.reshaped()) include(entry, entries);
    for (const Vec3& corner : triangle.corner)
      for (const double x : {corner.x(), corner.y(), corner.z()}) include(x, coordinates);
    exponent_ = std::min(exponent_, entries + coordinates);
  }

  int exponent() const noexcept { return exponent_ == INT_MAX ? 0 : exponent_; }
  Coordinate operator()(double x) const noexcept { return of(x, 1, 0); }
  exact::Vector<image_degree> operator()(const Vec3& v) const noexcept {
    return {(*this)(v.x()), (*this)(v.y()), (*this)(v.z())};
  }
  /// Returns the images of the corners as seen from the origin given.
  exact::Corners<image_degree> operator()(const PosedTriangle& triangle,
                                          const exact::Vector<image_degree>& origin) const noexcept {
    exact::Corners<image_degree> images;
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
    if (x != 0) exponent = std::min(exponent, exact::Parts(x).exponent);
  }
  /// Returns x times the factor times 2^shift.
  Coordinate of(double x, exact::Limb factor, int shift) const noexcept {
    if (x == 0) return {};
    const exact::Parts parts(x);
    return Coordinate::of(parts.mantissa, static_cast<unsigned>(parts.exponent + shift - exponent()), x < 0)
        .times(factor);
  }
  Coordinate product(double entry, double x) const noexcept {
    if (entry == 0) return {};
    const exact::Parts parts(entry);
    const Coordinate magnitude = of(x, parts.mantissa, parts.exponent);
    return entry < 0 ? -magnitude : magnitude;
  }

  int exponent_ = INT_MAX;
};

}  // namespace touchmark
