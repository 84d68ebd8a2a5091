#include "core/geometry/sphere_triangle_sweep.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/detector.h"

namespace touchmark {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();

/// M in the kernel's error bound: the largest coordinate difference between a point and the corners.
double largest_difference(const PreparedTriangle& triangle, const Vec3& point) noexcept {
  double largest = 0;
  for (const Vec3& corner : triangle.corner)
    largest = std::max(largest, (point - corner).cwiseAbs().maxCoeff());
  return largest;
}

/// By how much the direction to a nearest point may be off, as an angle, when the distance is off by `error`:
/// a point of the triangle that is no farther than distance + error lies within the root of
/// 2 distance error + error^2 of the nearest one. The foot itself is rounded by no more than the error again.
double direction_error(double distance, double error) noexcept {
  const double relative = 2 * error / distance;
  return 2 * epsilon + std::sqrt(relative * (2 + relative));
}

/// How far ball and triangle are apart, along the way: a convex function.
class Gap {
 public:
  Gap(const PreparedTriangle& triangle, const Sweep& sweep) noexcept
      : triangle_(triangle),
        sweep_(sweep),
        way_(sweep.to - sweep.from),
        length_(way_.norm()),
        position_error_(position_error(sweep)) {}

  /// What is known of it at a fraction of the way.
  struct Sample {
    bool at_start;
    double gap;
    double error;  ///< how far off `gap` may be
    double slope;  ///< d gap / d fraction
    double slope_error;

    /// At the start as for a probe that stands there, on the way within the error.
    bool touching() const noexcept { return gap <= (at_start ? 0 : error); }
    /// So far into it that the touch was before.
    bool deep() const noexcept { return !at_start && gap < -error; }
    /// Even falling as steeply as it can, from `back` before here to `ahead` of it, it stays apart. So does
    /// a NaN.
    bool apart_within(double back, double ahead) const noexcept {
      const double fall = std::min((slope - slope_error) * ahead, -(slope + slope_error) * back);
      return !(gap + fall <= error);
    }
  };

  Sample at(double fraction) const noexcept {
    const Vec3 position = position_at(sweep_, fraction);
    const Contact contact = contact_on(triangle_, position, 0);
    const double kernel_error = kernel_relative_error * largest_difference(triangle_, position);
    const double slope = contact.normal.dot(way_);
    const double slope_error = length_ * direction_error(contact.distance, kernel_error);
    return {!(fraction > 0), contact.distance - sweep_.radius, kernel_error + position_error_, slope,
            slope_error};
  }

  /// After a fraction where it falls: no earlier one than this is told as a touch. The steepest tangent there
  /// bounds it from below, and it counts as a touch at its own error, which is larger elsewhere by no more
  /// than what the way adds to M.
  double earliest(double fraction, const Sample& there) const noexcept {
    const double told = 3 * there.error + 2 * kernel_relative_error * length_;
    return fraction - (there.gap - told) / (there.slope - there.slope_error);
  }

 private:
  const PreparedTriangle& triangle_;
  const Sweep& sweep_;
  Vec3 way_;
  double length_;
  double position_error_;
};

/// Between a fraction where the two are apart and one where they touch: the first touch, by halving.
double first_touch(const Gap& gap, double apart, double touching) noexcept {
  while (touching - apart > epsilon) {
    const double middle = std::midpoint(apart, touching);
    (gap.at(middle).touching() ? touching : apart) = middle;
  }
  return touching;
}

/// Where the slope drowns in rounding: looks for the least gap by comparing gaps alone, in thirds, and if
/// that is a touch for the first one by halving. `apart` is a fraction where the two are apart.
std::optional<double> search(const Gap& gap, double apart) noexcept {
  constexpr int most_steps = 128;  // (2/3)^128 is less than a rounding
  double low = apart, high = 1;
  bool touched = gap.at(high).touching();
  double touching = high;
  for (int step = 0; step < most_steps && !touched && low < high; ++step) {
    const double third = (high - low) / 3;
    const double left = low + third, right = high - third;
    const Gap::Sample at_left = gap.at(left), at_right = gap.at(right);
    touched = at_left.touching() || at_right.touching();
    if (!touched && (at_left.apart_within(third, 2 * third) || at_right.apart_within(2 * third, third)))
      break;
    touching = at_left.touching() ? left : right;
    (at_left.gap < at_right.gap ? high : low) = at_left.gap < at_right.gap ? right : left;
  }
  if (!touched) return std::nullopt;
  return first_touch(gap, apart, touching);
}

}  // namespace

double position_error(const Sweep& sweep) noexcept {
  return 4 * epsilon * (sweep.from.cwiseAbs().maxCoeff() + sweep.to.cwiseAbs().maxCoeff());
}

// Detectors look at triangles in different orders and so with different limits: the limit only ends the
// search, the steps do not depend on it.
std::optional<double> sweep_hit(const PreparedTriangle& triangle, const Sweep& sweep, double limit) noexcept {
  // Grazing makes Newton's steps halve instead of square the error: this many exhaust a double's digits.
  constexpr int most_steps = 64;
  const Gap gap(triangle, sweep);
  const auto within_limit = [&](std::optional<double> found) {
    return found && *found <= limit ? found : std::nullopt;
  };
  double fraction = 0, before = 0;  // nothing touches up to `before`
  for (int step = 0; step < most_steps; ++step) {
    const Gap::Sample here = gap.at(fraction);
    if (here.touching()) return within_limit(here.deep() ? first_touch(gap, before, fraction) : fraction);
    if (here.apart_within(fraction - before, 1 - fraction)) return std::nullopt;
    if (!(here.slope < -2 * here.slope_error)) break;
    if (gap.earliest(fraction, here) > limit) return std::nullopt;
    // Where the tangent meets zero: no later than the touch, but for the slope's error.
    const double next = std::min(fraction - here.gap / here.slope, 1.0);
    if (!(next > fraction)) break;
    before = fraction;
    fraction = next;
  }
  return within_limit(search(gap, before));
}

}  // namespace touchmark
