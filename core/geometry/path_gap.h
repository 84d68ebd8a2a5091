/// How far a moving ball and a triangle are apart along the way: a convex function, in double with a bound of
/// what it is off by.
///
/// Only differences of coordinates enter, so a far offset costs nothing. With S the largest coordinate
/// difference from the start to the corners plus the way's largest coordinate, the gap is within 32 u S
/// surely over the face and within 128 u S elsewhere: docs/exactness.md, E17.
#pragma once

#include <array>
#include <optional>

#include "core/geometry/point_triangle.h"
#include "core/probe.h"

namespace touchmark {

class PathGap {
 public:
  /// Finite coordinates, a radius of at least 0. Triangle and sweep must outlive this.
  PathGap(const PreparedTriangle& triangle, const Sweep& sweep) noexcept;

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
  /// True if the ball has surely come to the foot found there, a point of the triangle, `more` later.
  bool reaches_foot(const Sample& there, double more) const noexcept;
  /// Is it known that ball and triangle touch at or before `fraction` + `more`, seen from what was found at
  /// `fraction`? May say no where they do.
  bool surely_touches(double fraction, const Sample& there, double more) const noexcept;

  /// Is a plane known that keeps ball and triangle apart from `fraction` to `end`: the one normal to the
  /// offset found at `fraction`? May say no where there is one. The directions of offsets are off by so much
  /// that a slope alone does not tell this of a ball that slides along an edge.
  bool stays_apart(double fraction, const Sample& there, double end) const noexcept;

  /// Returns true if the ball touches at the fraction, false if it does not, by a distance in double-double.
  /// Nothing where that leaves it open: docs/exactness.md, E16.
  std::optional<bool> touches_at(double fraction) const noexcept;
  /// Returns the same of all fractions up to this one: false if the triangle's plane keeps ball and triangle
  /// apart.
  std::optional<bool> touches_until(double fraction) const noexcept;

  /// Returns a fraction that is not later than a ball's first touch, and earlier by less than 2^-50. Nothing
  /// where double-doubles do not tell it. The path touches, and not before `fraction`: docs/exactness.md,
  /// E16.
  std::optional<double> precise_touch(double fraction) const noexcept;
  /// Likewise of a bare point that meets the triangle, not at its start. `in_plane` says that all of its path
  /// is exactly in the triangle's plane.
  std::optional<double> precise_meeting(bool in_plane) const noexcept;

  /// Returns where the ball touches the plane, the lines and the points of the triangle's features after
  /// `fraction`, rounded: one of them is likely where it touches the triangle. Infinite where there is none.
  std::array<double, 7> possible_touches(double fraction) const noexcept;

  double max_error() const noexcept { return error_; }
  /// Bounds the gap where a fraction is early by 2^-50.
  double max_early() const noexcept { return 0x1p-49 * length_; }
  /// A bound on all lengths: finite, and their fourth powers are in range.
  bool is_defined() const noexcept { return defined_; }
  double unit() const noexcept { return unit_; }
  /// The contact there, in the mesh's unit; the position itself is not rounded.
  Contact contact(double fraction, TriangleId id) const noexcept;

 private:
  using Corners = std::array<Vec3, 3>;
  /// What is nearest: the face, the edge from corner `first`, or that corner.
  struct Nearest {
    int corners;
    std::size_t first;
  };
  /// value - 2 fall x + curve x^2, x fractions further on: zero where the ball touches a feature's plane,
  /// line or point.
  struct Approach {
    double value, value_error, fall, fall_error, curve;
  };
  /// Differences of these, times the unit.
  void measure(const PreparedTriangle& triangle, const Sweep& sweep) noexcept;
  [[gnu::noinline, gnu::cold]] void measure_in_unit(const PreparedTriangle& triangle,
                                                    const Sweep& sweep) noexcept;
  void finish() noexcept;
  /// Asks a gap of the triangle and the sweep in `unit`: their coordinates are read where differences do not
  /// do.
  template <class Result, class Argument>
  Result in_unit(Result (PathGap::*ask)(Argument) const noexcept, Argument argument) const noexcept;
  Corners corners_to(double fraction) const noexcept;
  bool is_over_face(const Corners& to) const noexcept;
  bool is_nearest(Nearest feature, const Corners& to) const noexcept;
  std::optional<Nearest> nearest_feature(const Corners& to) const noexcept;
  Approach approach_to(Nearest feature, double fraction) const noexcept;
  Approach careful_approach_to(Nearest feature, double fraction) const noexcept;

  const PreparedTriangle& triangle_;
  const Sweep& sweep_;
  Corners start_;             ///< from each corner to the path's start
  std::array<Vec3, 3> edge_;  ///< from each corner to the next
  std::array<Vec3, 3> side_;  ///< normal to the face and the edge, inward, as long as the edge
  std::array<double, 3> squared_edge_;
  Vec3 path_;
  double radius_;
  double size_;  ///< S
  double length_;
  double error_;        ///< off the face
  double face_error_;   ///< over it
  double apart_error_;  ///< bounds the error of a height above a plane
  double unit_ = 1;
  bool defined_ = true;
};

}  // namespace touchmark
