// The search of the tree of bodies' boxes, included once for each set of instructions by body_tree_search.cpp:
// `Wide` are `lanes` floats, and to_bits says which of their comparisons hold.

/// Returns the squared distances of so many children's boxes, from this one on.
inline Wide squared_distances(const Region& region, const Node& node, std::size_t first) noexcept {
  Wide sum{};
  for (std::size_t k = 0; k < 3; ++k) {
    Wide min, max;
    std::memcpy(&min, &node.min[k][first], sizeof min);
    std::memcpy(&max, &node.max[k][first], sizeof max);
    const Wide above = min - region.max[k], below = region.min[k] - max;
    // One of them at most exceeds 0. What is no number does not.
    const Wide greater = above > below ? above : below;
    const Wide excess = greater > Wide{} ? greater : Wide{};
    sum += excess * excess;
  }
  return sum;
}

inline std::uint64_t walk(std::span<const Node> nodes, Ref root, const Region& region, double limit,
                          const Visit& visit) noexcept {
  struct Pending {
    Ref ref;
    float squared;
    std::uint32_t height;  ///< over bodies: 0 of a body itself
  };
  std::uint64_t boxes = 0;
  std::array<Pending, max_height * (width - 1) + 1> stack;
  std::size_t count = 0;
  float squared_limit = region.squared_limit(limit);
  Pending next{root, 0, nodes[root].level + 1U};
  while (true) {
    if (next.height == 0) {
      squared_limit = region.squared_limit(visit.call(visit.object, next.ref));
    } else {
      const Node& node = nodes[next.ref];
      const std::size_t first = count;
      boxes += node.count;
      std::array<float, width> squared;
      std::uint32_t within = 0;
      for (std::uint32_t i = 0; i < width; i += lanes) {
        const Wide distances = squared_distances(region, node, i);
        std::memcpy(&squared[i], &distances, sizeof distances);
        within |= to_bits(distances <= squared_limit) << i;
      }
      within &= (1U << node.count) - 1;
      if (std::has_single_bit(within)) {
        const auto i = static_cast<std::uint32_t>(std::countr_zero(within));
        next = {node.child[i], squared[i], next.height - 1};
        continue;
      }
      // The nearest on top.
      for (; within != 0; within &= within - 1) {
        const auto i = static_cast<std::uint32_t>(std::countr_zero(within));
        std::size_t at = count++;
        for (; at > first && stack[at - 1].squared < squared[i]; --at) stack[at] = stack[at - 1];
        stack[at] = {node.child[i], squared[i], next.height - 1};
      }
    }
    do {
      if (count == 0) return boxes;
      next = stack[--count];
    } while (!(next.squared <= squared_limit));
  }
}
