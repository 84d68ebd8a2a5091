#include "core/geometry/sphere_triangle_sweep.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/exact/distance_predicates.h"
#include "core/exact/orientation.h"
#include "core/float_limits.h"
#include "core/geometry/path_gap.h"

namespace touchmark {
namespace {

constexpr double epsilon = std::numeric_limits<double>::epsilon();
constexpr double smallest = std::numeric_limits<double>::denorm_min();

/// A fraction before which nothing touches, and what was found there.
struct Reached {
  double fraction;
  PathGap::Sample here;
};

class FirstTouch {
 public:
  FirstTouch(const PreparedTriangle& triangle, const Sweep& sweep, std::uint64_t& exact_decisions) noexcept
      : triangle_(triangle), sweep_(sweep), gap_(triangle, sweep), exact_decisions_(exact_decisions) {}

  std::optional<TouchBounds> find(double limit) noexcept;
  double refine(const TouchBounds& bounds) noexcept;

 private:
  bool touches_at_start(const PathGap::Sample& start) noexcept {
    if (start.gap < -start.error) return true;
    if (start.gap > start.error) return false;
    if (const std::optional<bool> touches = gap_.touches_at(0)) return *touches;
    ++exact_decisions_;
    return within_exactly(triangle_.corner, sweep_.from, sweep_.radius);
  }
  bool comes_within(double fraction) noexcept {
    if (const std::optional<bool> touches = gap_.touches_until(fraction)) return *touches;
    ++exact_decisions_;
    return path_within_exactly(triangle_.corner, sweep_.from, sweep_.to, fraction, sweep_.radius);
  }
  /// Surely nothing touches from there on? No more than `above` is asked for, up to `end`.
  bool stays_above(double above, const Reached& reached, double end) const noexcept {
    return reached.here.gap - reached.here.error - above >
           gap_.steepest_fall(reached.here) * (end - reached.fraction);
  }
  bool stays_apart(const Reached& reached) const noexcept {
    return !reached.here.over_face && gap_.stays_apart(reached.fraction, reached.here, 1);
  }
  struct Crossing {
    double fraction;
    double gap;  ///< bounds what is between from below
  };
  static Crossing crossing_of(const Reached& first, const Reached& second) noexcept;
  Reached advance(const Reached& reached) const noexcept;
  std::optional<TouchBounds> conclude(const Reached& reached) const noexcept;
  std::optional<TouchBounds> decide(const Reached& reached) noexcept;
  double meeting() noexcept;
  double divide(double low, double high) noexcept;

  const PreparedTriangle& triangle_;
  const Sweep& sweep_;
  PathGap gap_;
  std::uint64_t& exact_decisions_;
};

/// Steps by Newton's method, aimed at a gap surely above zero. Where that has passed the least gap, both
/// tangents bound what is between; if they do not keep it above zero, it goes on where they cross. Else by
/// what is safe.
Reached FirstTouch::advance(const Reached& reached) const noexcept {
  constexpr int max_tangents = 8;
  const PathGap::Sample& here = reached.here;
  if (here.surely_falls()) {
    double next = std::min(reached.fraction + (here.gap - 1.5 * here.error) / -here.slope, 1.0);
    for (int tangent = 0; tangent < max_tangents; ++tangent) {
      const PathGap::Sample there = gap_.at(next);
      if (!(there.gap > there.error)) break;
      if (there.surely_falls()) return {next, there};
      const Crossing crossing = crossing_of(reached, {next, there});
      if (crossing.gap > there.error) return {next, there};
      next = crossing.fraction;
    }
  }
  const double safe = (here.gap - here.error) / gap_.steepest_fall(here);
  const double next = std::min(reached.fraction + safe, 1.0);
  return {next, gap_.at(next)};
}

/// The tangents, as low as they may be, cross there: the first falls, the second one does not surely.
FirstTouch::Crossing FirstTouch::crossing_of(const Reached& first, const Reached& second) noexcept {
  const double low = first.here.gap - first.here.error, fall = first.here.slope - first.here.slope_error;
  const double high = second.here.gap - second.here.error;
  const double rise = second.here.slope + second.here.slope_error;
  const double length = second.fraction - first.fraction;
  const double part = std::clamp((low - high + rise * length) / (rise - fall), 0.0, length);
  return {first.fraction + part, low + fall * part};
}

/// Nothing touches before there. Returns bounds where it is near enough and surely a hit.
std::optional<TouchBounds> FirstTouch::conclude(const Reached& reached) const noexcept {
  // Curved as it is, the gap falls to zero within so much more than it would if straight.
  constexpr double curved = 1 + 0x1p-10, near = 0x1p-10;
  const PathGap::Sample& here = reached.here;
  const double more =
      std::min((here.gap + 2 * gap_.max_error()) / -here.slope * curved, 1 - reached.fraction);
  const bool is_sure =
      more >= 0 && (here.gap <= 2 * here.error ? gap_.surely_touches(reached.fraction, here, more)
                                               : more < near && gap_.reaches_foot(here, more));
  if (!is_sure) return std::nullopt;
  return TouchBounds{std::max(reached.fraction, smallest), std::min(reached.fraction + more + epsilon, 1.0)};
}

/// Decides exactly: where the path grazes, so that steps lead nowhere or the slope drowns in rounding.
std::optional<TouchBounds> FirstTouch::decide(const Reached& reached) noexcept {
  if (!comes_within(1)) return std::nullopt;
  const double fraction = refine({std::max(reached.fraction, smallest), 1});
  return TouchBounds{fraction, fraction};
}

double FirstTouch::refine(const TouchBounds& bounds) noexcept {
  constexpr double narrow = 0x1p-50;
  if (bounds.last - bounds.first < narrow) return bounds.first;
  if (sweep_.radius == 0) return std::max(bounds.first, meeting());
  if (const std::optional<double> precise = gap_.precise_touch(bounds.first)) return *precise;
  return divide(bounds.first, bounds.last);
}

/// Returns where a bare point meets the triangle, which it does.
double FirstTouch::meeting() noexcept {
  const auto& [a, b, c] = triangle_.corner;
  const bool in_plane = side_of_plane(a, b, c, sweep_.from) == 0 && side_of_plane(a, b, c, sweep_.to) == 0;
  if (const std::optional<double> precise = gap_.precise_meeting(in_plane)) return *precise;
  ++exact_decisions_;
  return first_meeting_exactly(triangle_.corner, sweep_.from, sweep_.to);
}

/// Divides the part in which the first touch is, down to less than 2^-50 of the path: beside the places where
/// it may be, then in the middle.
double FirstTouch::divide(double low, double high) noexcept {
  constexpr double grid = 0x1p53, narrow = 0x1p-51;
  const auto divide_at = [&](double place) {
    const double middle = std::round(place * grid) / grid;
    if (!(low < middle && middle < high)) return;
    const PathGap::Sample there = gap_.at(middle);
    const bool is_off = there.gap > there.error;
    const bool after = there.gap < -there.error || (is_off && there.surely_rises()) ||
                       (!(is_off && there.surely_falls()) && comes_within(middle));
    (after ? high : low) = middle;
  };
  for (const double touch : gap_.possible_touches(low)) {
    if (high - low <= narrow) break;
    divide_at(touch - narrow / 2);
    divide_at(touch + narrow / 2);
  }
  while (high - low > narrow) divide_at(std::midpoint(low, high));
  return low;
}

std::optional<TouchBounds> FirstTouch::find(double limit) noexcept {
  // Grazing makes Newton's steps halve instead of square the error: this many exhaust a double's digits.
  constexpr int max_steps = 64;
  if (!gap_.is_defined()) return std::nullopt;
  Reached reached{0, gap_.at(0)};
  if (sweep_.radius == 0) {
    if (stays_above(0, reached, 1) || stays_above(gap_.max_early(), reached, limit)) return std::nullopt;
    const std::optional<bool> meets = meets_by_sides(triangle_.corner, sweep_.from, sweep_.to);
    if (meets == false) return std::nullopt;
    if (meets) {
      const double fraction = touches_at_start(reached.here) ? 0 : std::max(meeting(), smallest);
      return TouchBounds{fraction, fraction};
    }
  }
  if (touches_at_start(reached.here)) return TouchBounds{0, 0};
  for (int step = 0; step < max_steps; ++step) {
    if (reached.here.surely_rises() || stays_above(0, reached, 1) || stays_apart(reached))
      return std::nullopt;
    if (reached.fraction >= 1 && reached.here.gap > reached.here.error) return std::nullopt;
    // Up to the limit the gap is more than at the fraction told.
    if (stays_above(gap_.max_early(), reached, limit)) return std::nullopt;
    if (const std::optional<TouchBounds> bounds = conclude(reached)) return bounds;
    if (reached.here.gap <= 2 * reached.here.error) return decide(reached);
    const Reached next = advance(reached);
    if (!(next.fraction > reached.fraction)) break;
    reached = next;
  }
  return decide(reached);
}

}  // namespace

Vec3 position_at(const Sweep& sweep, double fraction) noexcept {
  return fraction < 1 ? Vec3(sweep.from + fraction * (sweep.to - sweep.from)) : sweep.to;
}

double position_error(const Sweep& sweep) noexcept {
  return 4 * epsilon * (sweep.from.cwiseAbs().maxCoeff() + sweep.to.cwiseAbs().maxCoeff());
}

std::optional<TouchBounds> touch_bounds(const PreparedTriangle& triangle, const Sweep& sweep, double limit,
                                        std::uint64_t& exact_decisions) noexcept {
  if (!(sweep.radius >= 0)) return std::nullopt;
  const std::optional<TouchBounds> bounds = FirstTouch(triangle, sweep, exact_decisions).find(limit);
  return bounds && bounds->first <= limit ? bounds : std::nullopt;
}

double touch_fraction(const PreparedTriangle& triangle, const Sweep& sweep, const TouchBounds& bounds,
                      std::uint64_t& exact_decisions) noexcept {
  return bounds.first < bounds.last ? FirstTouch(triangle, sweep, exact_decisions).refine(bounds)
                                    : bounds.first;
}

std::optional<double> sweep_hit(const PreparedTriangle& triangle, const Sweep& sweep, double limit) noexcept {
  std::uint64_t uncounted = 0;
  const std::optional<TouchBounds> bounds = touch_bounds(triangle, sweep, limit, uncounted);
  const double fraction = bounds ? touch_fraction(triangle, sweep, *bounds, uncounted) : infinity;
  return fraction <= limit ? std::optional(fraction) : std::nullopt;
}

Contact contact_on_path(const PreparedTriangle& triangle, const Sweep& sweep, double fraction,
                        TriangleId id) noexcept {
  return PathGap(triangle, sweep).contact(fraction, id);
}

}  // namespace touchmark
