#include "core/scene/body_tree.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "core/simd/lanes.h"

namespace touchmark {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

float rounded_down(double x) noexcept {
  const auto near = static_cast<float>(x);
  return static_cast<double>(near) <= x ? near : std::nextafter(near, -infinity);
}
float rounded_up(double x) noexcept { return -rounded_down(-x); }

}  // namespace

/// A region in the boxes' frame, and what rounding it may cost. In single precision, as the boxes are.
class BodyTree::Region {
 public:
  Region(const Aabb& region, const Vec3& origin) noexcept {
    const Vec3 min = region.min - origin, max = region.max - origin;
    // The differences are off by a double's rounding, and as floats by one of theirs, which is the greater.
    pad_ = 0x1p-22 * (min.cwiseAbs().sum() + max.cwiseAbs().sum()) + 0x1p-120;
    // In the fourth lane nothing exceeds anything.
    for (int k = 0; k < 3; ++k) {
      min_[k + 1] = static_cast<float>(min[k]);
      max_[k] = static_cast<float>(max[k]);
    }
  }
  float squared_distance(const Box& box) const noexcept {
    static_assert(sizeof(Box) == 6 * sizeof(float));
    // The minimum and one more number; one more and the maximum.
    const Lanes low = load(box.min.data()), high = load(&box.min[2]);
    const Lanes above = low - max_, below = min_ - high, zero{};
    // What is no number is no excess.
    const Lanes over = above > zero ? above : zero, under = below > zero ? below : zero;
    const Lanes squares = over * over + under * under;
    return (squares[0] + squares[1]) + (squares[2] + squares[3]);
  }
  /// Returns what squared_distance of a box within the limit cannot exceed: each excess is off by a rounding
  /// and its square, relatively, by six.
  float squared_limit(double limit) const noexcept {
    const double padded = (limit + pad_) * (1 + 0x1p-20);
    const double squared = padded * padded + 0x1p-120;
    if (!(limit >= 0)) return -1;
    return squared < 0x1p127 ? static_cast<float>(squared * (1 + 0x1p-23)) : infinity;
  }

 private:
  Lanes min_ = broadcast(-infinity), max_ = broadcast(infinity);
  double pad_;
};

std::uint64_t BodyTree::walk(const Aabb& region, double limit, void* object,
                             double (*visit)(void*, std::uint32_t) noexcept) const noexcept {
  struct Pending {
    Ref ref;
    float squared;
  };
  std::uint64_t boxes = 0;
  if (root_ == none) return boxes;
  const Region seen(region, *origin_);
  std::array<Pending, max_height> stack;
  std::size_t count = 0;
  float squared_limit = seen.squared_limit(limit);
  Ref next = root_;
  while (true) {
    while (!is_leaf(next)) {
      const Node& node = nodes_[next];
      boxes += 2;
      const float first = seen.squared_distance(box(node.child[0]));
      const float second = seen.squared_distance(box(node.child[1]));
      const std::size_t nearer = second < first ? 1 : 0;
      const float least = std::min(first, second), greatest = std::max(first, second);
      if (!(least <= squared_limit)) break;
      if (greatest <= squared_limit) stack[count++] = {node.child[1 - nearer], greatest};
      next = node.child[nearer];
    }
    if (is_leaf(next)) squared_limit = seen.squared_limit(visit(object, body_of(next)));
    do {
      if (count == 0) return boxes;
      next = stack[--count].ref;
    } while (!(stack[count].squared <= squared_limit));
  }
}

BodyTree::Box BodyTree::united(const Box& a, const Box& b) noexcept {
  Box result;
  for (std::size_t k = 0; k < 3; ++k) {
    result.min[k] = std::min(a.min[k], b.min[k]);
    result.max[k] = std::max(a.max[k], b.max[k]);
  }
  return result;
}

float BodyTree::half_area(const Box& box) noexcept {
  const float x = box.max[0] - box.min[0], y = box.max[1] - box.min[1], z = box.max[2] - box.min[2];
  return x * y + y * z + z * x;
}

BodyTree::Box BodyTree::rounded_outward(const Aabb& bounds) const noexcept {
  Box result;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    // The difference from the origin is off by one rounding, which is far less than a float's.
    const double low = bounds.min[k] - (*origin_)[k], high = bounds.max[k] - (*origin_)[k];
    // What is no number, infinity less infinity, may be anywhere.
    result.min[i] = std::isnan(low) ? -infinity : rounded_down(low - 0x1p-52 * std::abs(low));
    result.max[i] = std::isnan(high) ? infinity : rounded_up(high + 0x1p-52 * std::abs(high));
  }
  return result;
}

void BodyTree::reserve(std::size_t bodies) {
  leaves_.reserve(bodies);
  nodes_.reserve(bodies);
}

BodyTree::Ref BodyTree::take_node() {
  if (free_ == none) {
    nodes_.emplace_back();
    return static_cast<Ref>(nodes_.size() - 1);
  }
  return std::exchange(free_, nodes_[free_].parent);
}

bool BodyTree::holds(std::uint32_t body, const Aabb& bounds) const noexcept {
  const Box& outer = leaves_[body].box;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double low = bounds.min[k] - (*origin_)[k], high = bounds.max[k] - (*origin_)[k];
    // By more than the rounding of the differences, or not at all.
    if (!(double{outer.min[i]} <= low - 0x1p-52 * std::abs(low) &&
          high + 0x1p-52 * std::abs(high) <= double{outer.max[i]}))
      return false;
  }
  return true;
}

/// Goes down to the child whose box grows least, as long as that costs less than to be a sibling here.
BodyTree::Ref BodyTree::sibling_for(const Box& added) const noexcept {
  Ref ref = root_;
  while (!is_leaf(ref)) {
    const Node& node = nodes_[ref];
    const float area = half_area(node.box), joined = half_area(united(node.box, added));
    const float inherited = joined - area;  // what each box above grows by
    std::array<float, 2> cost;
    for (std::size_t i = 0; i < 2; ++i) {
      const Box& child = box(node.child[i]);
      cost[i] = half_area(united(child, added)) + inherited - (is_leaf(node.child[i]) ? 0 : half_area(child));
    }
    if (joined < cost[0] && joined < cost[1]) break;
    ref = node.child[cost[1] < cost[0] ? 1 : 0];
  }
  return ref;
}

void BodyTree::replace_child(Ref of_parent, Ref from, Ref to) noexcept {
  if (of_parent == none) {
    root_ = to;
  } else {
    Node& node = nodes_[of_parent];
    node.child[node.child[0] == from ? 0 : 1] = to;
  }
}

void BodyTree::insert(std::uint32_t body, const Aabb& bounds, double margin) {
  if (!origin_) origin_ = bounds.center().allFinite() ? bounds.center() : Vec3::Zero();
  if (body >= leaves_.size()) leaves_.resize(std::size_t{body} + 1);
  leaves_[body].box = rounded_outward(bounds.padded(margin));
  link(body);
}

void BodyTree::insert_as_in(std::uint32_t body, const BodyTree& other) {
  if (!origin_) origin_ = other.origin_;
  if (body >= leaves_.size()) leaves_.resize(std::size_t{body} + 1);
  leaves_[body].box = other.leaves_[body].box;
  link(body);
}

void BodyTree::link(std::uint32_t body) {
  const Ref leaf = body | leaf_bit;
  if (root_ == none) {
    root_ = leaf;
    leaves_[body].parent = none;
    return;
  }
  const Ref above = take_node();
  const Ref sibling = sibling_for(leaves_[body].box);
  const Ref upper = parent(sibling);
  nodes_[above].parent = upper;
  nodes_[above].child = {sibling, leaf};
  replace_child(upper, sibling, above);
  parent(sibling) = above;
  parent(leaf) = above;
  repair(above);
}

void BodyTree::remove(std::uint32_t body) noexcept {
  const Ref leaf = body | leaf_bit, above = leaves_[body].parent;
  if (above == none) {
    root_ = none;
    return;
  }
  Node& node = nodes_[above];
  const Ref sibling = node.child[node.child[0] == leaf ? 1 : 0], upper = node.parent;
  replace_child(upper, above, sibling);
  parent(sibling) = upper;
  node.parent = std::exchange(free_, above);
  repair(upper);
}

void BodyTree::update(Ref ref) noexcept {
  Node& node = nodes_[ref];
  node.box = united(box(node.child[0]), box(node.child[1]));
  node.height = 1 + std::max(height_of(node.child[0]), height_of(node.child[1]));
}

void BodyTree::repair(Ref node) noexcept {
  while (node != none) {
    node = balanced(node);
    update(node);
    node = nodes_[node].parent;
  }
}

BodyTree::Ref BodyTree::balanced(Ref ref) noexcept {
  const Node& node = nodes_[ref];
  const int difference = height_of(node.child[1]) - height_of(node.child[0]);
  if (difference > 1) return rotate(ref, 1);
  if (difference < -1) return rotate(ref, 0);
  return ref;
}

/// Puts the higher child in the node's place, and gives the node its lower child. Returns the child.
BodyTree::Ref BodyTree::rotate(Ref ref, std::size_t high) noexcept {
  Node& node = nodes_[ref];
  const Ref raised = node.child[high];
  Node& top = nodes_[raised];
  const std::size_t low = height_of(top.child[0]) < height_of(top.child[1]) ? 0 : 1;
  const Ref given = top.child[low];
  replace_child(node.parent, ref, raised);
  top.parent = node.parent;
  node.parent = raised;
  top.child[low] = ref;
  node.child[high] = given;
  parent(given) = ref;
  update(ref);
  return raised;
}

}  // namespace touchmark
