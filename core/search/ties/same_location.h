/// Which corner, edge or face of a triangle is nearest to a point, where doubles are certain of it, and how
/// far that is in 106 bits.
///
/// Two triangles whose nearest points are on the same corner, edge or face are exactly as far. Where many
/// share it that costs a comparison of coordinates each, and no arithmetic on distances.
#pragma once

#include <array>
#include <compare>
#include <limits>
#include <optional>

#include "core/exact/double_double.h"
#include "core/exact/feature.h"
#include "core/geometry/point_triangle.h"
#include "core/probe.h"

namespace touchmark {

/// The nearest point of the triangle surely is on this feature, its ends and borders included. Nothing beside
/// the borders between two features, and for triangles without area unless a corner is nearest. The largest
/// coordinate difference between the point and the corners must be in features_fit.
std::optional<Feature> sure_feature(const PreparedTriangle& triangle, const Vec3& point) noexcept;

/// Do the sixth powers of such a difference fit double-doubles, with room for what is below them?
inline bool features_fit(double largest_difference) noexcept {
  return largest_difference >= 0x1p-100 && largest_difference <= 0x1p150;
}

/// Is it the same corner, edge or face, or on the same line or plane across coordinate axes? The nearest
/// points that are on both then are the same point.
bool is_same_location(const Feature& a, const Feature& b) noexcept;

/// The square of a distance, and what it may be off by: infinity where that is not known.
struct SquaredDistance {
  DoubleDouble value;
  double error = 0;
};

/// Returns the squared distance of the point from the corner itself, the line or the plane of the feature:
/// takes a few times as long as the kernel. The error is 0 where nothing was rounded: off corners of few
/// digits, and over faces across a coordinate axis.
SquaredDistance squared_distance(const Feature& feature, const Vec3& point) noexcept;
/// The square of a radius, at least 0.
SquaredDistance squared(double radius) noexcept;

/// Unordered where their errors do not tell.
std::partial_ordering compare(const SquaredDistance& a, const SquaredDistance& b) noexcept;

/// What many triangles may share: a corner or an edge, and how the point lies about it.
class SharedFeature {
 public:
  /// Takes a feature that is surely nearest to the point.
  SharedFeature(const Feature& feature, const Vec3& point) noexcept;

  /// Has the triangle the same corner or edge, and is that surely nearest, or the same corners where it is a
  /// face? Then it is exactly as far. False says nothing.
  bool is_nearest_of(const PreparedTriangle& triangle) const noexcept;

 private:
  bool is_surely_behind(const Vec3& corner) const noexcept;

  Feature feature_;
  Vec3 offset_ = Vec3::Zero();  ///< from the nearest point to the point, rounded
  /// What products with the offset may be off by, of the lengths: two units for it, one for a difference,
  /// three for products and sums, and what more the offset is off by.
  double relative_error_ = 8 * std::numeric_limits<double>::epsilon();
  bool is_known_ = true;   ///< that offset is
  bool is_exact_ = false;  ///< to the last bit
};

}  // namespace touchmark
