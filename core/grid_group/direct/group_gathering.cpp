// How a GroupFinder gathers what is near.
#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>

#include "core/grid_group/direct/group_finder.h"
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
