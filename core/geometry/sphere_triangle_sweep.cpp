#include "core/geometry/sphere_triangle_sweep.h"

#include <algorithm>
#include <cmath>

#include "core/detector.h"

namespace touchmark {
namespace {

/// The largest coordinate difference between a point and the corners: M in the kernel's error bound.
double largest_difference(const PreparedTriangle& triangle, const Vec3& point) noexcept {
  double largest = 0;
  for (const Vec3& corner : triangle.corner)
    largest = std::max(largest, (point - corner).cwiseAbs().maxCoeff());
  return largest;
}

}  // namespace

std::optional<double> sweep_hit(const PreparedTriangle& triangle, const Sweep& sweep, double limit) noexcept {
  constexpr double epsilon = std::numeric_limits<double>::epsilon();
  // Grazing makes Newton's steps halve instead of square the error: 64 of them exhaust a double's digits.
  constexpr int most_steps = 64;
  const Vec3 way = sweep.to - sweep.from;
  const double length = way.norm();
  double fraction = 0;
  for (int step = 0; step < most_steps && fraction <= limit; ++step) {
    const Vec3 position = position_at(sweep, fraction);
    const Contact contact = contact_on(triangle, position, 0);
    const double difference = largest_difference(triangle, position);
    const double position_error = epsilon * position.cwiseAbs().maxCoeff();
    const double tolerance = fraction > 0 ? kernel_relative_error * difference + position_error : 0;
    const double gap = contact.distance - sweep.radius;
    if (gap <= tolerance) return fraction;
    if (fraction >= 1) return std::nullopt;
    // d distance / d fraction, taken steeper by its rounding so that no step goes past the touch.
    const double slope_error = 2 * epsilon * length * (1 + difference / contact.distance);
    const double slope = contact.normal.dot(way) - slope_error;
    if (!(slope < 0)) return std::nullopt;
    const double next = std::min(fraction + gap / -slope, 1.0);
    if (!(next > fraction)) return fraction;  // nearer than the fraction's own rounding
    fraction = next;
  }
  return std::nullopt;
}

}  // namespace touchmark
