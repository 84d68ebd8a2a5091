/// The first touch along a straight path, through the hierarchy of boxes.
#include <bit>
#include <cstddef>
#include <cstdint>
#include <span>

#include "core/geometry/distance_error.h"
#include "core/geometry/sweep_box.h"
#include "core/grid_group/direct/direct_grid.h"
#include "core/search/first_touch.h"
#include "core/search/tracing.h"
#include "core/simd/lanes.h"

namespace touchmark::grid {
namespace {

/// The earliest hit among the triangles it comes by.
class SweepSearch {
 public:
  /// The store's frame covers both ends.
  SweepSearch(const TriangleStore& store, const Sweep& sweep, double padded_radius) noexcept
      : store_(store),
        in_frame_{store.frame.scale() * (sweep.from - store.frame.origin()),
                  store.frame.scale() * (sweep.to - store.frame.origin()), 0},
        start_(store.frame.point(sweep.from)),
        length_((sweep.to - sweep.from).norm()),
        padded_radius_(padded_radius),
        first_(sweep) {}

  const FirstTouch& first() const noexcept { return first_; }

  /// Considers the members of a group that covers the whole path.
  void consider_group(std::span<const std::uint32_t> members, Work& work) noexcept {
    work.triangles += members.size();
    const std::uint32_t* const slot = members.data();  // readable up to a multiple of four
    for (std::size_t at = 0; at < members.size(); at += 4) {
      const Lanes bounds = lower_bounds(store_.planes[slot[at]], store_.planes[slot[at + 1]],
                                        store_.planes[slot[at + 2]], store_.planes[slot[at + 3]], start_);
      for (unsigned left = at_most(bounds, within()); left != 0; left &= left - 1)
        consider(slot[at + static_cast<std::size_t>(std::countr_zero(left))], work);
    }
  }

  /// Considers what the path meets in the tree. Returns false when it has tested more than `budget` triangles
  /// and boxes before the end.
  bool consider_tree(const BoxTree& tree, std::uint64_t budget, Work& work) noexcept {
    const std::uint64_t before = work.boxes + work.triangles;
    BoxStack stack;
    visit(tree, static_cast<std::uint32_t>(tree.levels()) - 1, 0, stack, work);
    while (!stack.empty()) {
      if (work.boxes + work.triangles - before > budget) return false;
      const BoxStack::Entry next = stack.pop();
      // The bound may have been rounded up to single precision, where that is denormal by 2^-149.
      if (static_cast<double>(next.bound) > first_.limit() * (1 + 0x1p-22) + 0x1p-149) continue;
      if (next.level > 0) {
        visit(tree, next.level - 1, next.index, stack, work);
      } else {
        consider_block(next.index, work);
      }
    }
    return true;
  }

 private:
  /// Pushes the children that the path meets, the first met on top.
  void visit(const BoxTree& tree, std::uint32_t level, std::uint32_t index, BoxStack& stack,
             Work& work) const noexcept {
    const EightBoxes& node = tree.node(level, index);
    const double padded_radius = store_.frame.scale() * padded_radius_;
    const std::size_t base = stack.size();
    work.boxes += BoxTree::arity;
    for (std::uint32_t child = 0; child < BoxTree::arity; ++child) {
      Aabb box;
      for (std::size_t k = 0; k < 3; ++k) {
        box.min[static_cast<int>(k)] = static_cast<double>(node.min[k][child / 4][child % 4]);
        box.max[static_cast<int>(k)] = static_cast<double>(node.max[k][child / 4][child % 4]);
      }
      const double enter = enters(box, in_frame_, padded_radius, first_.limit());
      if constexpr (tracing) note_box(box, enter <= first_.limit());
      if (enter <= first_.limit())
        stack.insert(base, {static_cast<float>(enter), index * BoxTree::arity + child, level});
    }
  }

  /// What is farther from the path's start than its length can't be met.
  float within() const noexcept {
    const double farthest = length_ * first_.limit() * (1 + 0x1p-40) + padded_radius_;
    return store_.frame.limit(farthest * farthest);
  }

  void consider_block(std::uint32_t block, Work& work) noexcept {
    const std::uint32_t first = block * TriangleStore::block_size;
    work.triangles += TriangleStore::block_size;
    for (std::uint32_t at = first; at < first + TriangleStore::block_size; at += 4) {
      const TrianglePlanes* planes = &store_.planes[at];
      const Lanes bounds = lower_bounds(planes[0], planes[1], planes[2], planes[3], start_);
      for (unsigned left = at_most(bounds, within()); left != 0; left &= left - 1)
        consider(at + static_cast<std::uint32_t>(std::countr_zero(left)), work);
    }
  }

  /// Notes a box that exists.
  void note_box(const Aabb& box, bool entered) const {
    if (visits == nullptr || !(box.min.array() <= box.max.array()).all() || !box.max.allFinite()) return;
    visits->frame = &store_.frame;
    visits->note_in_frame(box.min, box.max, entered);
  }

  void consider(std::uint32_t slot, Work& work) noexcept {
    first_.consider(store_.exact[slot], slot, work.exact_decisions);
  }

  const TriangleStore& store_;
  Sweep in_frame_;
  FilterPoint start_;
  double length_;
  double padded_radius_;
  FirstTouch first_;
};

}  // namespace

/// Takes the touch by value: if its address were passed on, the search that holds it would be kept out of
/// registers.
std::optional<Impact> DirectGrid::impact_of(FirstTouch first, DirectMemory& memory,
                                            Work& work) const noexcept {
  return touchmark::impact_of(first, store_.exact, store_.ids, certified_,
                              [&](double reach) { return nearest(first.sweep().from, reach, memory, work); });
}

std::optional<Impact> DirectGrid::first_hit(const Sweep& sweep, DirectMemory& memory,
                                            Work& work) const noexcept {
  const double difference = largest_difference(bounds_, sweep);
  if (!fourth_powers_fit(difference)) return fallback().first_hit(sweep, work);
  if (!(store_.frame.covers(sweep.from) && store_.frame.covers(sweep.to))) return far_first_hit(sweep, work);
  const double padded_radius = padded_sweep_radius(sweep, difference);
  const double farthest = (sweep.to - sweep.from).norm() * (1 + 0x1p-40) + padded_radius;
  if (is_clear(sweep.from, farthest, memory)) return std::nullopt;
  const FilterPoint from = store_.frame.point(sweep.from);
  if (rejects_at_start(sweep.from, from, farthest, memory)) return std::nullopt;
  const Start start = start_at(sweep.from, from, farthest, memory, work);
  if (start.beyond) return std::nullopt;
  const std::uint64_t before = work.total();
  SweepSearch search(store_, sweep, padded_radius);
  // A group is valid in a convex region: it covers the path between two points that it covers.
  if (start.group != nullptr && group_covering(start.slot, store_.frame.point(sweep.to), work) != nullptr) {
    search.consider_group(groups_.members(*start.group), work);
  } else if (!search.consider_tree(tree_, work_budget(store_.size()), work)) {
    return impact_of(fallback().first_touch(sweep, work), memory, work);
  } else {
    build_lazily(search.first().found() ? search.first().slot() : start.slot, start.slot, sweep.from,
                 work.total() - before, work);
  }
  if (search.first().found()) memory.slot = search.first().slot();
  return impact_of(search.first(), memory, work);
}

std::optional<Impact> DirectGrid::far_first_hit(const Sweep& sweep, Work& work) const noexcept {
  ++work.boxes;
  if (enters(bounds_, sweep, padded_sweep_radius(sweep, largest_difference(bounds_, sweep)), 1) > 1)
    return std::nullopt;
  DirectMemory memory;
  return impact_of(fallback().first_touch(sweep, work), memory, work);
}

}  // namespace touchmark::grid
