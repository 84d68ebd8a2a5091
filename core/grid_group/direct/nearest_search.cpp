#include "core/grid_group/direct/nearest_search.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace touchmark::grid {
namespace {

bool several(std::uint64_t bits) noexcept { return (bits & (bits - 1)) != 0; }

}  // namespace

GroupBounds NearestSearch::filter(std::span<const std::uint32_t> members) const noexcept {
  return filter_group(store_.planes.data(), members.data(), members.size(), point_);
}

float NearestSearch::consider_group(std::span<const std::uint32_t> members) noexcept {
  triangles_ += members.size();
  const GroupBounds bounds = filter(members);
  if (bounds.least > limit_) return bounds.least;
  if (bounds.over_one) {
    // There the distance is the height, to within two tau: one of the filter and one for the kernel.
    const float high = bounds.height + 2 * point_.tau;
    if (high < enough_high_) {
      within_ = store_.frame.at_least(high);
      place_ = bounds.guess;
      found_ = true;
      return bounds.least;
    }
    limit_ = std::min(limit_, high * high * (1 + 0x1p-20f));
  } else {
    decide(bounds.guess);
  }
  std::uint64_t left = within_limit(bounds, members.size());
  if (several(left)) left = without_far_balls(left, members);
  // A limit from outside, below every height, may leave members whose planes fall short but balls do not.
  if (left == 0) return bounds.least;
  if (bounds.over_one && !several(left)) {
    place_ = members[static_cast<std::size_t>(std::countr_zero(left))];
    found_ = true;
    over_face_ = place_ == bounds.guess && store_.fourth_powers_fit;
    return bounds.least;
  }
  if (bounds.over_one) decide(bounds.guess);
  for (; left != 0; left &= left - 1) {
    const std::uint32_t place = members[static_cast<std::size_t>(std::countr_zero(left))];
    if (place != bounds.guess) decide(place);
  }
  return bounds.least;
}

std::uint64_t NearestSearch::within_limit(const GroupBounds& bounds, std::size_t members) const noexcept {
  assert(members > 0 && members <= 64);
  std::uint64_t left = 0;
  for (std::size_t at = 0; at < members; at += 4)
    left |= std::uint64_t{at_most(bounds.squared[at / 4], limit_)} << at;
  return left & (~std::uint64_t{0} >> (64 - members));  // without the copies of the last
}

std::uint64_t NearestSearch::without_far_balls(std::uint64_t left,
                                               std::span<const std::uint32_t> members) const noexcept {
  for (std::uint64_t rest = left; rest != 0; rest &= rest - 1)
    if (ball_excludes(members[static_cast<std::size_t>(std::countr_zero(rest))])) left &= ~(rest & -rest);
  return left;
}

/// Where what was found was never taken, the others were all farther for certain.
const PreparedTriangle& NearestSearch::exactly_nearest(std::uint64_t& exact_decisions) const noexcept {
  if (!known_) return store_.exact[place_];
  NearestOfTies ties(center_);
  so_far_.show(ties);
  exact_decisions += so_far_.exact_decisions() + ties.exact_decisions();
  return *ties.nearest();
}

bool NearestSearch::decide_last(double squared) noexcept {
  if (!known_) leave_open(place_, squared);
  decide_open();
  return touches();
}

/// Decides before there is no more room: a point on the border of very many then ends at the first that
/// touches.
void NearestSearch::leave_open(std::uint32_t place, double squared) noexcept {
  if (touches() || !(std::abs(std::sqrt(squared) - radius_) <= error_)) return;
  open_[open_count_++] = place;
  if (open_count_ == open_.size()) decide_open();
}

/// Ends the search at the first that is within the radius, if there is one.
void NearestSearch::decide_open() noexcept {
  if (!is_within_) is_within_.emplace(center_, radius_, error_);
  for (const std::uint32_t place : std::span(open_).first(open_count_)) {
    const double distance = std::sqrt(exact_offset(store_.exact[place], center_).squared);
    if (!(*is_within_)(store_.exact[place], distance, exact_decisions_)) continue;
    place_ = place;
    within_ = distance;
    enough_ = std::numeric_limits<double>::infinity();
    break;
  }
  open_count_ = 0;
}

std::uint32_t NearestSearch::closest_of(std::span<const std::uint32_t> members) noexcept {
  triangles_ += members.size();
  return filter(members).guess;
}

bool NearestSearch::ball_excludes(std::uint32_t place) const noexcept {
  const TrianglePlanes& t = store_.planes[place];
  const Lanes zero = {0, 0, 0, 0};
  const Lanes face = zero + (((t.x[0] * point_.x + t.y[0] * point_.y) + t.z[0] * point_.z) + t.offset[0]);
  const Lanes distance = greater_of(face, -face);
  const Lanes height = greater_of(distance - point_.tau, zero);
  const Lanes excess = greater_of(beyond_ball(store_.balls[place], zero + point_.x, zero + point_.y,
                                              zero + point_.z, distance, point_.tau),
                                  zero);
  return (height * height + excess * excess)[0] > limit_;
}

}  // namespace touchmark::grid
