// Lists the triangles within a ball (plane_list.h), included at the end of traversal.inl. No triangle is
// measured: the planes of the blocks bound them well enough.

/// Adds those of a block that are within the limit, squared, and may write a block's worth beyond.
template <class List>
static void add_near(const Parts& tree, ChildRef ref, const Point& p, float limit, Wide& unseen,
                     List& list) noexcept {
  const TriangleBlock& block = tree.blocks[ref.index()];
  alignas(64) std::array<float, width> bound, x, y, z;
  const unsigned near = within(
      [&](std::size_t at) {
        const Planes face = planes_at(block, 0, at, p);
        Planes side = planes_at(block, 1, at, p);
        for (std::size_t k = 2; k < 4; ++k) {
          const Planes other = planes_at(block, k, at, p);
          const WideBits is_farther = other.value > side.value;
          side.x = is_farther ? other.x : side.x;
          side.y = is_farther ? other.y : side.y;
          side.z = is_farther ? other.z : side.z;
          side.value = is_farther ? other.value : side.value;
        }
        const Wide height = max(max(face.value, -face.value) - p.plane_error, Wide{});
        const Wide excess = max(side.value - p.plane_error, Wide{});
        const Wide squared = height * height + excess * excess;
        const Wide distance = square_root(squared);
        const Wide inverse = distance > 0 ? 1 / distance : Wide{};
        const Wide along = (face.value < 0 ? -height : height) * inverse, across = excess * inverse;
        store(bound.data() + at, distance);
        store(x.data() + at, along * face.x + across * side.x);
        store(y.data() + at, along * face.y + across * side.y);
        store(z.data() + at, along * face.z + across * side.z);
        return squared;
      },
      limit, unseen);
  compress(list.slot + list.count, slots_in(ref).data(), near);
  compress(list.bound + list.count, bound.data(), near);
  compress(list.x + list.count, x.data(), near);
  compress(list.y + list.count, y.data(), near);
  compress(list.z + list.count, z.data(), near);
  list.count += static_cast<std::uint32_t>(std::popcount(near));
}

/// Lists what is within the limit of the point, squared. Returns false where there is too much of it, or
/// where `work` comes to more than the budget.
template <class List>
static bool list_near(const Parts& tree, const FilterPoint& point, float limit, std::uint64_t budget,
                      List& list, Work& work) noexcept {
  const Point p = broadcast(point);
  Wide unseen = Wide{} + farthest;
  // First come, first served: what is fetched ahead has time to arrive.
  std::array<ChildRef, List::max_queue> queue;
  std::size_t count = 1;
  queue[0] = ChildRef{0};
  for (std::size_t next = 0; next < count; ++next) {
    if (work.spheres + work.triangles > budget) return false;
    if (queue[next].is_block()) {
      work.triangles += width;
      add_near(tree, queue[next], p, limit, unseen, list);
      if (list.count > List::capacity) return false;
      continue;
    }
    if (count + width > queue.size()) return false;
    const Node& node = tree.nodes[node_of(tree, queue[next], work)];
    unsigned near =
        within([&](std::size_t at) { return child_bounds(tree.boxes, node, at, p); }, limit, unseen);
    work.spheres += width;
    if constexpr (tracing) note_children(tree.boxes, node, 0, near);
    while (near != 0) {
      const ChildRef child = node.child[pop_lowest(near)];
      prefetch(tree, child);
      queue[count++] = child;
    }
  }
  list.unlisted = reduce_min(unseen);
  return true;
}
