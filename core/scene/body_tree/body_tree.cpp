#include "core/scene/body_tree/body_tree.h"

#include <algorithm>
#include <array>
#include <cassert>
#include <cmath>
#include <utility>

#include "core/geometry/float_rounding.h"

namespace touchmark {
namespace {

constexpr float infinity = std::numeric_limits<float>::infinity();

/// Returns a difference of differences less what they may be off by.
double surely_between(double low, double high) noexcept {
  const double between = high - low;
  return between < std::numeric_limits<double>::infinity()
             ? between - 0x1p-50 * (std::abs(low) + std::abs(high))
             : between;
}

}  // namespace

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

BodyTree::Box BodyTree::box_of(const Node& node, std::uint32_t slot) noexcept {
  Box box;
  for (std::size_t k = 0; k < 3; ++k) {
    box.min[k] = node.min[k][slot];
    box.max[k] = node.max[k][slot];
  }
  return box;
}

BodyTree::Box BodyTree::box_of_all(const Node& node) noexcept {
  Box box = box_of(node, 0);
  for (std::uint32_t i = 1; i < node.count; ++i) box = united(box, box_of(node, i));
  return box;
}

void BodyTree::set_box(Node& node, std::uint32_t slot, const Box& box) noexcept {
  for (std::size_t k = 0; k < 3; ++k) {
    node.min[k][slot] = box.min[k];
    node.max[k][slot] = box.max[k];
  }
}

BodyTree::Box BodyTree::rounded_outward(const Aabb& bounds) const noexcept {
  Box result;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    // The difference from the origin is off by one rounding, which is far less than a float's.
    double low = bounds.min[k] - (*origin_)[k], high = bounds.max[k] - (*origin_)[k];
    low -= 0x1p-52 * std::abs(low);
    high += 0x1p-52 * std::abs(high);
    // What is no number, infinity less infinity, may be anywhere.
    result.min[i] = std::isnan(low) ? -infinity : rounded_down(low);
    result.max[i] = std::isnan(high) ? infinity : rounded_up(high);
  }
  return result;
}

double BodyTree::room(std::uint32_t body, const Aabb& bounds) const noexcept {
  const Box outer = box_of(body);
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double low = bounds.min[k] - (*origin_)[k], high = bounds.max[k] - (*origin_)[k];
    const double below = surely_between(double{outer.min[i]}, low);
    const double above = surely_between(high, double{outer.max[i]});
    if (!(below >= 0 && above >= 0)) return -1;
    least = std::min({least, below, above});
  }
  return least;
}

void BodyTree::reserve(std::size_t bodies) {
  places_.reserve(bodies);
  // Nodes are about two thirds full.
  nodes_.reserve(bodies / 10 + body_tree::max_height);
}

/// There is no other place that takes memory: what begins to change the tree comes to its end.
void BodyTree::make_room_for(std::uint32_t body) {
  if (body >= places_.size()) places_.resize(std::size_t{body} + 1);
  // A split at every level, and a new root.
  const std::size_t needed = root_ == none ? 1 : nodes_[root_].level + 2U;
  if (free_count_ >= needed) return;
  const std::size_t more = needed - free_count_, size = nodes_.size() + more;
  if (size > nodes_.capacity()) nodes_.reserve(size + size / 16);
  for (std::size_t i = 0; i < more; ++i) {
    nodes_.emplace_back();
    give_back(static_cast<Ref>(nodes_.size() - 1));
  }
}

BodyTree::Ref BodyTree::take_node(std::uint8_t level) noexcept {
  assert(free_ != none);
  --free_count_;
  const Ref taken = std::exchange(free_, nodes_[free_].parent);
  nodes_[taken] = {};
  nodes_[taken].level = level;
  return taken;
}

void BodyTree::give_back(Ref node) noexcept {
  nodes_[node].parent = std::exchange(free_, node);
  ++free_count_;
}

void BodyTree::insert(std::uint32_t body, const Aabb& bounds, double margin) {
  make_room_for(body);
  if (!origin_) origin_ = bounds.center().allFinite() ? bounds.center() : Vec3::Zero();
  link(body, rounded_outward(bounds.padded(margin)));
}

void BodyTree::insert_as_in(std::uint32_t body, const BodyTree& other) {
  make_room_for(body);
  if (!origin_) origin_ = other.origin_;
  link(body, other.box_of(body));
}

void BodyTree::link(std::uint32_t body, const Box& box) {
  if (root_ == none) root_ = take_node(0);
  add(node_for(box), {box, body});
}

BodyTree::Ref BodyTree::node_for(const Box& added) const noexcept {
  Ref ref = root_;
  while (nodes_[ref].level > 0) {
    const Node& node = nodes_[ref];
    std::uint32_t best = 0;
    float min_growth = infinity, min_area = infinity;
    for (std::uint32_t i = 0; i < node.count; ++i) {
      const Box child = box_of(node, i);
      const float area = half_area(child), growth = half_area(united(child, added)) - area;
      if (!(growth < min_growth || (growth == min_growth && area < min_area))) continue;
      best = i;
      min_growth = growth;
      min_area = area;
    }
    ref = node.child[best];
  }
  return ref;
}

void BodyTree::put(Ref ref, std::uint32_t slot, const Entry& entry) noexcept {
  Node& node = nodes_[ref];
  set_box(node, slot, entry.box);
  node.child[slot] = entry.ref;
  if (node.level == 0) {
    places_[entry.ref] = {ref * width + slot};
  } else {
    nodes_[entry.ref].parent = ref;
    nodes_[entry.ref].slot = static_cast<std::uint8_t>(slot);
  }
}

void BodyTree::take_out(Ref ref, std::uint32_t slot) noexcept {
  Node& node = nodes_[ref];
  const std::uint32_t last = --node.count;
  if (slot != last) put(ref, slot, {box_of(node, last), node.child[last]});
}

void BodyTree::update_above(Ref ref) noexcept {
  for (Ref parent = nodes_[ref].parent; parent != none; ref = parent, parent = nodes_[ref].parent) {
    const Box box = box_of_all(nodes_[ref]);
    if (box == box_of(nodes_[parent], nodes_[ref].slot)) return;
    set_box(nodes_[parent], nodes_[ref].slot, box);
  }
}

void BodyTree::add(Ref ref, Entry entry) noexcept {
  while (nodes_[ref].count == width) {
    const Ref other = split(ref, entry);
    const Box box = box_of_all(nodes_[ref]);
    entry = {box_of_all(nodes_[other]), other};
    const Ref parent = nodes_[ref].parent;
    if (parent == none) {
      root_ = take_node(static_cast<std::uint8_t>(nodes_[ref].level + 1));
      append(root_, {box, ref});
      ref = root_;
    } else {
      set_box(nodes_[parent], nodes_[ref].slot, box);
      ref = parent;
    }
  }
  append(ref, entry);
  update_above(ref);
}

/// Cuts between neighbours along an axis, where the halves' areas are least in sum; rather where few are on
/// the side of the one that was added, since bodies often come in order, and where they come there should be
/// room.
BodyTree::Ref BodyTree::split(Ref ref, const Entry& added) noexcept {
  constexpr std::size_t all = width + 1;
  using Entries = std::array<Entry, all>;
  Entries entries;
  for (std::uint32_t i = 0; i < width; ++i) entries[i] = {box_of(nodes_[ref], i), nodes_[ref].child[i]};
  entries[width] = added;
  Entries best = entries;
  std::size_t best_cut = min_of_split;
  float least = infinity;
  for (std::size_t axis = 0; axis < 3; ++axis) {
    // Infinite boxes have no middle; their order does not matter.
    std::array<float, all> middle;
    for (std::size_t i = 0; i < all; ++i) {
      const Entry entry = entries[i];
      const float key = entry.box.min[axis] + entry.box.max[axis];
      std::size_t at = i;
      for (; at > 0 && key < middle[at - 1]; --at) {
        middle[at] = middle[at - 1];
        entries[at] = entries[at - 1];
      }
      middle[at] = key;
      entries[at] = entry;
    }
    std::array<float, all> area_from{};  // of the boxes from this one on
    Box box = entries[all - 1].box;
    for (std::size_t i = all - 1; i >= min_of_split; --i) {
      box = united(box, entries[i].box);
      area_from[i] = half_area(box);
    }
    const auto at_added =
        static_cast<std::size_t>(std::ranges::find(entries, added.ref, &Entry::ref) - entries.begin());
    box = entries[0].box;
    for (std::size_t cut = 1; cut <= all - min_of_split; ++cut) {
      const std::size_t with_added = at_added < cut ? cut : all - cut;
      const float cost = (half_area(box) + area_from[cut]) * (1 + 0x1p-6F * static_cast<float>(with_added));
      if (cut >= min_of_split && cost < least) {
        least = cost;
        best = entries;
        best_cut = cut;
      }
      box = united(box, entries[cut].box);
    }
  }
  const Ref other = take_node(nodes_[ref].level);
  nodes_[ref].count = 0;
  for (std::size_t i = 0; i < all; ++i) append(i < best_cut ? ref : other, best[i]);
  return other;
}

void BodyTree::remove(std::uint32_t body) noexcept {
  const Place place = places_[body];
  Ref ref = place.node();
  take_out(ref, place.slot());
  while (nodes_[ref].parent != none && nodes_[ref].count < fewest) {
    const Ref parent = nodes_[ref].parent;
    join(ref);
    ref = parent;
  }
  update_above(ref);
  // The root has one child at least if that is a body, else two.
  const Node& root = nodes_[root_];
  if (root.count == 0) {
    give_back(std::exchange(root_, none));
  } else if (root.level > 0 && root.count == 1) {
    const Ref child = root.child[0];
    give_back(std::exchange(root_, child));
    nodes_[root_].parent = none;
  }
}

void BodyTree::join(Ref ref) noexcept {
  const Ref parent = nodes_[ref].parent;
  const Node& above = nodes_[parent];
  const Entry orphan{box_of(nodes_[ref], 0), nodes_[ref].child[0]};
  std::uint32_t best = none;
  float min_growth = infinity;
  for (std::uint32_t i = 0; i < above.count; ++i) {
    if (i == nodes_[ref].slot) continue;
    const Box box = box_of(above, i);
    const float growth = half_area(united(box, orphan.box)) - half_area(box);
    if (best != none && !(growth < min_growth)) continue;
    best = i;
    min_growth = growth;
  }
  const Ref sibling = above.child[best];
  if (nodes_[sibling].count < width) {
    append(sibling, orphan);
    set_box(nodes_[parent], best, box_of_all(nodes_[sibling]));
    take_out(parent, nodes_[ref].slot);
    give_back(ref);
    return;
  }
  // Which of them does not matter.
  append(ref, {box_of(nodes_[sibling], width - 1), nodes_[sibling].child[width - 1]});
  take_out(sibling, width - 1);
  set_box(nodes_[parent], best, box_of_all(nodes_[sibling]));
  set_box(nodes_[parent], nodes_[ref].slot, box_of_all(nodes_[ref]));
}

}  // namespace touchmark
