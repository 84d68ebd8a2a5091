#include "core/grid_group/direct/nearest_search.h"

#include <algorithm>
#include <bit>
#include <cassert>

namespace touchmark::grid {
namespace {

using Wide = Lanes;
using simd::max;
Wide square_root(Wide x) noexcept { return simd::sqrt(x); }
#include "core/grid_group/direct/ball_bound.inl"

bool several(std::uint64_t bits) noexcept { return (bits & (bits - 1)) != 0; }

}  // namespace

GroupBounds NearestSearch::filter(std::span<const std::uint32_t> members) const noexcept {
  return filter_group(store_.planes.data(), members.data(), members.size(), point_);
}

float NearestSearch::consider_group(std::span<const std::uint32_t> members) noexcept {
  triangles_ += members.size();
  const GroupBounds bounds = filter(members);
  if (bounds.least > limit_) return bounds.least;
  if (bounds.over_face) {
    // There the distance is the height, to within two plane errors: one of the filter and one for the kernel.
    const float high = bounds.height + 2 * point_.plane_error;
    if (high < enough_high_) {
      within_ = store_.frame.from_frame_rounded_up(high);
      slot_ = bounds.guess;
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
  if (bounds.over_face && !several(left)) {
    slot_ = members[static_cast<std::size_t>(std::countr_zero(left))];
    found_ = true;
    over_face_ = slot_ == bounds.guess && store_.fourth_powers_fit;
    return bounds.least;
  }
  if (bounds.over_face) decide(bounds.guess);
  for (; left != 0; left &= left - 1) {
    const std::uint32_t slot = members[static_cast<std::size_t>(std::countr_zero(left))];
    if (slot != bounds.guess) decide(slot);
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
  for (std::uint64_t others = left; others != 0; others &= others - 1)
    if (ball_excludes(members[static_cast<std::size_t>(std::countr_zero(others))]))
      left &= ~(others & -others);
  return left;
}

/// Triangles that were not compared in double were all farther for certain.
const PreparedTriangle& NearestSearch::exactly_nearest(std::uint64_t& exact_decisions) const noexcept {
  if (!known_) return store_.exact[slot_];
  NearestOfTies ties(center_);
  candidates_.pass_to(ties);
  exact_decisions += candidates_.exact_decisions() + ties.exact_decisions();
  return *ties.nearest();
}

bool NearestSearch::decide_last(double squared) noexcept {
  if (!known_) leave_open(slot_, squared);
  decide_open();
  return touches();
}

/// Decides before there is no more room: a point on the border of very many then ends at the first that
/// touches.
void NearestSearch::leave_open(std::uint32_t slot, double squared) noexcept {
  if (touches() || !(std::abs(std::sqrt(squared) - radius_) <= error_)) return;
  open_[open_count_++] = slot;
  if (open_count_ == open_.size()) decide_open();
}

/// Ends the search at the first that is within the radius, if there is one.
void NearestSearch::decide_open() noexcept {
  if (!is_within_) is_within_.emplace(center_, radius_, error_);
  for (const std::uint32_t slot : std::span(open_).first(open_count_)) {
    const double distance = std::sqrt(widest_offset_from(store_.exact[slot], center_).squared);
    if (!(*is_within_)(store_.exact[slot], distance, exact_decisions_)) continue;
    slot_ = slot;
    within_ = distance;
    enough_ = std::numeric_limits<double>::infinity();
    break;
  }
  open_count_ = 0;
}

#if TOUCHMARK_TRACING
/// Notes those that exist.
void NearestSearch::note_boxes(const EightBoxes& boxes) const {
  if (visits == nullptr) return;
  visits->frame = &store_.frame;
  const std::array<Lanes, 2> bounds = lower_bounds(boxes, point_);
  for (std::uint32_t i = 0; i < BoxTree::arity; ++i) {
    const auto corner = [&](const Lanes(&side)[3][2]) {
      return Vec3(double{side[0][i / 4][i % 4]}, double{side[1][i / 4][i % 4]},
                  double{side[2][i / 4][i % 4]});
    };
    const Vec3 min = corner(boxes.min), max = corner(boxes.max);
    if ((min.array() <= max.array()).all() && max.allFinite())
      visits->note_in_frame(min, max, bounds[i / 4][i % 4] <= limit_);
  }
}
#endif

std::uint32_t NearestSearch::closest_of(std::span<const std::uint32_t> members) noexcept {
  triangles_ += members.size();
  return filter(members).guess;
}

bool NearestSearch::ball_excludes(std::uint32_t slot) const noexcept {
  const TrianglePlanes& t = store_.planes[slot];
  const Lanes zero = {0, 0, 0, 0};
  const Lanes face = zero + (((t.x[0] * point_.x + t.y[0] * point_.y) + t.z[0] * point_.z) + t.offset[0]);
  const Lanes distance = simd::max(face, -face);
  const Lanes height = simd::max(distance - point_.plane_error, zero);
  const Lanes excess = simd::max(beyond_ball(store_.balls[slot], zero + point_.x, zero + point_.y,
                                             zero + point_.z, distance, point_.plane_error),
                                 zero);
  return (height * height + excess * excess)[0] > limit_;
}

}  // namespace touchmark::grid
