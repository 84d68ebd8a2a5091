// What comes within the limit of one of several points (limited_point.h), included at the end of traversal.inl.

/// Writes the listed leaves that may come within a limit, and returns how many they are.
static std::size_t leaves_within(const Parts& tree, const LeafList& list, std::span<const LimitedPoint> points,
                                 ChildRef* left) noexcept {
  std::size_t count = 0;
  Wide unseen{};
  for (std::uint32_t first = 0; first < list.count; first += width) {
    unsigned near = 0;
    for (const LimitedPoint& point : points) {
      const Point p = broadcast(point.at);
      near |= within([&](std::size_t at) { return child_bounds(tree.boxes, list.leaves, first + at, p); },
                     point.limit, unseen);
    }
    compress(left + count, list.leaves.child + first, near);
    count += static_cast<std::size_t>(std::popcount(near));
  }
  return count;
}

/// True unless no triangle of the block comes within a limit.
static bool comes_within(const Parts& tree, ChildRef block, std::span<const LimitedPoint> points) noexcept {
  const TriangleBlock& planes = tree.blocks[block.index()];
  Wide unseen{};
  return std::any_of(points.begin(), points.end(), [&](const LimitedPoint& point) {
    const Point p = broadcast(point.at);
    // What is beyond corners takes longer to tell.
    return within([&](std::size_t at) { return triangle_bounds(planes, at, p); }, point.limit, unseen) != 0 &&
           within([&](std::size_t at) { return corner_bounds(planes, at, p); }, point.limit, unseen) != 0;
  });
}
