// A bound by a triangle's ball (triangle_store.h), included once an instruction set in a namespace that
// defines Wide, a vector of floats, and its square_root and max.

/// How far beyond a triangle's ball the foot of points in its plane surely lies; `height` is the distance to
/// that plane. 0 or less where it may lie in the ball.
template <class Ball>
inline Wide beyond_ball(const Ball& ball, Wide x, Wide y, Wide z, Wide height,
                        float plane_error) noexcept {
  const Wide dx = x - ball.x, dy = y - ball.y, dz = z - ball.z;
  // |p - c|^2 is off by 2 |p - c| times the rounding of p and c and by five roundings of its own, the height
  // by plane_error: all together less than twice plane_error |p - c|, plane_error being eight roundings of
  // |p| + |c|.
  const Wide error = 2 * plane_error * ((max(dx, -dx) + max(dy, -dy)) + max(dz, -dz));
  const Wide along =
      ((dx * dx + dy * dy) + dz * dz) - error - (height + plane_error) * (height + plane_error);
  return square_root(max(along, Wide{})) - (ball.radius + 4 * plane_error);
}
