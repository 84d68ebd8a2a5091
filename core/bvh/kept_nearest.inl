// The first answer of a session (kept_nearest.h), included at the end of traversal.inl.

/// Returns which of those listed may be within the limit, as bits. Bounds and what is added to them are off by
/// less than 2^-20 of what they are and of the move: docs/exactness.md, E14.
static unsigned listed_within(const FollowedPoint& around, const MoveInFrame& move, float length,
                              float limit) noexcept {
  const Wide padded = Wide{} + std::min(limit * (1 + 0x1p-18F) + length * 0x1p-18F, farthest);
  const Wide move_x = Wide{} + move.x, move_y = Wide{} + move.y, move_z = Wide{} + move.z;
  const auto& list = around.list;
  unsigned near = 0;
  for (std::uint32_t i = 0; i < list.capacity; i += lanes) {
    const Wide bound = ((load(list.bound + i) + move_x * load(list.x + i)) + move_y * load(list.y + i)) +
                       move_z * load(list.z + i);
    near |= to_bits(bound <= padded) << i;
  }
  return near;
}

/// Measures those listed in these places, and puts each behind the plane across its offset. Returns true if all
/// are farther than that.
[[gnu::noinline]] static bool are_farther(const PreparedTriangle* triangles, unsigned places, double distance,
                                          double error, const Vec3& center, double scale,
                                          FollowedPoint& around, Work& work) noexcept {
  while (places != 0) {
    const std::uint32_t i = pop_lowest(places);
    const PreparedTriangle& triangle = triangles[around.list.slot[i]];
    if constexpr (tracing) note_triangle(triangle.index);
    ++work.triangles;
    const Offset offset = kernel(triangle, center);
    if (!(std::sqrt(offset.squared) > distance)) return false;
    set_plane_across(around.list, i, triangle, around.center, offset, error, scale);
  }
  return true;
}

/// Answers `nearest` where the kept triangle is the nearest for certain, within the reach or beyond. Else
/// returns what `otherwise()` does. All in one function, whose code lies in a row.
template <class Otherwise>
[[gnu::noinline]] static std::optional<Contact> nearest_kept(const FilterFrame& frame,
                                                             const PreparedTriangle* triangles,
                                                             const Vec3& center, double reach,
                                                             KeptNearest& kept, Work& work,
                                                             const Otherwise& otherwise) noexcept {
  FollowedPoint& around = kept.around;
  const Offset offset = kernel(kept.triangle, center);
  const double distance = std::sqrt(offset.squared);
  const double error = frame.kernel_error(frame.plane_error(frame.to_frame(center)));
  const Vec3 moved = center - around.center;
  const double length = moved.norm() * (1 + 0x1p-40);
  const double others = distance + 4 * error;
  const double others_in_frame = std::min(others * frame.scale() * (1 + 0x1p-20), double{farthest});
  const unsigned near = kept.others(listed_within(
      around, MoveInFrame(moved, frame.scale()),
      static_cast<float>(length * frame.scale() * (1 + 0x1p-20)), static_cast<float>(others_in_frame)));
  if (!(around.covers(others, length + error) && distance > error && std::abs(distance - reach) > error &&
        (near == 0 || are_farther(triangles, near, others, error, center, frame.scale(), around, work))))
    return otherwise();
  if constexpr (tracing) note_triangle(kept.triangle.index);
  ++work.triangles;
  ++around.answered;
  kept.slot = around.list.slot[around.nearest];
  kept.move = center - kept.center;
  kept.center = center;
  kept.upper = distance;
  kept.lower = distance * (1 - 0x1p-40) - error;
  return kept.contact(center, offset.vector, distance, reach);
}
