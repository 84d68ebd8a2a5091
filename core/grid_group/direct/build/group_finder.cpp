#include "core/grid_group/direct/build/group_finder.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace touchmark::grid {
namespace {

/// Beyond the sides by this part of the inradius: more keeps a sliding probe longer with one group, and makes
/// the groups larger.
constexpr double growth = 0.3;
/// Over and under the triangle by this part of its size at first, and by less where the groups would be too
/// large.
constexpr double first_height = 1.0, min_height = 0.2, shrinking = 0.6;
constexpr double lowest_height = first_height * shrinking * shrinking * shrinking;
static_assert(lowest_height > min_height &&
              first_height * shrinking * shrinking * shrinking * shrinking < min_height &&
              GroupFinder::max_looks >= 2 * 4);

// Of a ball about the triangle the grown triangle is within 1.6 radii, its size below 1.65, so the highest
// prism within 3.25; and no point of that is farther than 2.25 from the triangle. What is nearest there comes
// into 5.5.
static_assert(growth <= 0.3 && first_height <= 1 && GroupFinder::reach_in_radii >= 6);

bool can_shrink(double height, const FaceFrame& face_frame) noexcept {
  return shrinking * height >= min_height * face_frame.size;
}

}  // namespace

GroupFinder::Found GroupFinder::find(std::uint32_t slot) noexcept {
  const FaceFrame face_frame(store_.exact[slot], store_.frame);
  // A margin that single precision does not see would cover no point.
  const bool visible =
      growth * face_frame.inradius > static_cast<double>(store_.frame.plane_error(face_frame.incenter));
  if (face_frame.normal.isZero(0) || !visible) return {};
  if (effort_.shares && slot < passed_over_until_) return {};
  boxes_seen_ = 0;
  const double height = find_members(slot, face_frame);
  if (member_count_ == 0) {
    fail(slot);
    return {};
  }
  failures_ = 0;
  for (std::size_t i = member_count_; i < Groups::rounded_up(member_count_); ++i)
    members_[i] = members_[member_count_ - 1];
  // Rounded down, so that single precision covers no point outside.
  constexpr double down = 1 - 0x1p-22;
  return {{members_.data(), member_count_},
          static_cast<float>(height * down),
          static_cast<float>(growth * face_frame.inradius * down)};
}

/// Passes over the slots to come, at last until the fourth block from here on.
void GroupFinder::fail(std::uint32_t slot) noexcept {
  constexpr std::uint32_t block = TriangleStore::block_size;
  ++failures_;
  if (failures_ < block) return;
  const std::uint32_t blocks = failures_ > hopeless ? 4 : failures_ > (block + hopeless) / 2 ? 2 : 1;
  passed_over_until_ = (slot / block + blocks) * block;
}

Work GroupFinder::take_work() noexcept { return std::exchange(work_, Work{}); }

/// Leaves the members of the highest prism with no more than many, or of the lowest; none when the mesh is
/// too dense there. Returns the prism's height. Neighbours are alike: higher than one step above the last two
/// prisms it is only tried where there are few members.
double GroupFinder::find_members(std::uint32_t slot, const FaceFrame& face_frame) noexcept {
  const double start = std::min(first_height, std::max(heights_[0], heights_[1]) / shrinking);
  double height = find_below(slot, face_frame, start);
  if (start < first_height && height > 0 && member_count_ <= Groups::many_members / 2)
    height = find_below(slot, face_frame, first_height);
  heights_ = {heights_[1], height > 0 ? height : shrinking * lowest_height};
  return height * face_frame.size;
}

/// Does so with prisms that are at most so high, in sizes of the triangle, and returns its height in these.
double GroupFinder::find_below(std::uint32_t slot, const FaceFrame& face_frame, double start) noexcept {
  member_count_ = 0;
  for (double height = start * face_frame.size;; height *= shrinking) {
    const Prism prism(face_frame, growth, height, exclusion_margin_, store_.frame);
    Aabb box;
    for (const Vec3& corner : face_frame.grown(growth)) {
      box.extend(corner + height * face_frame.normal);
      box.extend(corner - height * face_frame.normal);
    }
    if (gather(slot, face_frame, box.padded(prism.farthest() + exclusion_margin_)))
      return select_members(slot, face_frame, prism, height) / face_frame.size;
    if (!can_shrink(height, face_frame)) return 0;
  }
}

/// Lowers the prism as soon as it has too many members, so that none is looked at twice without need. Returns
/// the height, or 0, without members, if there are too many even in the lowest prism.
double GroupFinder::select_members(std::uint32_t own, const FaceFrame& face_frame, const Prism& highest,
                                   double height) noexcept {
  constexpr std::size_t look = Prism::triangles_a_look;
  work_.triangles += near_.size;
  const std::size_t open_count = open_by_balls(near_, highest.corner_limits(), store_.balls[own], open_);
  // Copies of the last, for the last look.
  if (open_count > 0) std::fill_n(&open_[open_count], look, open_[open_count - 1]);
  Prism prism = highest;
  for (std::size_t at = 0; at < open_count; at += look) {
    add_members(prism, &open_[at], std::min(look, open_count - at));
    while (member_count_ > Groups::many_members && can_shrink(height, face_frame)) {
      height *= shrinking;
      prism = Prism(face_frame, growth, height, exclusion_margin_, store_.frame);
      keep_members(prism);
    }
    if (member_count_ > Groups::max_members) {
      member_count_ = 0;
      return 0;
    }
  }
  return height;
}

/// Adds those of the slots that the prism cannot do without. A whole look of them is read.
void GroupFinder::add_members(const Prism& prism, const std::uint32_t* slots, std::size_t count) noexcept {
  const unsigned excluded = prism.excluded(slots, store_.planes.data(), store_.balls.data());
  for (std::size_t i = 0; i < count; ++i) {
    members_[member_count_] = slots[i];
    member_count_ += ~excluded >> i & 1;
  }
}

/// Leaves those that the prism cannot do without: what a higher prism can do without, a lower one can.
void GroupFinder::keep_members(const Prism& prism) noexcept {
  constexpr std::size_t look = Prism::triangles_a_look;
  const std::size_t count = std::exchange(member_count_, 0);
  work_.triangles += count;
  for (std::size_t at = 0; at < count; at += look) {
    std::array<std::uint32_t, look> slots;
    for (std::size_t i = 0; i < look; ++i) slots[i] = members_[std::min(at + i, count - 1)];
    add_members(prism, slots.data(), std::min(look, count - at));
  }
}

}  // namespace touchmark::grid
