/// How far a moving ball and a triangle are apart along the way: a convex function, in double with a bound of
/// what it is off by.
///
/// Only differences of coordinates enter, from the way's start to the corners, so a far offset costs nothing
/// and no position on the way is ever rounded to the coordinates' own spacing. With u = 2^-53 and S the
/// largest coordinate difference from the start to the corners plus the way's largest coordinate (no point of
/// the way is farther than S from a corner in any coordinate, and |edge| <= 2 sqrt(3) S):
/// - The vector from a corner to a point of the way is off by 3 u S a coordinate, 5.2 u S in all: one
/// rounding
///   of the difference, two of the way's part, one of the sum.
/// - Beside an edge the foot is that of a point of the edge but for 5.2 u S and the roundings of the edge,
/// its
///   part and their difference, 8.7 u S; the norm adds 4.4 u S: the distance falls short by 19 u S at most.
///   The foot slides along the edge by 33 u S (the dot product 12.1, the quotient 21): too long by 51.3 u S.
/// - The three tests of the face are off by 26 u S |edge| (the corner's vector 5.2; twelve roundings of the
///   normal, the product and the sum, of 1.73 u S each). What passes them by 32 u S |edge| is over the face,
///   and its height is off by 19.1 u S. What is over the face and does not pass is within 58 u S of an edge.
/// So the gap is 20 u S too small at most and 111.1 u S too large, the radius' subtraction included; surely
/// over the face it is off by 20.9 u S. What is made of gaps and fractions adds less than 7 u S each time.
/// `error` has room for that: 32 u S over the face, 128 u S (most_error) elsewhere.
///
/// The slope is the way times the direction from the foot: over the face the normal's, to a few roundings;
/// else off by direction_error. Squares stay in range: where fourth powers of S do not, all is measured in
/// another unit, a power of two.
#pragma once

#include <array>

#include "core/geometry/point_triangle.h"
#include "core/probe.h"

namespace touchmark {

class WayGap {
 public:
  /// Finite coordinates, a radius of at least 0.
  WayGap(const PreparedTriangle& triangle, const Sweep& sweep) noexcept;

  /// What is known at a fraction of the path. Lengths are in `unit`.
  struct Sample {
    double gap;  ///< within `error`
    double error;
    double slope;        ///< d gap / d fraction
    double slope_error;  ///< infinite where nothing is known of it
    Vec3 offset;         ///< from the foot to the ball's centre
    bool over_face;      ///< certainly
    double height;       ///< above the face, below it negative; over it only

    bool surely_falls() const noexcept { return slope + slope_error < 0; }
    bool surely_rises() const noexcept { return slope - slope_error >= 0; }
  };
  Sample at(double fraction) const noexcept;

  /// How steeply the gap falls at most, from there on: it is convex, and no steeper than the path is long.
  double steepest_fall(const Sample& there) const noexcept {
    const double fall = there.slope_error - there.slope;
    return fall < length_ ? fall : length_;
  }
  /// Is it known that ball and triangle touch at or before `fraction` + `more`, seen from what was found at
  /// `fraction`? May say no where they do.
  bool surely_touches(double fraction, const Sample& there, double more) const noexcept;

  double max_error() const noexcept { return error_; }
  /// A bound on all lengths: finite, and their fourth powers are in range.
  bool is_defined() const noexcept { return defined_; }
  double unit() const noexcept { return unit_; }
  /// The contact there, in the mesh's unit; the position itself is not rounded.
  Contact contact(double fraction, TriangleId id) const noexcept;

 private:
  /// Differences of these, times the unit.
  void measure(const PreparedTriangle& triangle, const Sweep& sweep) noexcept;
  [[gnu::noinline, gnu::cold]] void measure_in_unit(const PreparedTriangle& triangle,
                                                    const Sweep& sweep) noexcept;
  void finish() noexcept;

  const PreparedTriangle& triangle_;
  std::array<Vec3, 3> start_;  ///< from each corner to the path's start
  std::array<Vec3, 3> edge_;   ///< from each corner to the next
  std::array<Vec3, 3> side_;   ///< normal to the face and the edge, inward, as long as the edge
  std::array<double, 3> squared_edge_;
  Vec3 path_;
  double radius_;
  double size_;  ///< S
  double length_;
  double error_;       ///< off the face
  double face_error_;  ///< over it
  double unit_ = 1;
  bool defined_ = true;
};

}  // namespace touchmark
