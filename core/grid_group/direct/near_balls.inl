// The looks at several balls and boxes (near_balls.h), included once an instruction set in a namespace of the
// names of wide_rows.h. The same operations on each, so that all find the same.

inline ChildrenIn children_in(const EightBoxes& boxes, const FloatBounds& box) noexcept {
  unsigned apart = 0, beyond = 0;
  for (std::size_t at = 0; at < BoxTree::arity; at += lanes) {
    auto is_apart = Wide{} > Wide{}, is_beyond = is_apart;
    for (std::size_t k = 0; k < 3; ++k) {
      const Wide min = read<Wide>(&boxes.min[k][at / 4]), max = read<Wide>(&boxes.max[k][at / 4]);
      is_apart |= (min > box.max[k]) | (max < box.min[k]);
      is_beyond |= (min < box.min[k]) | (max > box.max[k]);
    }
    apart |= to_bits(is_apart) << at;
    beyond |= to_bits(is_beyond) << at;
  }
  return left_of_eight(apart, beyond);
}

inline void add_block(NearBalls& near, const TriangleBall* balls, std::uint32_t first,
                      const FloatBounds& box) noexcept {
  for (std::uint32_t at = first; at < first + TriangleStore::block_size; at += lanes) {
    std::array<Lanes, lanes> rows;
    for (std::uint32_t i = 0; i < lanes; ++i) rows[i] = load(&balls[at + i].x);
    const std::array<Wide, 4> ball = columns(rows);
    // Coordinates are below 4: their roundings, those of the ball and of the box inwards are below 2^-20.
    const Wide radius = ball[3] * (1 + 0x1p-20F) + 0x1p-19F;
    auto apart = Wide{} > Wide{};
    for (std::size_t k = 0; k < 3; ++k)
      apart |= (ball[k] + radius < box.min[k]) | (ball[k] - radius > box.max[k]);
    const Kept kept(~to_bits(apart) & all);
    kept.store(&near.slots[near.size], first_slots + at);
    kept.store(&near.x[near.size], ball[0]);
    kept.store(&near.y[near.size], ball[1]);
    kept.store(&near.z[near.size], ball[2]);
    kept.store(&near.radius[near.size], ball[3]);
    near.size += kept.count();
  }
}

/// Adds slots that all reach into the box. Returns false where they are too many.
inline bool add_all(NearBalls& near, const TriangleStore& store, std::uint64_t first, std::uint64_t count,
                    std::uint64_t most) noexcept {
  const std::uint64_t end = std::min<std::uint64_t>(first + count, store.size());
  if (near.size + (end - first) > most) return false;
  for (std::uint64_t slot = first; slot < end; ++slot)
    near.add(store.balls.data(), static_cast<std::uint32_t>(slot));
  return true;
}

inline bool gather(NearBalls& near, const TriangleStore& store, const BoxTree& tree, const FloatBounds& box,
                   const NearBalls::Most& most, std::uint64_t& boxes_seen) noexcept {
  struct Node {
    std::uint32_t level, index;
  };
  near.size = 0;
  // As in BoxStack: seven siblings a level, and the last level's eight.
  std::array<Node, 8 * 11> stack;
  std::size_t count = 1;
  stack[0] = {static_cast<std::uint32_t>(tree.levels()) - 1, 0};
  while (count > 0) {
    const Node node = stack[--count];
    boxes_seen += BoxTree::arity;
    if (boxes_seen > most.boxes) return false;
    const ChildrenIn in = children_in(tree.node(node.level, node.index), box);
    const std::uint64_t slots_a_child = std::uint64_t{TriangleStore::block_size} << (3 * node.level);
    for (unsigned left = in.reaching; left != 0; left &= left - 1) {
      const auto i = static_cast<std::uint32_t>(__builtin_ctz(left));
      const std::uint32_t child = node.index * BoxTree::arity + i;
      if ((in.within >> i & 1) != 0) {
        if (!add_all(near, store, child * slots_a_child, slots_a_child, most.slots)) return false;
      } else if (node.level > 0) {
        stack[count++] = {node.level - 1, child};
      } else {
        add_block(near, store.balls.data(), child * TriangleStore::block_size, box);
        if (near.size > most.slots) return false;
      }
    }
  }
  return true;
}

inline std::size_t open_by_balls(const NearBalls& near, const std::array<BallLimit, 6>& corners,
                                 const TriangleBall& own, OpenSlots& open) noexcept {
  OpenSlots others;
  std::size_t count = 0, other_count = 0;
  for (std::size_t at = 0; at < near.size; at += lanes) {
    const Wide x = read<Wide>(&near.x[at]), y = read<Wide>(&near.y[at]), z = read<Wide>(&near.z[at]),
               radius = read<Wide>(&near.radius[at]);
    const auto ahead = [&](const auto& ball, float limit) {  // what exceeds 0 is farther than the limit
      const Wide dx = x - ball.x, dy = y - ball.y, dz = z - ball.z, reach = radius + limit;
      return (dx * dx + dy * dy + dz * dz) * (1 - 0x1p-20F) - reach * reach;
    };
    Wide least = ahead(corners[0], corners[0].limit);
    for (std::size_t i = 1; i < corners.size(); ++i) {
      const Wide at_corner = ahead(corners[i], corners[i].limit);
      least = at_corner < least ? at_corner : least;
    }
    unsigned left = to_bits(least <= Wide{});
    if (near.size - at < lanes) left &= (1U << (near.size - at)) - 1;
    const unsigned meeting = to_bits(ahead(own, own.radius) <= Wide{});
    const Slots slots = read<Slots>(&near.slots[at]);
    const Kept first(left & meeting), other(left & ~meeting);
    first.store(&open[count], slots);
    other.store(&others[other_count], slots);
    count += first.count();
    other_count += other.count();
  }
  std::copy_n(others.begin(), other_count, open.begin() + static_cast<std::ptrdiff_t>(count));
  return count + other_count;
}
