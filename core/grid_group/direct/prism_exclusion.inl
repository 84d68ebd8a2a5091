// The tests of a prism (prism.h), included once an instruction set in a namespace that defines Wide, a vector
// of `lanes` floats, its square_root, to_bits and all, the bits of all lanes, and how rows of floats are loaded
// and interleaved. The same operations on each point, so that all exclude the same.

#include "core/grid_group/direct/ball_bound.inl"

inline Wide load(const float* from) noexcept {
  Wide values;
  std::memcpy(&values, from, sizeof values);
  return values;
}
inline Wide min(Wide a, Wide b) noexcept { return a < b ? a : b; }

/// Turns rows of four floats, one a triangle, into columns of one float a triangle.
inline std::array<Wide, 4> columns(const std::array<const float*, lanes>& rows) noexcept {
  const Wide a = load_fours(rows, 0), b = load_fours(rows, 1), c = load_fours(rows, 2), d = load_fours(rows, 3);
  const Wide ab_low = interleave_low(a, b), ab_high = interleave_high(a, b);
  const Wide cd_low = interleave_low(c, d), cd_high = interleave_high(c, d);
  return {join_low(ab_low, cd_low), join_high(ab_low, cd_low), join_low(ab_high, cd_high),
          join_high(ab_high, cd_high)};
}

/// A ball's values, of one triangle a lane.
struct WideBall {
  Wide x, y, z, radius;
};

/// Bit i is set for a slot that is excluded.
inline unsigned excluded(const PrismPoints& points, const std::uint32_t* slots, const TrianglePlanes* planes,
                         const TriangleBall* balls) noexcept {
  const auto columns_of = [&](const auto& row_of) {
    std::array<const float*, lanes> rows;
    for (std::size_t i = 0; i < lanes; ++i) rows[i] = row_of(slots[i]);
    return columns(rows);
  };
  const auto row = [](const Lanes& values) { return reinterpret_cast<const float*>(&values); };
  const std::array<Wide, 4> x = columns_of([&](std::uint32_t slot) { return row(planes[slot].x); });
  const std::array<Wide, 4> y = columns_of([&](std::uint32_t slot) { return row(planes[slot].y); });
  const std::array<Wide, 4> z = columns_of([&](std::uint32_t slot) { return row(planes[slot].z); });
  const std::array<Wide, 4> offset = columns_of([&](std::uint32_t slot) { return row(planes[slot].offset); });
  const std::array<Wide, 4> ball = columns_of([&](std::uint32_t slot) { return &balls[slot].x; });
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
    const unsigned beyond = to_bits(height * height + excess * excess > points.limit[at]);
    if ((open & ~beyond) == 0) continue;
    const Wide round = max(excess, beyond_ball(wide_ball, px, py, pz, distance, points.plane_error));
    open &= to_bits(height * height + round * round > points.limit[at]);
  }
  return open;
}

inline unsigned balls_left(const std::array<BallLimit, 6>& corners, const float* x, const float* y,
                           const float* z, const float* radius) noexcept {
  unsigned left = 0;
  for (std::size_t at = 0; at < Prism::triangles_a_look; at += lanes) {
    const Wide ball_x = load(x + at), ball_y = load(y + at), ball_z = load(z + at),
               ball_radius = load(radius + at);
    const auto ahead = [&](const BallLimit& corner) {  // what exceeds 0 is excluded
      const Wide dx = ball_x - corner.x, dy = ball_y - corner.y, dz = ball_z - corner.z,
                 beyond = ball_radius + corner.limit;
      return (dx * dx + dy * dy + dz * dz) * (1 - 0x1p-20F) - beyond * beyond;
    };
    Wide least = ahead(corners[0]);
    for (std::size_t i = 1; i < corners.size(); ++i) least = min(least, ahead(corners[i]));
    left |= to_bits(least <= Wide{}) << at;
  }
  return left;
}
