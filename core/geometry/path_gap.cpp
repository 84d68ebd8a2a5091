#include "core/geometry/path_gap.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/float_limits.h"
#include "core/geometry/distance_error.h"

namespace touchmark {
namespace {

/// Bounds by how much the direction from the foot is off, for a distance that is off by `error`:
/// docs/exactness.md, E17.
double direction_error(double distance, double error) noexcept {
  const double relative = error / distance;
  return relative < 0.25 ? 2 * std::sqrt(relative * (1 + relative)) : infinity;
}

/// Returns the vector from the edge between two corners to the point at `to_first` from the one and
/// `to_second` from the other, measured from the nearer one.
Vec3 from_edge(const Vec3& to_first, const Vec3& to_second, double first, double second, const Vec3& edge,
               double squared_edge) noexcept {
  const bool from_first = first < second;
  const Vec3& near = from_first ? to_first : to_second;
  const double along = from_first ? near.dot(edge) : -near.dot(edge);
  if (!(along > 0)) return near;
  const double part = std::min(along / squared_edge, 1.0);
  return near - (from_first ? part : -part) * edge;
}

}  // namespace

PathGap::PathGap(const PreparedTriangle& triangle, const Sweep& sweep) noexcept : triangle_(triangle) {
  measure(triangle, sweep);
  // Not so for a NaN or an infinity either.
  if (!(fourth_powers_fit(size_) && length_ < infinity)) measure_in_unit(triangle, sweep);
  finish();
}

void PathGap::measure(const PreparedTriangle& triangle, const Sweep& sweep) noexcept {
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    start_[i] = sweep.from - triangle.corner[i];
    edge_[i] = triangle.corner[i == 2 ? 0 : i + 1] - triangle.corner[i];
    largest = std::max(largest, start_[i].cwiseAbs().maxCoeff());
  }
  path_ = sweep.to - sweep.from;
  radius_ = sweep.radius;
  size_ = largest + path_.cwiseAbs().maxCoeff();
  length_ = path_.norm();
}

void PathGap::measure_in_unit(const PreparedTriangle& triangle, const Sweep& sweep) noexcept {
  defined_ = sweep.from.allFinite() && sweep.to.allFinite();
  if (!defined_ || size_ == 0) return;
  unit_ = unit_for(size_);
  if (unit_ > 1) {  // differences of small numbers are exact
    for (Vec3& start : start_) start *= unit_;
    for (Vec3& edge : edge_) edge *= unit_;
    path_ *= unit_;
    radius_ *= unit_;
  } else {  // what becomes too small for all its digits is far below the rounding of the largest
    measure(scaled(triangle, unit_), {unit_ * sweep.from, unit_ * sweep.to, unit_ * sweep.radius});
    return;
  }
  size_ *= unit_;
  length_ = path_.norm();
}

void PathGap::finish() noexcept {
  error_ = 128 * unit_roundoff * size_;
  face_error_ = 32 * unit_roundoff * size_;
  apart_error_ = 64 * unit_roundoff * size_;
  for (std::size_t i = 0; i < 3; ++i) {
    side_[i] = triangle_.normal.cross(edge_[i]);
    squared_edge_[i] = edge_[i].squaredNorm();
  }
}

PathGap::Sample PathGap::at(double fraction) const noexcept {
  constexpr double slope_relative_error = 16 * unit_roundoff;
  const Vec3 moved = fraction * path_;
  const std::array<Vec3, 3> to = {start_[0] + moved, start_[1] + moved, start_[2] + moved};
  const double squared_margin = face_error_ * face_error_;
  bool over_face = true;
  for (std::size_t i = 0; i < 3 && over_face; ++i) {
    const double inside = to[i].dot(side_[i]);
    over_face = inside > 0 && inside * inside > squared_margin * squared_edge_[i];
  }
  if (over_face) {
    const double height = to[0].dot(triangle_.normal), distance = std::abs(height);
    const double rise = path_.dot(triangle_.normal);
    return {distance - radius_,
            face_error_,
            height < 0 ? -rise : rise,
            distance > face_error_ ? slope_relative_error * length_ : infinity,
            height * triangle_.normal,
            true,
            height};
  }
  const std::array<double, 3> squared = {to[0].squaredNorm(), to[1].squaredNorm(), to[2].squaredNorm()};
  Vec3 offset;
  double least = infinity;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = i == 2 ? 0 : i + 1;
    const Vec3 other = from_edge(to[i], to[j], squared[i], squared[j], edge_[i], squared_edge_[i]);
    const double other_squared = other.squaredNorm();
    if (!(other_squared < least)) continue;
    least = other_squared;
    offset = other;
  }
  const double distance = std::sqrt(least);
  if (!(distance > 0)) return {-radius_, error_, 0, infinity, Vec3::Zero(), false, 0};
  return {distance - radius_,
          error_,
          offset.dot(path_) / distance,
          length_ * (direction_error(distance, error_) + slope_relative_error),
          offset,
          false,
          0};
}

bool PathGap::surely_touches(double fraction, const Sample& there, double more) const noexcept {
  const double within = radius_ - error_;
  // The foot found there is a point of the triangle.
  if (within > 0 && (there.offset + more * path_).squaredNorm() < within * within) return true;
  const Sample then = at(fraction + more);
  if (then.gap < -then.error) return true;
  // Over the face all the path between the two, and through it.
  return there.over_face && then.over_face && there.height * then.height < 0 &&
         std::abs(there.height) > face_error_ && std::abs(then.height) > face_error_;
}

bool PathGap::stays_apart(double fraction, const Sample& there, double end) const noexcept {
  const double distance = there.gap + radius_;
  if (!(distance > 0)) return false;
  // Whatever rounding has made of its direction, it is a unit vector to four roundings.
  const Vec3 normal = there.offset / there.offset.norm();
  const Vec3 moved = fraction * path_;
  double lowest = infinity;
  for (const Vec3& start : start_) lowest = std::min(lowest, normal.dot(start + moved));
  const double change = (end - fraction) * normal.dot(path_);
  return lowest + std::min(change, 0.0) - radius_ > apart_error_;
}

Contact PathGap::contact(double fraction, TriangleId id) const noexcept {
  const Sample there = at(fraction);
  const double distance = there.offset.norm();
  std::size_t near = 0;
  Vec3 to = start_[0] + fraction * path_;
  for (std::size_t i = 1; i < 3; ++i) {
    const Vec3 other = start_[i] + fraction * path_;
    if (!(other.squaredNorm() < to.squaredNorm())) continue;
    near = i;
    to = other;
  }
  const Vec3 from_corner = (to - there.offset) / unit_;
  return {triangle_.corner[near] + from_corner,
          distance > 0 ? Vec3(there.offset / distance) : face_normal(triangle_), distance / unit_, id};
}

}  // namespace touchmark
