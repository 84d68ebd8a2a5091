#include "core/grid_group/direct/group_finder.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>

#include "core/simd/lanes.h"

namespace touchmark::grid {

/// A box rounded inwards: to compare its sides with other floats is to compare those of the box itself.
struct GroupFinder::FloatBounds {
  explicit FloatBounds(const Aabb& box) noexcept {
    constexpr float infinity = std::numeric_limits<float>::infinity();
    for (std::size_t k = 0; k < 3; ++k) {
      const double low = box.min[static_cast<int>(k)], high = box.max[static_cast<int>(k)];
      min[k] = static_cast<float>(low);
      if (static_cast<double>(min[k]) < low) min[k] = std::nextafter(min[k], infinity);
      max[k] = static_cast<float>(high);
      if (static_cast<double>(max[k]) > high) max[k] = std::nextafter(max[k], -infinity);
    }
  }

  std::array<float, 3> min, max;
};

namespace {

using FloatBounds = GroupFinder::FloatBounds;

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

Lanes load(const float* from) noexcept {
  Lanes lanes;
  std::memcpy(&lanes, from, sizeof lanes);
  return lanes;
}

/// Which of eight children have boxes that are not apart from another, and which of these lie in it.
struct ChildrenIn {
  unsigned reaching, within;
};

ChildrenIn children_in(const EightBoxes& boxes, const FloatBounds& box) noexcept {
  unsigned apart = 0, beyond = 0;
  for (std::size_t half = 0; half < 2; ++half) {
    LaneBits is_apart{}, is_beyond{};
    for (std::size_t k = 0; k < 3; ++k) {
      is_apart |= (boxes.min[k][half] > box.max[k]) | (boxes.max[k][half] < box.min[k]);
      is_beyond |= (boxes.min[k][half] < box.min[k]) | (boxes.max[k][half] > box.max[k]);
    }
    apart |= to_bits(is_apart) << (4 * half);
    beyond |= to_bits(is_beyond) << (4 * half);
  }
  return {~apart & 0xffU, ~(apart | beyond) & 0xffU};
}

/// Bit i is set for a ball that reaches into the box, as do those of all triangles that do.
unsigned balls_in(std::span<const TriangleBall, 4> balls, const FloatBounds& box) noexcept {
  const Lanes a = load(&balls[0].x), b = load(&balls[1].x), c = load(&balls[2].x), d = load(&balls[3].x);
  const Lanes ab_low = __builtin_shufflevector(a, b, 0, 4, 1, 5);
  const Lanes ab_high = __builtin_shufflevector(a, b, 2, 6, 3, 7);
  const Lanes cd_low = __builtin_shufflevector(c, d, 0, 4, 1, 5);
  const Lanes cd_high = __builtin_shufflevector(c, d, 2, 6, 3, 7);
  const std::array<Lanes, 3> center = {__builtin_shufflevector(ab_low, cd_low, 0, 1, 4, 5),
                                       __builtin_shufflevector(ab_low, cd_low, 2, 3, 6, 7),
                                       __builtin_shufflevector(ab_high, cd_high, 0, 1, 4, 5)};
  // Coordinates are below 4: their roundings, those of the ball and of the box inwards are below 2^-20.
  const Lanes radius = __builtin_shufflevector(ab_high, cd_high, 2, 3, 6, 7) * (1 + 0x1p-20F) + 0x1p-19F;
  LaneBits apart{};
  for (std::size_t k = 0; k < 3; ++k)
    apart |= (center[k] + radius < box.min[k]) | (center[k] - radius > box.max[k]);
  return ~to_bits(apart) & 0xfU;
}

}  // namespace

GroupFinder::Found GroupFinder::find(std::uint32_t slot) noexcept {
  const FaceFrame face_frame(store_.exact[slot], store_.frame);
  // A margin that single precision does not see would cover no point.
  const bool visible =
      growth * face_frame.inradius > static_cast<double>(store_.frame.plane_error(face_frame.incenter));
  if (face_frame.normal.isZero(0) || !visible) return {};
  if (effort_.shares && failures_ >= TriangleStore::block_size && slot % TriangleStore::block_size != 0)
    return {};
  boxes_seen_ = 0;
  const double height = find_members(slot, face_frame);
  failures_ = member_count_ == 0 ? failures_ + 1 : 0;
  if (member_count_ == 0) return {};
  for (std::size_t i = member_count_; i < Groups::rounded_up(member_count_); ++i)
    members_[i] = members_[member_count_ - 1];
  // Rounded down, so that single precision covers no point outside.
  constexpr double down = 1 - 0x1p-22;
  return {{members_.data(), member_count_},
          static_cast<float>(height * down),
          static_cast<float>(growth * face_frame.inradius * down)};
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
      return select_members(face_frame, prism, height) / face_frame.size;
    if (!can_shrink(height, face_frame)) return 0;
  }
}

/// Lowers the prism as soon as it has too many members, so that none is looked at twice without need. Returns
/// the height, or 0, without members, if there are too many even in the lowest prism.
double GroupFinder::select_members(const FaceFrame& face_frame, const Prism& highest,
                                   double height) noexcept {
  constexpr std::size_t look = Prism::triangles_a_look;
  work_.triangles += near_count_;
  Prism prism = highest;
  std::array<std::uint32_t, 2 * look> open;  // slots that balls leave open
  std::size_t open_count = 0;
  for (std::size_t at = 0; at < near_count_; at += look) {
    const unsigned left = prism.balls_left(&near_x_[at], &near_y_[at], &near_z_[at], &near_radius_[at]);
    const std::size_t count = std::min(look, near_count_ - at);  // behind the last are its copies
    // Which are left no branch predictor knows.
    for (std::size_t i = 0; i < count; ++i) {
      open[open_count] = near_[at + i];
      open_count += left >> i & 1;
    }
    const bool ends = at + look >= near_count_;
    while (open_count >= look || (ends && open_count > 0)) {
      const std::size_t tested = std::min(look, open_count);
      std::fill(open.begin() + static_cast<std::ptrdiff_t>(open_count), open.end(), open[0]);
      add_members(prism, open.data(), tested);
      open_count -= tested;
      std::copy_n(open.begin() + look, look, open.begin());
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
  }
  return height;
}

/// Adds those of the slots that the prism cannot do without. Eight are read.
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

/// Makes near_ hold every triangle that reaches into the box, or says that they are too many.
bool GroupFinder::gather(std::uint32_t slot, const FaceFrame& face_frame, const Aabb& box) noexcept {
  if (gathered_.contains(box.min) && gathered_.contains(box.max)) return true;
  if (effort_.shares && slot >= alone_until_) {
    gathered_ = shared_box(slot, face_frame, box);
    if (gather_blocks(gathered_)) return load_balls(), true;
    alone_until_ = (slot / TriangleStore::block_size + 1) * TriangleStore::block_size;
  }
  gathered_ = box;
  if (gather_blocks(gathered_)) return load_balls(), true;
  gathered_ = Aabb();
  return false;
}

/// Returns a box that probably holds those of the slots behind this one in its block, too.
Aabb GroupFinder::shared_box(std::uint32_t slot, const FaceFrame& face_frame,
                             const Aabb& box) const noexcept {
  Aabb own;
  for (const Vec3& corner : face_frame.corner) own.extend(corner);
  const Vec3 around = (own.min - box.min).cwiseMax(box.max - own.max);
  const float radius = store_.balls[slot].radius;
  const std::uint32_t end =
      std::min((slot / TriangleStore::block_size + 1) * TriangleStore::block_size, store_.size());
  Aabb shared = box;
  for (std::uint32_t other = slot + 1; other < end; ++other) {
    const float larger = store_.balls[other].radius / radius;
    if (larger > 2) continue;
    const Vec3 padding = static_cast<double>(larger) * around;
    for (const Vec3& in_mesh : store_.exact[other].corner) {
      const Vec3 corner = store_.frame.to_frame(in_mesh);
      shared.extend(corner - padding);
      shared.extend(corner + padding);
    }
  }
  return shared;
}

void GroupFinder::load_balls() noexcept {
  constexpr std::size_t look = Prism::triangles_a_look;
  const std::size_t whole = (near_count_ + look - 1) / look * look;
  for (std::size_t i = 0; i < whole; ++i) {
    const TriangleBall& ball = store_.balls[near_[std::min(i, near_count_ - 1)]];
    near_x_[i] = ball.x;
    near_y_[i] = ball.y;
    near_z_[i] = ball.z;
    near_radius_[i] = ball.radius;
  }
}

/// Adds slots whose triangles all reach into the box.
bool GroupFinder::add_near(std::uint64_t first, std::uint64_t count) noexcept {
  const std::uint64_t end = std::min<std::uint64_t>(first + count, store_.size());
  if (near_count_ + (end - first) > std::min<std::uint64_t>(max_near, effort_.max_near)) return false;
  for (std::uint64_t slot = first; slot < end; ++slot)
    near_[near_count_++] = static_cast<std::uint32_t>(slot);
  return true;
}

/// Adds those of a block whose balls reach into the box.
bool GroupFinder::add_block(std::uint32_t block, const FloatBounds& bounds) noexcept {
  const std::uint32_t first = block * TriangleStore::block_size;
  const std::uint32_t end = std::min(first + TriangleStore::block_size, store_.size());
  // Which balls reach into the box no branch predictor knows.
  for (std::uint32_t slot = first; slot < end; slot += 4) {
    const unsigned in = balls_in(std::span(store_.balls).subspan(slot).first<4>(), bounds);
    for (std::uint32_t i = 0; i < 4; ++i) {
      near_[near_count_] = slot + i;
      near_count_ += in >> i & 1;
    }
  }
  return near_count_ <= std::min<std::uint64_t>(max_near, effort_.max_near);
}

bool GroupFinder::gather_blocks(const Aabb& box) noexcept {
  struct Node {
    std::uint32_t level, index;
  };
  const FloatBounds bounds(box);
  near_count_ = 0;
  // As in BoxStack: seven siblings a level, and the last level's eight.
  std::array<Node, 8 * 11> stack;
  std::size_t count = 1;
  stack[0] = {static_cast<std::uint32_t>(tree_.levels()) - 1, 0};
  while (count > 0) {
    const Node node = stack[--count];
    const EightBoxes& boxes = tree_.node(node.level, node.index);
    boxes_seen_ += BoxTree::arity;
    work_.boxes += BoxTree::arity;
    if (boxes_seen_ > effort_.max_boxes) return false;
    const ChildrenIn in = children_in(boxes, bounds);
    const std::uint64_t slots_a_child = std::uint64_t{TriangleStore::block_size} << (3 * node.level);
    for (unsigned left = in.reaching; left != 0; left &= left - 1) {
      const auto i = static_cast<std::uint32_t>(std::countr_zero(left));
      const std::uint32_t child = node.index * BoxTree::arity + i;
      if ((in.within >> i & 1) != 0) {
        if (!add_near(child * slots_a_child, slots_a_child)) return false;
      } else if (node.level > 0) {
        stack[count++] = {node.level - 1, child};
      } else if (!add_block(child, bounds)) {
        return false;
      }
    }
  }
  return true;
}

}  // namespace touchmark::grid
