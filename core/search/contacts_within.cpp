#include "core/search/contacts_within.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <limits>
#include <optional>

#include "core/exact/distance_predicates.h"
#include "core/geometry/distance_error.h"
#include "core/search/certified_nearest.h"
#include "core/search/shared_feature.h"

namespace touchmark {
namespace {

/// Bounds what both computed distances are off by, of 48 u M each (docs/exactness.md, E1) with M of either
/// triangle, and their roots' rounding. Less than distance_error by as much as the triangles are nearer than
/// the mesh's box reaches.
double error_of_both(const PreparedTriangle& a, const PreparedTriangle& b, const Vec3& center) noexcept {
  constexpr double relative_error = 128 * (std::numeric_limits<double>::epsilon() / 2), underflow = 0x1p-200;
  double largest = 0;
  for (std::size_t i = 0; i < 3; ++i)
    largest = std::max({largest, (center - a.corner[i]).cwiseAbs().maxCoeff(),
                        (center - b.corner[i]).cwiseAbs().maxCoeff()});
  return largest >= 0x1p-132 ? relative_error * largest + underflow : std::numeric_limits<double>::infinity();
}

}  // namespace

SquaredDistance CloseSquares::of(std::uint32_t slot, const PreparedTriangle& triangle,
                                 const Vec3& center) noexcept {
  if (!is_used_) slot_.fill(nowhere);
  is_used_ = true;
  const std::size_t at = slot % slot_.size();
  if (slot_[at] != slot) {
    slot_[at] = slot;
    square_[at] = TiedTriangle(triangle, center).squared(center);
  }
  return square_[at];
}

ContactsWithin::ContactsWithin(const ContactsQuestion& question) noexcept
    : question_(question),
      error_(question.decides_exactly ? distance_error(question.bounds, question.center) : 0),
      is_scaled_(std::isinf(error_)),
      scale_(is_scaled_ ? unit_for(largest_difference(question.bounds, question.center)) : 1),
      point_(scale_ * question.center),
      reach_(scale_ * question.reach),
      is_within_(question.center, question.reach, error_) {
  const Aabb& bounds = question.bounds;
  if (is_scaled_) error_ = distance_error({scale_ * bounds.min, scale_ * bounds.max}, point_);
}

double ContactsWithin::distance_to(const PreparedTriangle& triangle, const Offset& offset) const noexcept {
  return std::sqrt(is_scaled_ ? squared_distance(scaled(triangle, scale_), point_) : offset.squared);
}

bool ContactsWithin::is_within(const PreparedTriangle& triangle, double distance, Work& work) noexcept {
  if (!question_.decides_exactly) return distance <= question_.reach;
  if (!is_scaled_) return is_within_(triangle, distance, work.exact_decisions);
  if (std::abs(distance - reach_) > error_) return distance < reach_;
  ++work.exact_decisions;
  return within_exactly(triangle.corner, question_.center, question_.reach);
}

/// Meanwhile a contact has the triangle's slot for its id, the computed distance in this unit, the offset for
/// its point, and the offset's square for its normal's x.
bool ContactsWithin::is_before(const Contact& a, const Contact& b) noexcept {
  if (a.triangle == b.triangle) return false;
  const PreparedTriangle &first = question_.triangles[a.triangle], &other = question_.triangles[b.triangle];
  if (std::abs(a.distance - b.distance) > error_) return a.distance < b.distance;
  if (!question_.decides_exactly)
    return Candidate{a.distance, first.index} < Candidate{b.distance, other.index};
  if (!is_scaled_) {
    // The kernel gives the same bits for triangles that share the place that is nearest.
    if (a.normal.x() == b.normal.x()) {
      if (surely_share_nearest(first, other, question_.center)) return first.index < other.index;
    } else if (std::abs(a.distance - b.distance) > error_of_both(first, other, question_.center)) {
      return a.distance < b.distance;
    }
    const std::partial_ordering order = compare(squares_.of(a.triangle, first, question_.center),
                                                squares_.of(b.triangle, other, question_.center));
    if (order == 0) return first.index < other.index;
    if (order != std::partial_ordering::unordered) return order < 0;
  }
  NearestOfTies both(question_.center);
  both.consider(first);
  both.consider(other);
  exact_decisions_ += both.exact_decisions();
  return both.nearest() == &first;
}

void ContactsWithin::consider(std::uint32_t slot, const Offset& offset, Work& work) noexcept {
  const PreparedTriangle& triangle = question_.triangles[slot];
  const double distance = distance_to(triangle, offset);
  if (!is_within(triangle, distance, work)) return;
  const Contact contact{offset.vector, Vec3(offset.squared, 0, 0), distance, slot};
  keep_first(question_.into, count_++, contact,
             [this](const Contact& a, const Contact& b) { return is_before(a, b); });
}

/// These are the bits that `nearest` gives of the nearest triangle.
Contact ContactsWithin::finished(const Contact& kept) noexcept {
  const PreparedTriangle& triangle = question_.triangles[kept.triangle];
  if (question_.decides_exactly && (is_scaled_ || !is_certain(kept.distance, question_.reach, error_))) {
    NearestOfTies only(question_.center);
    only.consider(triangle);
    const std::optional<Contact> contact = only.contact(question_.reach, error(), question_.ids);
    exact_decisions_ += only.exact_decisions();
    if (contact) return *contact;
  }
  return contact_at(triangle, question_.center, {kept.point, kept.normal.x()}, question_.ids[triangle.index]);
}

std::size_t ContactsWithin::finish(Work& work) noexcept {
  const std::span<Contact> kept = question_.into.first(std::min(count_, question_.into.size()));
  std::sort(kept.begin(), kept.end(), [this](const Contact& a, const Contact& b) { return is_before(a, b); });
  if (!kept.empty()) nearest_ = {kept.front().triangle, kept.front().distance / scale_};
  for (Contact& contact : kept) contact = finished(contact);
  work.exact_decisions += exact_decisions_;
  return count_;
}

}  // namespace touchmark
