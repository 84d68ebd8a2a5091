// Which triangles of a list (plane_list.h) may be within a limit, included at the end of traversal.inl.

/// Writes the places of those in the list that may be within the limit somewhere on the way between two
/// points, and returns how many. A bound is linear along the way, so least at an end.
template <class List>
static std::uint32_t places_within(const List& list, const MoveInFrame& begin, const MoveInFrame& end,
                                   float limit, std::uint32_t* places) noexcept {
  const Wide begin_x = Wide{} + begin.x, begin_y = Wide{} + begin.y, begin_z = Wide{} + begin.z;
  const Wide end_x = Wide{} + end.x, end_y = Wide{} + end.y, end_z = Wide{} + end.z;
  std::uint32_t count = 0;
  for (std::uint32_t first = 0; first < list.count; first += width) {
    unsigned near = 0;
    for (std::uint32_t at = 0; at < width; at += lanes) {
      const std::uint32_t i = first + at;
      const Wide x = load(list.x + i), y = load(list.y + i), z = load(list.z + i), bound = load(list.bound + i);
      const Wide least = min(((begin_x * x + begin_y * y) + begin_z * z) + bound,
                             ((end_x * x + end_y * y) + end_z * z) + bound);
      near |= to_bits(least <= Wide{} + limit) << at;
    }
    std::array<std::uint32_t, width> eight;
    for (std::uint32_t k = 0; k < width; ++k) eight[k] = first + k;
    compress(places + count, eight.data(), near);
    count += static_cast<std::uint32_t>(std::popcount(near));
  }
  return count;
}
