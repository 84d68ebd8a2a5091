// The search of the hierarchy along a path, included at the end of traversal.inl. All rounding is below the
// path's error, which widens what the ball reaches: docs/exactness.md, E18.

/// The root of a sum of two squares is less than this too small.
inline constexpr float rounded_up = 1 + 0x1p-20F;

/// A path in every lane.
struct PathLanes {
  Wide x, y, z, direction_x, direction_y, direction_z, reach;

  explicit PathLanes(const Path& path) noexcept
      : x(Wide{} + path.from.x),
        y(Wide{} + path.from.y),
        z(Wide{} + path.from.z),
        direction_x(Wide{} + path.direction_x),
        direction_y(Wide{} + path.direction_y),
        direction_z(Wide{} + path.direction_z),
        reach(Wide{} + path.reach) {}
};

/// Parts of the path: where the ball may reach into a bounding volume, as lengths from the start.
struct Stretches {
  alignas(64) std::array<float, tree_width> begin, end;
};

/// Returns the least magnitude between two values of what is linear in between.
inline Wide least_magnitude(Wide a, Wide b) noexcept {
  return a * b > 0 ? min(max(a, -a), max(b, -b)) : Wide{};
}

/// Returns true where what is `at` a coordinate of the path at its start and changes by `rise` a length comes
/// within `limit` of 0 between two lengths.
inline WideBits comes_within(Wide limit, Wide at, Wide rise, Wide begin, Wide end) noexcept {
  return least_magnitude(at + begin * rise, at + end * rise) <= limit;
}

/// Returns those children that the ball may reach into before `until`, as bits. Such a child's ball is within
/// reach of the path, and on that stretch the path comes within reach of its slab, or of all three of its box.
inline unsigned children_on(bool boxes, const TreeNode& node, const PathLanes& path, float until,
                            Stretches& stretches) noexcept {
  unsigned found = 0;
  for (std::size_t at = 0; at < tree_width; at += lanes) {
    const Wide x = path.x - load(node.x + at), y = path.y - load(node.y + at), z = path.z - load(node.z + at);
    const Wide half = load(node.half + at), across = load(node.radius + at);
    const Wide third = boxes ? load(node.normal_x + at) : Wide{};
    const Wide radius =
        square_root(across * across + half * half + third * third) * rounded_up + path.reach;
    const Wide along = -(x * path.direction_x + y * path.direction_y + z * path.direction_z);
    const Wide nearest = min(max(along, Wide{}), Wide{} + until);
    const Wide off_x = x + nearest * path.direction_x, off_y = y + nearest * path.direction_y,
               off_z = z + nearest * path.direction_z;
    const Wide begin = min(max(along - radius, Wide{}), Wide{} + until);
    const Wide end = min(max(along + radius, Wide{}), Wide{} + until);
    WideBits near = off_x * off_x + off_y * off_y + off_z * off_z <= radius * radius;
    if (boxes) {
      near &= comes_within(half + path.reach, x, path.direction_x, begin, end) &
              comes_within(across + path.reach, y, path.direction_y, begin, end) &
              comes_within(third + path.reach, z, path.direction_z, begin, end);
    } else {
      const Wide normal_x = load(node.normal_x + at), normal_y = load(node.normal_y + at),
                 normal_z = load(node.normal_z + at);
      const Wide height = x * normal_x + y * normal_y + z * normal_z;
      const Wide rise =
          path.direction_x * normal_x + path.direction_y * normal_y + path.direction_z * normal_z;
      near &= comes_within(half + path.reach, height, rise, begin, end);
    }
    store(stretches.begin.data() + at, begin);
    store(stretches.end.data() + at, end);
    found |= to_bits(near) << at;
  }
  return found;
}

/// Returns those of a block's triangles that the ball may reach on a stretch, given as its ends, as bits. A
/// plane's value is linear in between.
inline unsigned triangles_on(const TriangleBlock& block, const Point& begin, const Point& end,
                             float reach) noexcept {
  unsigned found = 0;
  for (std::size_t at = 0; at < tree_width; at += lanes) {
    Wide side = Wide{};
    for (std::size_t k = 1; k < 4; ++k)
      side = max(side, min(planes_at(block, k, at, begin).value, planes_at(block, k, at, end).value));
    const Wide face = planes_at(block, 0, at, begin).value, face_at_end = planes_at(block, 0, at, end).value;
    const Wide height = max(least_magnitude(face, face_at_end) - begin.plane_error, Wide{});
    const Wide excess = max(side - begin.plane_error, Wide{});
    found |= to_bits(height * height + excess * excess <= Wide{} + reach * reach) << at;
  }
  return found;
}

/// Shows the visitor every triangle that the ball may touch before visitor.until(), which may fall meanwhile,
/// those first whose bounding volumes the ball comes to first. Returns false when the visitor's work has come
/// to more than `budget` before the end.
template <class Visitor>
[[gnu::noinline]] bool sweep(const TreeParts& tree, const Path& path, std::uint64_t budget,
                             Visitor& visitor) noexcept {
  struct Entry {
    float begin, end;
    TreeRef ref;
  };
  const PathLanes lanes_of_path(path);
  const auto point_at = [&](float length) {
    return broadcast({path.from.x + length * path.direction_x, path.from.y + length * path.direction_y,
                      path.from.z + length * path.direction_z, path.error});
  };
  std::array<Entry, max_stack> stack;
  std::size_t count = 1;
  stack[0] = {0, visitor.until(), TreeRef{0}};
  while (count > 0) {
    const Entry next = stack[--count];
    const float until = visitor.until();
    if (next.begin > until) continue;
    if (visitor.work.spheres + visitor.work.triangles > budget) return false;
    const std::uint32_t index = next.ref.index();
    if (next.ref.is_block()) {
      visitor.work.triangles += tree_width;
      unsigned near = triangles_on(tree.blocks[index], point_at(next.begin), point_at(next.end), path.reach);
      for (unsigned left = near; left != 0;)
        prefetch(tree.triangles[index * tree_width + pop_lowest(left)]);
      while (near != 0) visitor.consider(index * tree_width + pop_lowest(near));
      continue;
    }
    const TreeNode& node = tree.nodes[index];
    Stretches stretches;
    unsigned near = children_on(tree.boxes, node, lanes_of_path, until, stretches);
    if constexpr (tracing) note_children(tree.boxes, node, 0, near);
    visitor.work.spheres += tree_width;
    const std::size_t base = count;
    while (near != 0) {
      const std::uint32_t child = pop_lowest(near);
      prefetch(tree, node.child[child]);
      const float begin = stretches.begin[child];
      std::size_t at = count++;
      for (; at > base && stack[at - 1].begin < begin; --at) stack[at] = stack[at - 1];
      stack[at] = {begin, stretches.end[child], node.child[child]};
    }
  }
  return true;
}
