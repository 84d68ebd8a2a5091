// The search itself, written once and included once an instruction set (traversal.h), in a class that defines
// Wide, a vector of `lanes` floats, its square_root, to_bits and compress, and the kernel. The same operations
// in the same order, so that all visit the same nodes and give the same bits.

static Wide load(const float* from) noexcept {
  Wide values;
  std::memcpy(&values, from, sizeof values);
  return values;
}
static void store(float* to, Wide values) noexcept { std::memcpy(to, &values, sizeof values); }
static Wide max(Wide a, Wide b) noexcept { return a > b ? a : b; }
static Wide min(Wide a, Wide b) noexcept { return a < b ? a : b; }

struct Point {
  Wide x, y, z, plane_error;
};

/// Lower bounds of the squared distances to the children's bounding boxes.
template <class Volumes>
static Wide box_bounds(const Volumes& node, std::size_t at, const Point& p) noexcept {
  const Wide x = p.x - load(node.x() + at), y = p.y - load(node.y() + at), z = p.z - load(node.z() + at);
  const Wide beyond_x = max(max(x, -x) - load(node.half_x() + at) - p.plane_error, Wide{});
  const Wide beyond_y = max(max(y, -y) - load(node.half_y() + at) - p.plane_error, Wide{});
  const Wide beyond_z = max(max(z, -z) - load(node.half_z() + at) - p.plane_error, Wide{});
  return beyond_x * beyond_x + beyond_y * beyond_y + beyond_z * beyond_z;
}

/// Lower bounds of the squared distances to the children's bounding cylinders. The height over the slab and
/// the excess beyond the radius are orthogonal, so their squares add up.
template <class Volumes>
static Wide cylinder_bounds(const Volumes& node, std::size_t at, const Point& p) noexcept {
  const Wide x = p.x - load(node.x() + at), y = p.y - load(node.y() + at), z = p.z - load(node.z() + at);
  const Wide along =
      x * load(node.normal_x() + at) + y * load(node.normal_y() + at) + z * load(node.normal_z() + at);
  const Wide squared = x * x + y * y + z * z;
  const Wide across = square_root(max(squared * difference_pad - along * along, Wide{}));
  const Wide height = max(max(along, -along) - load(node.half_height() + at) - p.plane_error, Wide{});
  const Wide excess = max(across - load(node.radius() + at) - p.plane_error, Wide{});
  return height * height + excess * excess;
}

template <class Volumes>
static Wide child_bounds(bool boxes, const Volumes& node, std::size_t at, const Point& p) noexcept {
  return boxes ? box_bounds(node, at, p) : cylinder_bounds(node, at, p);
}

/// A plane of each triangle: its normal, and its value at the point.
struct Planes {
  Wide x, y, z, value;
};

static Planes planes_at(const TriangleBlock& block, std::size_t k, std::size_t at, const Point& p) noexcept {
  const Wide x = load(block.x[k] + at), y = load(block.y[k] + at), z = load(block.z[k] + at);
  return {x, y, z, ((p.x * x + p.y * y) + p.z * z) + load(block.offset[k] + at)};
}

static Wide cosine_between(const Planes& a, const Planes& b) noexcept {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}

/// Squared, and times the square of the sine: how far what is s beyond one side and t beyond the next is from
/// the corner between them.
static Wide off_corner(Wide s, Wide t, Wide cosine) noexcept {
  return (s * s + t * t) - (cosine + cosine) * (s * t);
}

/// Lower bounds of the squared distances to the triangles: the plane filter of core/search/plane_filter/plane_filter.h
/// on plain arrays.
static Wide triangle_bounds(const TriangleBlock& block, std::size_t at, const Point& p) noexcept {
  const Wide face = planes_at(block, 0, at, p).value;
  const Wide side = max(planes_at(block, 1, at, p).value,
                        max(planes_at(block, 2, at, p).value, planes_at(block, 3, at, p).value));
  const Wide height = max(max(face, -face) - p.plane_error, Wide{});
  const Wide excess = max(side - p.plane_error, Wide{});
  return height * height + excess * excess;
}

/// Returns lower bounds that use what is known beyond corners, for twice as many instructions. What is s
/// beyond a side with the outward normal n and t beyond the next one with m, in the face's plane, with t > s c
/// and s > t c for c = n.m, is nearest to where these meet: s^2 + (t - s c)^2 / (1 - c^2) away, squared.
static Wide corner_bounds(const TriangleBlock& block, std::size_t at, const Point& p) noexcept {
  const Wide face = planes_at(block, 0, at, p).value;
  std::array<Planes, 3> side;
  for (std::size_t i = 0; i < 3; ++i) side[i] = planes_at(block, i + 1, at, p);
  const Wide excess = max(max(side[0].value, max(side[1].value, side[2].value)) - p.plane_error, Wide{});
  Wide across = excess * excess;
  for (std::size_t i = 0; i < 3; ++i) {
    const Planes &one = side[i], &other = side[i == 2 ? 0 : i + 1];
    const Wide cosine = cosine_between(one, other);
    // With s the greater of the two the second condition follows from the first, but for rounding.
    const Wide s = max(one.value, other.value), t = min(one.value, other.value);
    const Wide past_tip = (t - s * cosine) - tip_margin * p.plane_error, beyond = max(s - p.plane_error, Wide{});
    const Wide squared = beyond * beyond + past_tip * past_tip / ((1 + sine_error) - cosine * cosine);
    across = past_tip > 0 ? max(across, squared) : across;
  }
  const Wide height = max(max(face, -face) - p.plane_error, Wide{});
  return height * height + across * corner_factor;
}

/// Returns those of a block's triangles that are surely within a distance, as distance_upper_bound of
/// core/search/plane_filter/plane_filter.h tells.
static unsigned surely_within(const TriangleBlock& block, float distance, const Point& p) noexcept {
  unsigned near = 0;
  for (std::size_t at = 0; at < width; at += lanes) {
    const Wide face = planes_at(block, 0, at, p).value;
    const Wide height = max(face, -face);
    std::array<Planes, 3> side;
    for (std::size_t i = 0; i < 3; ++i) side[i] = planes_at(block, i + 1, at, p);
    const Wide side_excess = max(side[0].value, max(side[1].value, side[2].value));
    WideBits found = (height <= distance - 2 * p.plane_error) & (side_excess <= -p.plane_error);
    const Wide remaining = distance - corner_pad * p.plane_error;
    const Wide across_limit = remaining > 0 ? remaining * remaining - height * height : Wide{} - 1;
    for (std::size_t i = 0; i < 3; ++i) {
      const std::size_t j = i == 2 ? 0 : i + 1;
      const Wide cosine = cosine_between(side[i], side[j]);
      const Wide squared = off_corner(side[i].value, side[j].value, cosine);
      found |= (squared * corner_excess <= across_limit * (1 - cosine * cosine)) & (cosine < 0) &
               (cosine > sharpest_cosine);
    }
    near |= to_bits(found) << at;
  }
  return near;
}

static Point broadcast(const FilterPoint& p) noexcept {
  return {Wide{} + p.x, Wide{} + p.y, Wide{} + p.z, Wide{} + p.plane_error};
}

/// Returns those that are at most the limit, as bits; `unseen` falls to the least of the others.
static unsigned split(Wide bounds, float limit, Wide& unseen) noexcept {
  const WideBits is_near = bounds <= limit;
  const Wide kept = is_near ? unseen : bounds;
  unseen = unseen < kept ? unseen : kept;
  return to_bits(is_near);
}

/// Returns those of eight bounds that are at most the limit, as bits; `unseen` falls to the least of the
/// others.
template <class Bounds>
static unsigned within(const Bounds& bounds_at, float limit, Wide& unseen) noexcept {
  unsigned near = 0;
  for (std::size_t at = 0; at < width; at += lanes) near |= split(bounds_at(at), limit, unseen) << at;
  return near;
}

static float reduce_min(Wide values) noexcept {
  float least = values[0];
  for (std::size_t i = 1; i < lanes; ++i) least = values[i] < least ? values[i] : least;
  return least;
}

/// A node's lines, or as many of a block.
static void prefetch(const Parts& tree, ChildRef ref) noexcept {
  const void* const start = ref.is_block() ? static_cast<const void*>(&tree.blocks[ref.index()])
                                           : static_cast<const void*>(&tree.nodes[ref.index()]);
  prefetch_lines(start, sizeof(Node));
}

static void prefetch(const PreparedTriangle& triangle) noexcept {
  prefetch_lines(&triangle, sizeof triangle);
}

/// Returns the node of a child that is none of the blocks.
static std::uint32_t node_of(const Parts& tree, ChildRef ref, Work& work) noexcept {
  return ref.is_part() ? built_part(tree, ref.index(), work) : ref.index();
}

/// Takes the lowest bit off and returns its number.
static std::uint32_t pop_lowest(unsigned& bits) noexcept {
  const auto lowest = static_cast<std::uint32_t>(std::countr_zero(bits));
  bits &= bits - 1;
  return lowest;
}

/// Returns the slots of a block's triangles.
static std::array<std::uint32_t, width> slots_in(ChildRef block) noexcept {
  std::array<std::uint32_t, width> slots;
  for (std::uint32_t k = 0; k < width; ++k) slots[k] = block.index() * width + k;
  return slots;
}

/// Returns the offset of a point from the triangle in a slot.
static Offset offset_at(const Parts& tree, std::uint32_t slot, const Vec3& point) noexcept {
  if constexpr (tracing) note_triangle(tree.triangles[slot].index);
  return kernel(tree.triangles[slot], point);
}

template <class Visitor>
static void visit(const Parts& tree, std::uint32_t slot, Visitor& visitor) noexcept {
  if constexpr (tracing)
    if (visitor.accepts(slot)) note_triangle(tree.triangles[slot].index);
  if (visitor.accepts(slot)) visitor.update(slot, kernel(tree.triangles[slot], visitor.center));
}

/// Does the visitor know without the kernel that the triangle is as far as the nearest?
template <class Visitor>
static bool takes_as_far(std::uint32_t at, Visitor& visitor) noexcept {
  if constexpr (requires { visitor.takes_as_far(at); }) return visitor.takes_as_far(at);
  return false;
}

/// Shows the visitor what a block has within its limit. Returns true where that ends the search.
template <class Visitor>
[[gnu::always_inline]] static inline bool visit_block(const Parts& tree, std::uint32_t index, const Point& p,
                                               Wide& unseen, Visitor& visitor) noexcept {
  const TriangleBlock& block = tree.blocks[index];
  const bool far = visitor.limit > tree.far;
  alignas(64) std::array<float, width> bound;
  unsigned near = within(
      [&](std::size_t at) {
        const Wide bounds = far ? corner_bounds(block, at, p) : triangle_bounds(block, at, p);
        store(bound.data() + at, bounds);
        return bounds;
      },
      visitor.limit, unseen);
  visitor.work.triangles += width;
  if (near == 0) return false;
  if constexpr (requires { visitor.update_within(index); }) {
    if (unsigned sure = surely_within(block, visitor.enough, p); sure != 0) {
      visitor.update_within(index * width + pop_lowest(sure));
      return true;
    }
  }
  for (unsigned left = near; left != 0;) prefetch(tree.triangles[index * width + pop_lowest(left)]);
  // The most promising one first: it may be nearer than others can be.
  unsigned left = near;
  std::uint32_t first = pop_lowest(left);
  while (left != 0) {
    const std::uint32_t other = pop_lowest(left);
    first = bound[other] < bound[first] ? other : first;
  }
  const auto show = [&](std::uint32_t k) {
    const std::uint32_t slot = index * width + k;
    if (!(far && bound[k] > visitor.limit * nearly && takes_as_far(slot, visitor))) visit(tree, slot, visitor);
  };
  show(first);
  near &= ~(1U << first);
  near &= within([&](std::size_t at) { return load(bound.data() + at); }, visitor.limit, unseen);
  while (near != 0) show(pop_lowest(near));
  return false;
}

/// Finds a node's children within the visitor's limit. The nearest is the next: on the stack it would have to be
/// written and read again at once. The others go there, the nearer the later. Returns false where there is none.
template <class Visitor>
[[gnu::always_inline]] static inline bool enter_node(const Parts& tree, const Node& node, const Point& p,
                                              Wide& unseen, Visitor& visitor, StackEntry& next,
                                              std::array<StackEntry, max_stack>& stack,
                                              std::size_t& count) noexcept {
  alignas(64) std::array<float, width> bound;
  unsigned near = within(
      [&](std::size_t at) {
        const Wide bounds = child_bounds(tree.boxes, node, at, p);
        store(bound.data() + at, bounds);
        return bounds;
      },
      visitor.limit, unseen);
  visitor.work.spheres += width;
  if constexpr (tracing) note_children(tree.boxes, node, 0, near);
  if (near == 0) return false;
  const std::uint32_t first = pop_lowest(near);
  prefetch(tree, node.child[first]);
  next = {bound[first], node.child[first]};
  const std::size_t base = count;
  while (near != 0) {
    const std::uint32_t child = pop_lowest(near);
    prefetch(tree, node.child[child]);
    StackEntry other{bound[child], node.child[child]};
    if (other.bound <= next.bound) std::swap(other, next);
    std::size_t at = count++;
    for (; at > base && stack[at - 1].bound < other.bound; --at) stack[at] = stack[at - 1];
    stack[at] = other;
  }
  return true;
}

/// Returns the least of some bounds and those of what waits.
[[gnu::cold, gnu::noinline]] static float least_bound(float bound, std::span<const StackEntry> waiting) noexcept {
  for (const StackEntry& entry : waiting) bound = std::min(bound, entry.bound);
  return bound;
}

/// Shows the visitor every triangle that may be within its limit, nearest volumes first. Returns a lower
/// bound of the squared distance to what it was not shown, or `exhausted` when the visitor's work has come to
/// more than `budget` before the end. Never inlined: whoever mostly answers without it would pay for its
/// frame.
template <class Visitor>
[[gnu::noinline]] static float traverse(const Parts& tree, const FilterPoint& point, std::uint64_t budget,
                                 Visitor& visitor) noexcept {
  const Point p = broadcast(point);
  Wide unseen = Wide{} + farthest;
  std::array<StackEntry, max_stack> stack;
  std::size_t count = 0;
  StackEntry next{0, ChildRef{0}};
  for (;;) {
    if (next.bound > visitor.limit) {
      unseen = min(unseen, Wide{} + next.bound);
    } else if (visitor.work.spheres + visitor.work.triangles > budget) {
      if constexpr (requires { visitor.left; })
        visitor.left = least_bound(std::min(reduce_min(unseen), next.bound), {stack.data(), count});
      return exhausted;
    } else if (next.ref.is_block()) {
      if (visit_block(tree, next.ref.index(), p, unseen, visitor)) break;
    } else if (enter_node(tree, tree.nodes[node_of(tree, next.ref, visitor.work)], p, unseen, visitor, next, stack,
                          count)) {
      continue;
    }
    if (count == 0) break;
    next = stack[--count];
  }
  return reduce_min(unseen);
}

/// Which children are blocks, as bits.
static unsigned blocks_of(const Node& node) noexcept {
  unsigned blocks = 0;
  for (std::size_t at = 0; at < width; at += lanes) {
    WideBits child;
    std::memcpy(&child, node.child + at, sizeof child);
    blocks |= to_bits(child < 0) << at;
  }
  return blocks;
}

/// Lists the leaves within the list's covered radius. Returns false when there are too many, or too many nodes,
/// or after `budget` spheres.
static bool list_leaves(const Parts& tree, const FilterPoint& point, std::uint64_t budget, LeafList& list,
                        Work& work) noexcept {
  const Point p = broadcast(point);
  const float limit = list.covered_radius * list.covered_radius * (1 + 0x1p-20F);
  Wide unseen = Wide{} + farthest;
  // First come, first served: what is fetched ahead has time to arrive.
  std::array<std::uint32_t, LeafList::max_nodes> stack;
  std::size_t count = 1;
  stack[0] = 0;
  for (std::size_t next = 0; next < count; ++next) {
    if (work.spheres > budget || count + width > stack.size()) return false;
    const Node& node = tree.nodes[stack[next]];
    const unsigned near = within([&](std::size_t at) { return child_bounds(tree.boxes, node, at, p); }, limit, unseen);
    work.spheres += width;
    if constexpr (tracing) note_children(tree.boxes, node, 0, near);
    const unsigned blocks = near & blocks_of(node);
    for (unsigned deeper = near & ~blocks; deeper != 0;) {
      const ChildRef child = node.child[pop_lowest(deeper)];
      prefetch(tree, child);
      stack[count++] = node_of(tree, child, work);
    }
    if (blocks == 0) continue;
    const auto more = static_cast<std::uint32_t>(std::popcount(blocks));
    if (list.count + more > LeafList::capacity) return false;
    for (std::size_t k = 0; k < Node::rows; ++k)
      compress(list.leaves.row(k) + list.count, node.row(k), blocks);
    compress(list.leaves.child + list.count, node.child, blocks);
    list.count += more;
  }
  list.finish();
  return true;
}

/// Puts those of the blocks' triangles that may be within the limit one after the other; returns how many.
static std::size_t filter(const Parts& tree, std::span<const ChildRef> blocks, const Point& p, float limit,
                          Wide& unseen, std::uint32_t* left) noexcept {
  std::size_t count = 0;
  for (const ChildRef ref : blocks) {
    const TriangleBlock& block = tree.blocks[ref.index()];
    const unsigned near =
        within([&](std::size_t at) { return triangle_bounds(block, at, p); }, limit, unseen);
    compress(left + count, slots_in(ref).data(), near);
    count += static_cast<std::size_t>(std::popcount(near));
  }
  return count;
}

/// Shows the visitor those of the leaves' triangles that may be within the limit, looking closely at corners,
/// the most promising one first: it is often nearer than the others can be. Apart from the loop for what is
/// near, which has no register to spare.
template <class Visitor>
[[gnu::noinline]] static void visit_far(const Parts& tree, std::span<const ChildRef> blocks, const Point& p,
                                 Wide& unseen, Visitor& visitor) noexcept {
  std::array<std::uint32_t, LeafList::padded_capacity * width> left;
  std::array<float, LeafList::padded_capacity * width> bound;
  std::size_t count = 0;
  for (const ChildRef ref : blocks) {
    const TriangleBlock& block = tree.blocks[ref.index()];
    alignas(64) std::array<float, width> bounds;
    const unsigned near = within(
        [&](std::size_t at) {
          const Wide some = corner_bounds(block, at, p);
          store(bounds.data() + at, some);
          return some;
        },
        visitor.limit, unseen);
    compress(left.data() + count, slots_in(ref).data(), near);
    compress(bound.data() + count, bounds.data(), near);
    count += static_cast<std::size_t>(std::popcount(near));
  }
  if (count == 0) return;
  for (std::size_t k = 0; k < count; ++k) prefetch(tree.triangles[left[k]]);
  std::size_t first = 0;
  for (std::size_t k = 1; k < count; ++k) first = bound[k] < bound[first] ? k : first;
  const auto show = [&](std::size_t k) {
    if (!(bound[k] > visitor.limit * nearly && takes_as_far(left[k], visitor))) visit(tree, left[k], visitor);
  };
  show(first);
  float skipped = farthest;
  for (std::size_t k = 0; k < count; ++k) {
    if (k == first) continue;
    if (bound[k] > visitor.limit)
      skipped = std::min(skipped, bound[k]);
    else
      show(k);
  }
  unseen = min(unseen, Wide{} + skipped);
}

/// Searches as traverse does when every triangle within the visitor's limit is in one of the blocks.
template <class Visitor>
static float search_blocks(const Parts& tree, const FilterPoint& point, std::span<const ChildRef> blocks,
                           Visitor& visitor) noexcept {
  const Point p = broadcast(point);
  Wide unseen = Wide{} + farthest;
  for (const ChildRef ref : blocks) visit_block(tree, ref.index(), p, unseen, visitor);
  return reduce_min(unseen);
}

/// Searches as traverse does when every triangle within the visitor's limit is in a listed leaf. `moved` is
/// how far the point is from the list's centre. It goes in passes, so that no call and no branch on what was
/// found interrupts the wide arithmetic.
template <class Visitor>
static float search_leaves(const Parts& tree, const FilterPoint& point, const LeafList& list, float moved,
                    std::uint64_t budget, Visitor& visitor) noexcept {
  const Point p = broadcast(point);
  const float limit = visitor.limit;
  Wide unseen = Wide{} + farthest;
  // What the filters let through is packed, not looped over: how much that is no branch predictor knows.
  std::array<ChildRef, LeafList::padded_capacity> blocks;
  std::size_t block_count = 0;
  for (std::uint32_t first = 0; first < list.count; first += width) {
    const unsigned near =
        within([&](std::size_t at) { return child_bounds(tree.boxes, list.leaves, first + at, p); }, limit, unseen);
    if constexpr (tracing) note_children(tree.boxes, list.leaves, first, near);
    compress(blocks.data() + block_count, list.leaves.child + first, near);
    block_count += static_cast<std::size_t>(std::popcount(near));
    visitor.work.spheres += width;
  }
  visitor.work.triangles += block_count * width;
  if (visitor.work.spheres + visitor.work.triangles > budget) return exhausted;
  for (std::size_t i = 0; i < block_count; ++i) prefetch(tree, blocks[i]);
  const std::span<const ChildRef> near_blocks(blocks.data(), block_count);
  if (limit > tree.far) {
    visit_far(tree, near_blocks, p, unseen, visitor);
  } else {
    std::array<std::uint32_t, LeafList::padded_capacity * width> left;
    const std::size_t left_count = filter(tree, near_blocks, p, limit, unseen, left.data());
    for (std::size_t k = 0; k < left_count; ++k) prefetch(tree.triangles[left[k]]);
    // Few are left as a rule. Where there are more, it is often for a corner that they have.
    constexpr std::size_t few = 6;
    for (std::size_t k = 0; k < left_count; ++k)
      if (k < few || !takes_as_far(left[k], visitor)) visit(tree, left[k], visitor);
  }
  const float covered_radius = std::max(list.covered_radius - moved, 0.0F);
  return std::min(covered_radius * covered_radius, reduce_min(unseen));
}

#include "core/bvh/kept_nearest.inl"
#include "core/bvh/limited_point.inl"
#include "core/bvh/list_near.inl"
#include "core/bvh/plane_list.inl"
#include "core/bvh/sweep_search.inl"
#include "core/bvh/swept_ball.inl"
