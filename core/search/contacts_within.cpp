#include "core/search/contacts_within.h"

#include <algorithm>
#include <cmath>
#include <compare>
#include <cstddef>
#include <limits>
#include <optional>

#include "core/exact/distance_predicates.h"
#include "core/geometry/distance_error.h"
#include "core/search/ties/certified_nearest.h"
#include "core/search/ties/shared_nearest.h"

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

inline bool ContactsWithin::is_before(const Found& a, const Found& b) noexcept {
  if (std::abs(a.distance - b.distance) > error_) return a.distance < b.distance;
  return is_before_as_near(a, b);
}

bool ContactsWithin::is_before_as_near(const Found& a, const Found& b) noexcept {
  if (a.slot == b.slot) return false;
  const PreparedTriangle &first = question_.triangles[a.slot], &other = question_.triangles[b.slot];
  if (!question_.decides_exactly || ran_out())
    return Candidate{a.distance, first.index} < Candidate{b.distance, other.index};
  if (!is_scaled_) {
    // The kernel gives the same bits for triangles that share the place that is nearest.
    if (a.squared == b.squared) {
      if ((a.offset == b.offset && surely_share_corner(first, other, question_.center, a.offset)) ||
          surely_share_nearest(first, other, question_.center))
        return first.index < other.index;
    } else if (std::abs(a.distance - b.distance) > error_of_both(first, other, question_.center)) {
      return a.distance < b.distance;
    }
    const std::partial_ordering order =
        compare(squares_.of(a.slot, first, question_.center), squares_.of(b.slot, other, question_.center));
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
  ++count_;
  if (question_.into.empty() || distance > farthest_kept_) return;
  const Found found{offset.vector, offset.squared, distance, slot};
  if (question_.into.size() > max_asked_for) return keep(found);
  if (gathered_count_ == gathered_.size()) drop_farther();
  gathered_[gathered_count_++] = found;
}

/// Meanwhile a contact in `into` has the triangle's slot for its id, the offset for its point, and the
/// offset's square for its normal's x.
ContactsWithin::Found ContactsWithin::found_of(const Contact& kept) noexcept {
  return {kept.point, kept.normal.x(), kept.distance, kept.triangle};
}

void ContactsWithin::keep(const Found& found) noexcept {
  keep_first(question_.into, kept_count_++,
             {found.offset, Vec3(found.squared, 0, 0), found.distance, found.slot},
             [&](const Contact& a, const Contact& b) { return is_before(found_of(a), found_of(b)); });
  if (kept_count_ >= question_.into.size())
    farthest_kept_ = std::min(farthest_kept_, question_.into.front().distance + error_);
}

void ContactsWithin::keep_gathered() noexcept {
  for (const Found& found : std::span(gathered_).first(gathered_count_)) keep(found);
  gathered_count_ = 0;
}

/// Leaves of those gathered what may be among the nearest that are asked for: these come before what is
/// farther by more than the error. Where that is most of them, they are told apart exactly.
void ContactsWithin::drop_farther() noexcept {
  const std::size_t asked_for = question_.into.size();
  const auto begin = gathered_.begin(), end = begin + static_cast<std::ptrdiff_t>(gathered_count_);
  if (kept_count_ == 0 && gathered_count_ > asked_for) {
    const auto last = begin + static_cast<std::ptrdiff_t>(asked_for - 1);
    std::nth_element(begin, last, end,
                     [](const Found& a, const Found& b) { return a.distance < b.distance; });
    farthest_kept_ = std::min(farthest_kept_, last->distance + error_);
    const auto left =
        std::remove_if(last + 1, end, [&](const Found& a) { return a.distance > farthest_kept_; });
    gathered_count_ = static_cast<std::size_t>(left - begin);
  }
  constexpr std::size_t room = 4;
  if (gathered_count_ + room > gathered_.size()) keep_gathered();
}

/// These are the bits that `nearest` gives of the nearest triangle.
Contact ContactsWithin::finished(const Found& kept) noexcept {
  const PreparedTriangle& triangle = question_.triangles[kept.slot];
  if (question_.decides_exactly && !ran_out() &&
      (is_scaled_ || !is_certain(kept.distance, question_.reach, error_))) {
    NearestOfTies only(question_.center);
    only.consider(triangle);
    const std::optional<Contact> contact = only.contact(question_.reach, error(), question_.ids);
    exact_decisions_ += only.exact_decisions();
    if (contact) return *contact;
  }
  return contact_at(triangle, question_.center, {kept.offset, kept.squared}, question_.ids[triangle.index]);
}

/// Sorts by doubles, which leave few out of order as a rule, and then exactly: each is compared with little
/// more than the one before it. Many that are about as near, as around the middle of a ball, are sorted anew.
template <class Kept>
void ContactsWithin::sort(std::span<Kept> kept) noexcept {
  std::sort(kept.begin(), kept.end(), [this](const Kept& one, const Kept& other) {
    const Found &a = found_of(one), &b = found_of(other);
    if (a.distance != b.distance) return a.distance < b.distance;
    if (a.squared != b.squared) return a.squared < b.squared;
    return question_.triangles[a.slot].index < question_.triangles[b.slot].index;
  });
  const auto comes_before = [this](const Kept& a, const Kept& b) {
    return is_before(found_of(a), found_of(b));
  };
  constexpr std::size_t moves_a_contact = 4;
  std::size_t moves = 0;
  for (std::size_t i = 1; i < kept.size(); ++i) {
    if (!comes_before(kept[i], kept[i - 1])) continue;
    const Kept moved = kept[i];
    std::size_t at = i;
    for (; at > 0 && comes_before(moved, kept[at - 1]); --at, ++moves) kept[at] = kept[at - 1];
    kept[at] = moved;
    if (moves <= moves_a_contact * kept.size()) continue;
    // As a heap: an order that changes when decisions run out must lead nowhere outside.
    std::make_heap(kept.begin(), kept.end(), comes_before);
    std::sort_heap(kept.begin(), kept.end(), comes_before);
    return;
  }
}

std::size_t ContactsWithin::finish(Work& work, std::uint64_t max_decisions) noexcept {
  max_decisions_ = max_decisions;
  if (gathered_count_ > question_.into.size()) drop_farther();
  const auto end_with = [&](auto kept) {
    sort(kept);
    if (!kept.empty()) nearest_ = {found_of(kept.front()).slot, kept.front().distance / scale_};
    for (std::size_t i = 0; i < std::min(kept.size(), question_.into.size()); ++i)
      question_.into[i] = finished(found_of(kept[i]));
  };
  if (kept_count_ == 0) {
    end_with(std::span(gathered_).first(gathered_count_));
  } else {
    keep_gathered();
    end_with(question_.into.first(std::min(kept_count_, question_.into.size())));
  }
  work.exact_decisions += exact_decisions_;
  return count_;
}

}  // namespace touchmark
