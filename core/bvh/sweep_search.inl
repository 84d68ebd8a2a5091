// The search of the hierarchy along a path, included at the end of traversal.inl. All rounding is below the
// path's error, which widens what the ball reaches: docs/exactness.md, E18.

/// The root of a sum of two squares is less than this too small.
static constexpr float rounded_up = 1 + 0x1p-20F;

/// One over how fast a coordinate changes, as a magnitude. What changes less over a length of 1 than 2^-40,
/// far below the path's error, is taken to change by as much.
static Wide inverse_of(Wide rise) noexcept { return (Wide{} + 1) / max(max(rise, -rise), Wide{} + 0x1p-40F); }

/// A path in every lane.
struct PathLanes {
  Wide x, y, z, direction_x, direction_y, direction_z, inverse_x, inverse_y, inverse_z, reach;

  explicit PathLanes(const Path& path) noexcept
      : x(Wide{} + path.from.x),
        y(Wide{} + path.from.y),
        z(Wide{} + path.from.z),
        direction_x(Wide{} + path.direction_x),
        direction_y(Wide{} + path.direction_y),
        direction_z(Wide{} + path.direction_z),
        inverse_x(inverse_of(direction_x)),
        inverse_y(inverse_of(direction_y)),
        inverse_z(inverse_of(direction_z)),
        reach(Wide{} + path.reach) {}
};

/// Parts of the path: where the ball may reach into a bounding volume, as lengths from the start.
struct Stretches {
  alignas(64) std::array<float, width> begin, end;
};

/// A part of the path in each lane.
struct Part {
  Wide begin, end;

  /// Cuts off where what is `at` a coordinate of the path at its start, and changes by `rise` a length, is
  /// farther than `limit` from 0. What is below 0 leaves nothing.
  void keep_within(Wide limit, Wide at, Wide rise, Wide inverse) noexcept {
    const Wide rising = rise < 0 ? -at : at;
    begin = max(begin, (-limit - rising) * inverse);
    end = min(end, (limit - rising) * inverse);
  }
};

/// Returns those children that the ball may reach into before `until`, as bits. Such a child's ball is within
/// reach of the path, and there is a stretch on which the path is within reach of its slab, or of all three
/// of its box.
static unsigned children_on(bool boxes, const Node& node, const PathLanes& path, float until,
                            Stretches& stretches) noexcept {
  unsigned found = 0;
  for (std::size_t at = 0; at < width; at += lanes) {
    const Wide x = path.x - load(node.x() + at), y = path.y - load(node.y() + at), z = path.z - load(node.z() + at);
    const Wide half = load(boxes ? node.half_x() + at : node.half_height() + at);
    const Wide across = load(boxes ? node.half_y() + at : node.radius() + at);
    const Wide third = boxes ? load(node.half_z() + at) : Wide{};
    const Wide radius = square_root(across * across + half * half + third * third) * rounded_up + path.reach;
    const Wide along = -(x * path.direction_x + y * path.direction_y + z * path.direction_z);
    const Wide off_x = x + along * path.direction_x, off_y = y + along * path.direction_y,
               off_z = z + along * path.direction_z;
    const Wide squared = radius * radius - (off_x * off_x + off_y * off_y + off_z * off_z);
    const Wide chord = square_root(max(squared, Wide{}));
    Part part{max(along - chord, Wide{}), min(along + chord, Wide{} + until)};
    if (boxes) {
      part.keep_within(half + path.reach, x, path.direction_x, path.inverse_x);
      part.keep_within(across + path.reach, y, path.direction_y, path.inverse_y);
      part.keep_within(third + path.reach, z, path.direction_z, path.inverse_z);
    } else {
      const Wide normal_x = load(node.normal_x() + at), normal_y = load(node.normal_y() + at),
                 normal_z = load(node.normal_z() + at);
      const Wide height = x * normal_x + y * normal_y + z * normal_z;
      const Wide rise =
          path.direction_x * normal_x + path.direction_y * normal_y + path.direction_z * normal_z;
      part.keep_within(half + path.reach, height, rise, inverse_of(rise));
    }
    const WideBits near = (squared >= 0) & (part.begin <= part.end);
    store(stretches.begin.data() + at, part.begin);
    store(stretches.end.data() + at, part.end);
    found |= to_bits(near) << at;
  }
  return found;
}

/// What is linear along a stretch, at its begin and its end.
struct Linear {
  Wide begin, end;
};

/// Rounding of where two tangents cross, as a share of the values at both ends.
static constexpr float tangent_error = 0x1p-18F;

/// Returns a lower bound of height^2 + excess^2 along the stretch, both less an error towards 0: a sum of
/// convex functions, so nowhere below the tangents at its ends.
static Wide least_squared(const Linear& height, const Linear& excess, Wide error) noexcept {
  const Wide h0 = max(max(height.begin, -height.begin) - error, Wide{}),
             h1 = max(max(height.end, -height.end) - error, Wide{}),
             e0 = max(excess.begin - error, Wide{}), e1 = max(excess.end - error, Wide{});
  const Wide climb = height.end - height.begin, widening = excess.end - excess.begin;
  const Wide first = h0 * h0 + e0 * e0, last = h1 * h1 + e1 * e1;
  // Half the slopes there, as a fall and a rise.
  const Wide fall = h0 * (height.begin < 0 ? climb : -climb) - e0 * widening;
  const Wide rise = h1 * (height.end < 0 ? -climb : climb) + e1 * widening;
  const Wide crossing = first - fall * ((first - last + 2 * rise) / (fall + rise));
  const Wide least = min(first, last);
  return ((fall > 0) & (rise > 0)) ? min(crossing, least) - tangent_error * (first + last) : least;
}

/// Returns those of a block's triangles that the ball may reach on a stretch, given as its ends, as bits. A
/// plane's value is linear in between, and off by less than half the path's error.
static unsigned triangles_on(const TriangleBlock& block, const Point& begin, const Point& end,
                             float reach) noexcept {
  unsigned found = 0;
  for (std::size_t at = 0; at < width; at += lanes) {
    const auto plane = [&](std::size_t k) {
      return Linear{planes_at(block, k, at, begin).value, planes_at(block, k, at, end).value};
    };
    // Of the sides that which is beyond most.
    Linear excess = plane(1);
    for (std::size_t k = 2; k < 4; ++k) {
      const Linear side = plane(k);
      const WideBits is_more = side.begin + side.end > excess.begin + excess.end;
      excess = {is_more ? side.begin : excess.begin, is_more ? side.end : excess.end};
    }
    const Wide least = least_squared(plane(0), excess, begin.plane_error / 2);
    found |= to_bits(least <= Wide{} + reach * reach) << at;
  }
  return found;
}

/// Shows the visitor every triangle that the ball may touch before visitor.until(), which may fall meanwhile,
/// those first whose bounding volumes the ball comes to first. Returns false when the visitor's work has come
/// to more than `budget` before the end.
template <class Visitor>
[[gnu::noinline]] static bool sweep(const Parts& tree, const Path& path, std::uint64_t budget,
                             Visitor& visitor) noexcept {
  struct Entry {
    float begin, end;
    ChildRef ref;
  };
  const PathLanes lanes_of_path(path);
  const auto point_at = [&](float length) {
    return broadcast({path.from.x + length * path.direction_x, path.from.y + length * path.direction_y,
                      path.from.z + length * path.direction_z, path.error});
  };
  std::array<Entry, max_stack> stack;
  std::size_t count = 1;
  stack[0] = {0, visitor.until(), ChildRef{0}};
  while (count > 0) {
    const Entry next = stack[--count];
    const float until = visitor.until();
    if (next.begin > until) continue;
    if (visitor.work.spheres + visitor.work.triangles > budget) return false;
    const std::uint32_t index = next.ref.index();
    if (next.ref.is_block()) {
      visitor.work.triangles += width;
      unsigned near = triangles_on(tree.blocks[index], point_at(next.begin),
                                   point_at(std::min(next.end, until)), path.reach);
      for (unsigned left = near; left != 0;) prefetch(tree.triangles[index * width + pop_lowest(left)]);
      while (near != 0) visitor.consider(index * width + pop_lowest(near));
      continue;
    }
    const Node& node = tree.nodes[node_of(tree, next.ref, visitor.work)];
    Stretches stretches;
    unsigned near = children_on(tree.boxes, node, lanes_of_path, until, stretches);
    if constexpr (tracing) note_children(tree.boxes, node, 0, near);
    visitor.work.spheres += width;
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
