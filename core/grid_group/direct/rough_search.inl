// Lower bounds of squared distances (rough_search.h), included once an instruction set in a namespace of the
// names of wide_rows.h. The same operations on each, so that all bound alike.

/// Bounds the distance to eight boxes from below, in the frame. Bit i is set where it is at most the limit.
inline unsigned near_boxes(const EightBoxes& boxes, const FilterPoint& p, float limit, float* bounds) noexcept {
  const std::array<float, 3> point = {p.x, p.y, p.z};
  unsigned near = 0;
  for (std::size_t at = 0; at < BoxTree::arity; at += lanes) {
    Wide squared{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Wide low = read<Wide>(&boxes.min[k][at / 4]), high = read<Wide>(&boxes.max[k][at / 4]);
      const Wide outside = max(low - point[k], point[k] - high);
      const Wide excess = max(outside - p.plane_error, Wide{});
      squared += excess * excess;
    }
    std::memcpy(bounds + at, &squared, sizeof squared);
    near |= to_bits(squared <= limit) << at;
  }
  return near;
}

/// Does so for the triangles of a block, by their planes.
inline unsigned near_triangles(const TrianglePlanes* planes, const FilterPoint& p, float limit,
                               float* bounds) noexcept {
  const PointLanes point(p);
  unsigned near = 0;
  for (std::size_t at = 0; at < TriangleStore::block_size; at += lanes) {
    std::array<Lanes, lanes> rows;
    for (std::size_t i = 0; i < lanes; ++i) rows[i] = plane_values(planes[at + i], point);
    const std::array<Wide, 4> value = columns(rows);
    const Wide height = max(max(value[0], -value[0]) - p.plane_error, Wide{});
    const Wide excess = max(max(value[1], max(value[2], value[3])) - p.plane_error, Wide{});
    const Wide squared = height * height + excess * excess;
    std::memcpy(bounds + at, &squared, sizeof squared);
    near |= to_bits(squared <= limit) << at;
  }
  return near;
}

inline bool descend(RoughSearch& search, const BoxTree& tree, std::uint64_t budget) noexcept {
  alignas(32) std::array<float, 8> bounds;
  BoxStack stack;
  stack.insert(0, {0, 0, static_cast<std::uint32_t>(tree.levels())});
  while (!stack.empty()) {
    if (search.found().triangles + search.found().boxes > budget) return false;
    const BoxStack::Entry next = stack.pop();
    if (next.bound > search.limit()) continue;
    if (next.level == 0) {
      const std::uint32_t first = next.index * TriangleStore::block_size;
      search.found().triangles += TriangleStore::block_size;
      unsigned left = near_triangles(&search.store().planes[first], search.point(), search.limit(), bounds.data());
      while (left != 0) {
        auto nearest = static_cast<std::uint32_t>(__builtin_ctz(left));
        for (unsigned others = left & (left - 1); others != 0; others &= others - 1) {
          const auto other = static_cast<std::uint32_t>(__builtin_ctz(others));
          if (bounds[other] < bounds[nearest]) nearest = other;
        }
        left &= ~(1U << nearest);
        if (bounds[nearest] > search.limit()) break;
        search.measure(first + nearest);
      }
      continue;
    }
    const EightBoxes& boxes = tree.node(next.level - 1, next.index);
    search.found().boxes += BoxTree::arity;
    unsigned near = near_boxes(boxes, search.point(), search.limit(), bounds.data());
    const std::size_t base = stack.size();
    for (; near != 0; near &= near - 1) {
      const auto child = static_cast<std::uint32_t>(__builtin_ctz(near));
      stack.insert(base, {bounds[child], next.index * BoxTree::arity + child, next.level - 1});
    }
  }
  return true;
}
