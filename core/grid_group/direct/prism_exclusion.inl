// The tests of a prism (prism.h), included once an instruction set in a namespace that defines Wide, a vector
// of `lanes` floats, its square_root, to_bits and all, the bits of all lanes, and how rows of floats are loaded
// and interleaved. The same operations on each point, so that all exclude the same.

#include "core/grid_group/direct/ball_bound.inl"

/// A ball's values, of one triangle a lane.
struct WideBall {
  Wide x, y, z, radius;
};

/// Bit i is set for a slot that is excluded.
inline unsigned excluded(const PrismPoints& points, const std::uint32_t* slots, const TrianglePlanes* planes,
                         const TriangleBall* balls) noexcept {
  const auto columns_of = [&](const auto& row_of) {
    std::array<Lanes, lanes> rows;
    for (std::size_t i = 0; i < lanes; ++i) rows[i] = row_of(slots[i]);
    return columns(rows);
  };
  const std::array<Wide, 4> x = columns_of([&](std::uint32_t slot) { return planes[slot].x; });
  const std::array<Wide, 4> y = columns_of([&](std::uint32_t slot) { return planes[slot].y; });
  const std::array<Wide, 4> z = columns_of([&](std::uint32_t slot) { return planes[slot].z; });
  const std::array<Wide, 4> offset = columns_of([&](std::uint32_t slot) { return planes[slot].offset; });
  const std::array<Wide, 4> ball = columns_of([&](std::uint32_t slot) { return load(&balls[slot].x); });
  const WideBall wide_ball{ball[0], ball[1], ball[2], ball[3]};
  const Wide plane_error = points.plane_error + Wide{};
  unsigned open = all;
  for (std::size_t at = 0; at < PrismPoints::count && open != 0; ++at) {
    const Wide px = points.x[at] + Wide{}, py = points.y[at] + Wide{}, pz = points.z[at] + Wide{};
    const auto value = [&](std::size_t plane) {
      return ((px * x[plane] + py * y[plane]) + pz * z[plane]) + offset[plane];
    };
    const Wide face = value(0), distance = max(face, -face);
    const Wide height = max(distance - plane_error, Wide{});
    const Wide excess = max(max(value(1), max(value(2), value(3))) - plane_error, Wide{});
    const unsigned beyond = bits_above(height * height + excess * excess, points.limit[at] + Wide{});
    if ((open & ~beyond) == 0) continue;
    const Wide round = max(excess, beyond_ball(wide_ball, px, py, pz, distance, points.plane_error));
    open &= bits_above(height * height + round * round, points.limit[at] + Wide{});
  }
  return open;
}
