// The tests of a prism (prism.h), included once an instruction set in a namespace that defines Wide, a vector
// of `lanes` floats, and its square_root, to_bits and all, the bits of all lanes. The same operations on each
// point, so that all exclude the same.

#include "core/grid_group/direct/ball_bound.inl"

inline Wide load(const float* from) noexcept {
  Wide values;
  std::memcpy(&values, from, sizeof values);
  return values;
}
inline Wide min(Wide a, Wide b) noexcept { return a < b ? a : b; }

inline bool excludes(const PrismPoints& points, const TrianglePlanes& t, const TriangleBall& ball) noexcept {
  for (std::size_t at = 0; at < PrismPoints::count; at += lanes) {
    const Wide x = load(points.x.data() + at), y = load(points.y.data() + at), z = load(points.z.data() + at),
               limit = load(points.limit.data() + at);
    const auto value = [&](int plane) {
      return ((x * t.x[plane] + y * t.y[plane]) + z * t.z[plane]) + t.offset[plane];
    };
    const Wide face = value(0), distance = max(face, -face);
    const Wide height = max(distance - points.plane_error, Wide{});
    const Wide side_excess = max(value(1), max(value(2), value(3))) - points.plane_error;
    const Wide excess = max(side_excess, Wide{});
    if (to_bits(height * height + excess * excess > limit) == all) continue;
    const Wide round = max(excess, beyond_ball(ball, x, y, z, distance, points.plane_error));
    if (to_bits(height * height + round * round > limit) != all) return false;
  }
  return true;
}

inline unsigned balls_left(const std::array<BallLimit, 6>& corners, const float* x, const float* y,
                           const float* z, const float* radius) noexcept {
  unsigned left = 0;
  for (std::size_t at = 0; at < Prism::balls_a_look; at += lanes) {
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
