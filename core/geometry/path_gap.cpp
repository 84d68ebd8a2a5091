#include "core/geometry/path_gap.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/exact/double_double_vector.h"
#include "core/float_limits.h"
#include "core/geometry/distance_error.h"

namespace touchmark {
namespace {

using double_double::cross, double_double::difference, double_double::dot;
using DoubleDoubles = double_double::Vector;

/// Bounds by how much the direction from the foot is off, for a distance that is off by `error`:
/// docs/exactness.md, E17.
double direction_error(double distance, double error) noexcept {
  const double relative = error / distance;
  return relative < 0.25 ? 2 * std::sqrt(relative * (1 + relative)) : infinity;
}

/// True if the value is beyond the margin times the root of the square.
bool exceeds(double value, double margin, double square) noexcept {
  return value > 0 && value * value > margin * margin * square;
}

/// Returns the first zero of value - 2 fall x + curve x^2, what is under the root raised by a part of fall^2;
/// infinite where there is none. The square of `fall` itself would overflow for coordinates beyond 2^170.
double first_root(double value, double fall, double curve, double raised) noexcept {
  if (!(fall > 0)) return infinity;
  const double part = value / fall, root = 1 + raised - curve / fall * part;
  return root >= 0 ? part / (1 + std::sqrt(root)) : infinity;
}

/// Returns where a linear function is zero that is `start` at 0 and `end` at 1, each off by less than
/// `error`: early by less than 2^-50, or nothing where that is not known.
std::optional<double> first_zero(DoubleDouble start, DoubleDouble end, double error) noexcept {
  constexpr double narrow = 0x1p-52;
  const DoubleDouble change = start - end;
  const double least_change = std::abs(change.high) - 4 * error;
  if (!(3 * error <= narrow * least_change)) return std::nullopt;
  return std::max((start / change).rounded() - (narrow + unit_roundoff), 0.0);
}

/// Sums in double-double that are added up at the end: each is off by less than 2^-100 of the sum of all
/// magnitudes, and costs half of what operators do.
DoubleDouble loose_dot(const DoubleDoubles& a, const DoubleDoubles& b) noexcept {
  const DoubleDouble x = two_product(a[0].high, b[0].high), y = two_product(a[1].high, b[1].high),
                     z = two_product(a[2].high, b[2].high);
  const DoubleDouble first = two_sum(x.high, y.high), second = two_sum(first.high, z.high);
  double low = (x.low + y.low) + (z.low + first.low) + second.low;
  for (std::size_t k = 0; k < 3; ++k) low += a[k].high * b[k].low + a[k].low * b[k].high;
  return two_sum(second.high, low);
}
/// a + part b
DoubleDoubles loose_sum(const DoubleDoubles& a, double part, const DoubleDoubles& b) noexcept {
  DoubleDoubles result;
  for (std::size_t k = 0; k < 3; ++k) {
    const DoubleDouble product = two_product(part, b[k].high), sum = two_sum(a[k].high, product.high);
    result[k] = two_sum(sum.high, (sum.low + a[k].low) + (product.low + part * b[k].low));
  }
  return result;
}

Vec3 rounded(const DoubleDoubles& v) noexcept { return {v[0].high, v[1].high, v[2].high}; }

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

PathGap::PathGap(const PreparedTriangle& triangle, const Sweep& sweep) noexcept
    : triangle_(triangle), sweep_(sweep) {
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

PathGap::Corners PathGap::corners_to(double fraction) const noexcept {
  const Vec3 moved = fraction * path_;
  return {start_[0] + moved, start_[1] + moved, start_[2] + moved};
}

bool PathGap::is_over_face(const Corners& to) const noexcept {
  bool over_face = true;
  for (std::size_t i = 0; i < 3 && over_face; ++i)
    over_face = exceeds(to[i].dot(side_[i]), face_error_, squared_edge_[i]);
  return over_face;
}

PathGap::Sample PathGap::at(double fraction) const noexcept {
  constexpr double slope_relative_error = 16 * unit_roundoff;
  const Corners to = corners_to(fraction);
  if (is_over_face(to)) {
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

bool PathGap::reaches_foot(const Sample& there, double more) const noexcept {
  const double within = radius_ - error_;
  return within > 0 && (there.offset + more * path_).squaredNorm() < within * within;
}

bool PathGap::surely_touches(double fraction, const Sample& there, double more) const noexcept {
  if (reaches_foot(there, more)) return true;
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

/// True if the feature's plane, line or point is as far as the triangle, but for what E16 allows. Places
/// where this is so are a convex set.
bool PathGap::is_nearest(Nearest feature, const Corners& to) const noexcept {
  const auto beyond = [&](std::size_t edge, double value) {
    return exceeds(value, face_error_, squared_edge_[edge]);
  };
  const std::size_t i = feature.first, next = i == 2 ? 0 : i + 1, last = i == 0 ? 2 : i - 1;
  if (feature.corners == 3) return is_over_face(to);
  const double along = -to[i].dot(edge_[i]);
  if (feature.corners == 2)
    return squared_edge_[i] > 0 && !beyond(i, along) && !beyond(i, to[next].dot(edge_[i])) &&
           !beyond(i, to[i].dot(side_[i]));
  return (beyond(i, along) || squared_edge_[i] == 0) &&
         (beyond(last, to[i].dot(edge_[last])) || squared_edge_[last] == 0);
}

std::optional<PathGap::Nearest> PathGap::nearest_feature(const Corners& to) const noexcept {
  if (is_nearest({3, 0}, to)) return Nearest{3, 0};
  // A triangle without a normal is a segment only where two corners are one.
  if (triangle_.normal.isZero(0) && std::ranges::find(squared_edge_, 0.0) == squared_edge_.end())
    return std::nullopt;
  for (const int corners : {2, 1})
    for (std::size_t i = 0; i < 3; ++i)
      if (is_nearest({corners, i}, to)) return Nearest{corners, i};
  return std::nullopt;
}

/// Over the face the height less the radius, times twice the area. Else the squared distance less the squared
/// radius.
PathGap::Approach PathGap::approach_to(Nearest feature, double fraction) const noexcept {
  const std::size_t i = feature.first;
  const auto& [a, b, c] = triangle_.corner;
  const Vec3& corner = triangle_.corner[i];
  const DoubleDoubles path = difference(sweep_.to, sweep_.from);
  DoubleDoubles offset = loose_sum(difference(sweep_.from, corner), fraction, path);
  if (feature.corners == 3) {
    const DoubleDoubles normal = cross(difference(b, a), difference(c, a));
    const DoubleDouble height = loose_dot(normal, offset), length = square_root(loose_dot(normal, normal));
    const double value = ((height.high < 0 ? -height : height) - length * DoubleDouble{radius_}).rounded();
    const double fall = (height.high < 0 ? 0.5 : -0.5) * loose_dot(normal, path).rounded();
    const double fall_error = 8 * unit_roundoff * std::abs(fall) + 0x1p-94 * size_ * size_ * length_;
    return {value, 0x1p-89 * size_ * size_ * size_, fall, fall_error, 0};
  }
  Vec3 across = path_;
  if (feature.corners == 2) {
    const double part = rounded(offset).dot(edge_[i]) / squared_edge_[i];
    offset = loose_sum(offset, -part, difference(triangle_.corner[i == 2 ? 0 : i + 1], corner));
    across -= path_.dot(edge_[i]) / squared_edge_[i] * edge_[i];
  }
  const double value = (loose_dot(offset, offset) - two_product(radius_, radius_)).rounded(),
               square = size_ * size_;
  return {value, 0x1p-91 * square, -rounded(offset).dot(path_), error_ * length_, across.squaredNorm()};
}

/// Tells the same of an edge or a corner, times the edge's squared length, all in double-double: right where
/// the path is nearly parallel to the edge, or where the ball is tiny.
PathGap::Approach PathGap::careful_approach_to(Nearest feature, double fraction) const noexcept {
  const Vec3& corner = triangle_.corner[feature.first];
  const DoubleDoubles path = difference(sweep_.to, sweep_.from),
                      offset = loose_sum(difference(sweep_.from, corner), fraction, path),
                      edge = difference(triangle_.corner[(feature.first + 1) % 3], corner);
  const bool of_corner = feature.corners == 1;
  const DoubleDoubles from = of_corner ? offset : cross(offset, edge),
                      rate = of_corner ? path : cross(path, edge);
  const DoubleDouble scale = of_corner ? DoubleDouble{1} : loose_dot(edge, edge);
  return {(loose_dot(from, from) - two_product(radius_, radius_) * scale).rounded(), 0,
          -loose_dot(from, rate).rounded(), 0, loose_dot(rate, rate).rounded()};
}

template <class Result, class Argument>
Result PathGap::in_unit(Result (PathGap::*ask)(Argument) const noexcept, Argument argument) const noexcept {
  const PreparedTriangle triangle = scaled(triangle_, unit_);
  const Sweep sweep{unit_ * sweep_.from, unit_ * sweep_.to, unit_ * sweep_.radius};
  return (PathGap(triangle, sweep).*ask)(argument);
}

std::optional<bool> PathGap::touches_at(double fraction) const noexcept {
  if (unit_ != 1) return in_unit(&PathGap::touches_at, fraction);
  const std::optional<Nearest> feature = nearest_feature(corners_to(fraction));
  if (!feature) return std::nullopt;
  const Approach to = approach_to(*feature, fraction);
  if (to.value > to.value_error) return false;
  return to.value < -to.value_error ? std::optional(true) : std::nullopt;
}

std::optional<bool> PathGap::touches_until(double fraction) const noexcept {
  if (unit_ != 1) return in_unit(&PathGap::touches_until, fraction);
  const Approach plane = approach_to({3, 0}, 0);
  const double start = plane.value - plane.value_error;
  const double end = start - 2 * fraction * (plane.fall + plane.fall_error);
  if (start > 0 && end > 0x1p-50 * start) return false;
  // Where it ends, and where it passes the middle of the corners.
  const Vec3 past_middle = (start_[0] + start_[1] + start_[2]) / 3;
  const double passes = length_ > 0 ? -past_middle.dot(path_) / (length_ * length_) : 0;
  if (touches_at(fraction) == true || touches_at(std::clamp(passes, 0.0, fraction)) == true) return true;
  return std::nullopt;
}

std::optional<double> PathGap::precise_touch(double fraction) const noexcept {
  constexpr int max_steps = 4;
  constexpr double margin = 64 * unit_roundoff, narrow = 0x1.8p-51;
  if (unit_ != 1) return in_unit(&PathGap::precise_touch, fraction);
  for (int step = 0; step < max_steps; ++step) {
    const std::optional<Nearest> feature = nearest_feature(corners_to(fraction));
    if (!feature) break;
    const Approach to = approach_to(*feature, fraction);
    const double curve_error = margin * length_ * length_;
    const double least = first_root(std::max(to.value - to.value_error, 0.0), to.fall + to.fall_error,
                                    std::max(to.curve - curve_error, 0.0), margin);
    const double most =
        first_root(to.value + to.value_error, to.fall - to.fall_error, to.curve + curve_error, -margin) *
        (1 + margin);
    // Tests are off by as much more as the place is beyond the path's end.
    if (!(fraction + most < 1.125) || !is_nearest(*feature, corners_to(fraction + most))) break;
    const double next = std::max(fraction, fraction + (least * (1 - margin) - unit_roundoff));
    if (fraction + most - next <= narrow) return next;
    fraction = next;
  }
  return std::nullopt;
}

std::optional<double> PathGap::precise_meeting(bool in_plane) const noexcept {
  if (unit_ != 1) return in_unit(&PathGap::precise_meeting, in_plane);
  const auto& [a, b, c] = triangle_.corner;
  const DoubleDoubles normal = cross(difference(b, a), difference(c, a));
  if (!in_plane)
    return first_zero(dot(normal, difference(sweep_.from, a)), dot(normal, difference(sweep_.to, a)),
                      0x1p-89 * size_ * size_ * size_);
  // The last of the edges' lines that it crosses inwards, as seen along the axis that is nearest the normal.
  const double side_error = 0x1p-94 * size_ * size_;
  Eigen::Index axis = 0;
  if (!(rounded(normal).cwiseAbs().maxCoeff(&axis) > side_error)) return std::nullopt;
  const auto x = static_cast<std::size_t>((axis + 1) % 3), y = static_cast<std::size_t>((axis + 2) % 3);
  const bool turns_left = rounded(normal)[axis] > 0;
  double meeting = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& corner = triangle_.corner[i];
    const DoubleDoubles edge = difference(triangle_.corner[i == 2 ? 0 : i + 1], corner);
    const auto side = [&](const Vec3& place) {
      const DoubleDoubles to = difference(place, corner);
      const DoubleDouble left = edge[x] * to[y] - edge[y] * to[x];
      return turns_left ? left : -left;
    };
    const DoubleDouble start = side(sweep_.from);
    if (start.high > side_error) continue;
    const std::optional<double> crossing = first_zero(start, side(sweep_.to), side_error);
    if (!crossing) return std::nullopt;
    meeting = std::max(meeting, *crossing);
  }
  return meeting;
}

std::array<double, 7> PathGap::possible_touches(double fraction) const noexcept {
  if (unit_ != 1) return in_unit(&PathGap::possible_touches, fraction);
  constexpr int steps = 3;  // each corrects what rounding did to the one before
  std::array<double, 7> touches;
  touches.fill(fraction);
  for (std::size_t i = 0; i < touches.size(); ++i)
    for (int step = 0; step < steps; ++step) {
      const Approach to =
          i == 6 ? approach_to({3, 0}, touches[i]) : careful_approach_to({i < 3 ? 2 : 1, i % 3}, touches[i]);
      const double root = first_root(to.value, to.fall, to.curve, 0);
      // A path that grazes may seem to pass: from where it is nearest the next step tells more.
      touches[i] += std::isinf(root) && to.curve > 0 ? to.fall / to.curve : root;
    }
  return touches;
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
