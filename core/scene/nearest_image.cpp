#include "core/scene/nearest_image.h"

#include <algorithm>
#include <cmath>
#include <tuple>

#include "core/float_limits.h"
#include "core/geometry/distance_error.h"
#include "core/geometry/point_triangle.h"
#include "core/geometry/widest_offset.h"

namespace touchmark {
namespace {

/// Whole numbers say it all; the contact of a point on the image has the face's normal, turned as it is.
Contact exact_contact(const ImageCandidate& candidate, const Vec3& point) noexcept {
  const ClosestPoint closest = closest_point_exactly(candidate.posed, point);
  Contact contact;
  contact.triangle = candidate.id;
  contact.distance = closest.distance.rounded();
  contact.point = point - closest.offset;
  contact.normal = closest.direction;
  if (closest.direction.isZero()) {
    const TriangleCorners& corner = candidate.posed.corner;
    const Vec3 normal = face_normal(prepare(corner[0], corner[1], corner[2], candidate.triangle));
    contact.normal = (candidate.posed.pose->rotation * normal).normalized();
  }
  const double radius = candidate.posed.radius;
  if (!(radius > 0)) return contact;
  contact = lifted(contact, radius);
  contact.distance = std::abs((closest.distance - DoubleDouble{radius, 0}).rounded());
  return contact;
}

/// Returns which is surely less, or that they are equivalent as far as is known.
std::weak_ordering order_of(const DistanceInterval& a, const DistanceInterval& b) noexcept {
  if (a.upper < b.lower) return std::weak_ordering::less;
  if (a.lower > b.upper) return std::weak_ordering::greater;
  return std::weak_ordering::equivalent;
}

/// Is it known without any distance that both are exactly as far?
bool surely_tied(const ImageCandidate& a, const ImageCandidate& b) noexcept {
  const bool one_pose = a.posed.pose == b.posed.pose || *a.posed.pose == *b.posed.pose;
  return one_pose && a.posed.radius == b.posed.radius &&
         surely_tied(a.posed.corner, a.seen, b.posed.corner, b.seen);
}

/// Which of several that are as far is the nearest?
auto place_of(const ImageCandidate& candidate) noexcept {
  return std::tuple(candidate.body, candidate.id, candidate.triangle);
}

}  // namespace

std::weak_ordering NearestImage::compare(const ImageCandidate& a, const ImageCandidate& b,
                                         std::uint64_t& exact_decisions) const noexcept {
  const std::weak_ordering by_bounds = order_of(a.distance, b.distance);
  if (by_bounds != 0) return by_bounds;
  if (surely_tied(a, b)) return std::weak_ordering::equivalent;
  // What the detector said of one that was alone is wider than what the image tells.
  const std::weak_ordering by_images =
      order_of(distance_to(a.seen, a.posed.radius), distance_to(b.seen, b.posed.radius));
  if (by_images != 0) return by_images;
  ++exact_decisions;
  return compare_exactly(a.posed, b.posed, point_);
}

void NearestImage::consider(const ImageCandidate& candidate, std::uint64_t& exact_decisions) noexcept {
  if (is_best(candidate)) return;
  if (best_) {
    const std::weak_ordering order = compare(candidate, *best_, exact_decisions);
    if (order > 0 || (order == 0 && place_of(candidate) > place_of(*best_))) return;
  }
  best_ = candidate;
}

void NearestImage::consider_unmeasured(ImageCandidate candidate, std::uint64_t& exact_decisions) noexcept {
  if (is_best(candidate)) return;
  if (best_ && surely_tied(candidate, *best_)) {
    if (place_of(candidate) > place_of(*best_)) return;
    candidate.distance = best_->distance;
    best_ = candidate;
    return;
  }
  candidate.distance = distance_to(candidate.seen, candidate.posed.radius);
  consider(candidate, exact_decisions);
}

std::optional<Contact> NearestImage::contact(double reach, std::uint64_t& exact_decisions) const noexcept {
  if (!best_) return std::nullopt;
  ImageCandidate best = *best_;
  if (best.distance.lower <= reach && reach < best.distance.upper)
    best.distance = distance_to(best.seen, best.posed.radius);
  if (!is_within(best, point_, reach, exact_decisions)) return std::nullopt;
  return contact_on_image(*best_, point_, exact_decisions);
}

DistanceInterval distance_to(const SeenTriangle& seen) noexcept {
  if (!fourth_powers_fit(seen.largest)) return {};
  const PreparedTriangle prepared = prepare(seen.corner[0], seen.corner[1], seen.corner[2], 0);
  const double distance = std::sqrt(widest_offset_from(prepared, Vec3::Zero()).squared);
  const double error = distance_error(seen.largest) + seen.error;
  return {distance - error, distance + error};
}

DistanceInterval distance_to(const SeenTriangle& seen, double radius) noexcept {
  const DistanceInterval axis = distance_to(seen);
  if (!(radius > 0)) return axis;
  const double rounding = 4 * unit_roundoff * (axis.upper + radius);
  const double beyond = axis.lower - radius, within = radius - axis.upper;
  return {std::max(beyond, within) - rounding, std::max(axis.upper - radius, radius - axis.lower) + rounding};
}

Contact lifted(Contact on_axis, double radius) noexcept {
  const double height = on_axis.distance - radius;
  on_axis.point += radius * on_axis.normal;
  if (height < 0) on_axis.normal = -on_axis.normal;
  on_axis.distance = std::abs(height);
  return on_axis;
}

bool is_within(const ImageCandidate& candidate, const Vec3& point, double radius,
               std::uint64_t& exact_decisions) noexcept {
  if (candidate.distance.upper <= radius) return true;
  if (candidate.distance.lower > radius) return false;
  ++exact_decisions;
  return within_exactly(candidate.posed, point, radius);
}

Contact contact_on_image(const ImageCandidate& candidate, const Vec3& point,
                         std::uint64_t& exact_decisions) noexcept {
  const TriangleCorners& corner = candidate.seen.corner;
  double largest = 0;
  for (const Vec3& w : corner) largest = std::max(largest, w.cwiseAbs().maxCoeff());
  if (fourth_powers_fit(largest) && candidate.seen.error <= 15 * unit_roundoff * largest) {
    const PreparedTriangle prepared = prepare(corner[0], corner[1], corner[2], candidate.triangle);
    const Vec3 origin = Vec3::Zero();
    const Offset offset = widest_offset_from(prepared, origin);
    // From there on the kernel's distance is within 16 u M: docs/exactness.md, E5. Deep in a round body the
    // direction must be as good, far from whose surface it is told.
    const bool is_round = candidate.posed.radius > 0;
    if (std::sqrt(offset.squared) > (is_round ? 0x1p20 : 1) * distance_error(largest)) {
      Contact contact = contact_at(prepared, origin, offset, candidate.id);
      contact.point += point;
      return is_round ? lifted(contact, candidate.posed.radius) : contact;
    }
  }
  ++exact_decisions;
  return exact_contact(candidate, point);
}

}  // namespace touchmark
