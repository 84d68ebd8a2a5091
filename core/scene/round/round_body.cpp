#include "core/scene/round/round_body.h"

#include <cmath>
#include <string>

#include "core/float_limits.h"
#include "core/geometry/distance_error.h"
#include "core/geometry/point_triangle.h"
#include "core/geometry/sphere_triangle_sweep.h"
#include "core/scene/body_sweep.h"
#include "core/scene/posed_predicates.h"

namespace touchmark {
namespace {

constexpr double min_radius = 0x1p-120, max_radius = 0x1p200;

/// The way is off by a rounding, and the sum of the radii by two. Inside, the place is off by three, and the
/// kernel by 48.
constexpr double outside_roundings = 8, inside_roundings = 64;

PreparedTriangle prepared(const TriangleCorners& corner) noexcept { return {corner, Vec3::Zero(), 0}; }

}  // namespace

void expect_round(const TriangleMesh& axis, double radius) {
  if (!(radius >= min_radius && radius <= max_radius))
    throw SceneError("a round shape's radius is " + std::to_string(radius) +
                     ", and must be from 2^-120 to 2^200");
  if (axis.size() != 1 || axis.corner(0, 1) != axis.corner(0, 2))
    throw SceneError("a round shape's mesh is not one triangle whose last two corners are the same");
}

RoundBody::RoundBody(const TriangleMesh& axis, double radius, const PlacedBody& placed, std::uint32_t body,
                     const Vec3& point) noexcept
    : point_(point) {
  candidate_.body = body;
  candidate_.id = axis.id(0);
  candidate_.posed = {{axis.corner(0, 0), axis.corner(0, 1), axis.corner(0, 2)}, &placed.pose, radius};
  const SeenBody seen(placed.pose, double{placed.rigid}, point);
  const SeenCorners corners(seen);
  candidate_.seen = corners(candidate_.posed.corner);
  candidate_.distance = distance_to(candidate_.seen, radius);
  error_ = candidate_.seen.error;
  // All but on the axis the kernel leaves the range of double, but no corner is farther than this.
  const double largest = candidate_.seen.largest;
  if (fourth_powers_fit(largest) || !(largest < min_radius)) return;
  error_ = corners.error_at(largest);
  const double off = 2 * (largest + error_) + 4 * unit_roundoff * radius;
  candidate_.distance = {radius - off, radius + off};
}

bool RoundBody::starts_inside(Work& work) const noexcept {
  const DistanceInterval axis = distance_to(candidate_.seen);
  if (axis.upper < candidate_.posed.radius) return true;
  if (axis.lower > candidate_.posed.radius) return false;
  ++work.exact_decisions;
  return lies_inside(candidate_.posed, point_);
}

double RoundBody::error_along(const Sweep& sweep, double roundings) const noexcept {
  const double way = (sweep.to - sweep.from).norm();
  const double size = candidate_.seen.largest + way + candidate_.posed.radius + sweep.radius;
  return error_ + roundings * unit_roundoff * size;
}

std::optional<double> RoundBody::outside_hit(const Sweep& sweep, double radius) const noexcept {
  return sweep_hit(prepared(candidate_.seen.corner), {Vec3::Zero(), sweep.to - sweep.from, radius}, 1);
}

double RoundBody::distance_along(const Sweep& sweep, double part) const noexcept {
  return std::sqrt(squared_distance(prepared(candidate_.seen.corner), part * (sweep.to - sweep.from)));
}

/// The distance to the axis is convex along the way, so it is below where the probe touches up to one place
/// and no longer beyond it. Halving finds that place from below.
double RoundBody::inside_hit(const Sweep& sweep) const noexcept {
  const double limit = candidate_.posed.radius - sweep.radius - error_along(sweep, inside_roundings);
  const auto is_before = [&](double part) { return distance_along(sweep, part) < limit; };
  double before = 0, after = 1;
  if (!is_before(before)) return before;
  if (is_before(after)) return after;
  for (double middle = 0.5; middle > before && middle < after; middle = before + 0.5 * (after - before))
    (is_before(middle) ? before : after) = middle;
  return before;
}

bool RoundBody::surely_touches(const Sweep& sweep, bool inside) const noexcept {
  const double radius = candidate_.posed.radius;
  if (inside) return distance_along(sweep, 1) > radius - sweep.radius + error_along(sweep, inside_roundings);
  const double surely = radius + sweep.radius - error_along(sweep, outside_roundings);
  return surely > 0 && outside_hit(sweep, surely);
}

std::optional<Impact> RoundBody::first_hit(const Sweep& sweep, Work& work) const noexcept {
  const auto impact = [&](double fraction) {
    return Impact{fraction, lifted(contact_on_way(candidate_, sweep, fraction), candidate_.posed.radius)};
  };
  if (touches(sweep.radius, work)) return impact(0);
  const bool inside = starts_inside(work);
  const double sum = candidate_.posed.radius + sweep.radius;
  const std::optional<double> fraction =
      inside ? inside_hit(sweep) : outside_hit(sweep, sum + error_along(sweep, outside_roundings));
  if (!fraction) return std::nullopt;
  if (!surely_touches(sweep, inside)) {
    ++work.exact_decisions;
    if (!path_within_exactly(candidate_.posed, sweep.from, sweep.to, 1, sweep.radius)) return std::nullopt;
  }
  return impact(*fraction);
}

}  // namespace touchmark
