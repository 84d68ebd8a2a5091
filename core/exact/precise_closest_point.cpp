#include "core/exact/precise_closest_point.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <utility>

#include "core/exact/double_double_vector.h"

namespace touchmark {
namespace {

// Below, m is the largest coordinate of the corners as seen from the point, and v = 2^-103 bounds the
// relative error of an operation of double-doubles: docs/exactness.md, E7.

using double_double::cross, double_double::difference, double_double::dot, double_double::Vector;
using Corners = std::array<Vector, 3>;

/// The sign of a sum of products, exactly: of each the four products of halves, as a sum of doubles of which
/// no two overlap (Shewchuk, "Adaptive precision floating-point arithmetic and fast robust geometric
/// predicates", 1997, section 2.4). Nothing where a product might underflow.
template <std::size_t count>
std::optional<int> sign_of_sum(
    const std::array<std::pair<DoubleDouble, DoubleDouble>, count>& products) noexcept {
  constexpr double smallest = 0x1p-400;
  std::array<double, 8 * count> sum;  // least first
  std::size_t terms = 0;
  const auto add = [&](double term) {
    for (std::size_t i = 0; i < terms; ++i) {
      const DoubleDouble both = two_sum(term, sum[i]);
      sum[i] = both.low;
      term = both.high;
    }
    sum[terms++] = term;
  };
  for (const auto& [x, y] : products) {
    for (const double half : {x.high, x.low, y.high, y.low})
      if (half != 0 && std::abs(half) < smallest) return std::nullopt;
    for (const double x_half : {x.high, x.low}) {
      for (const double y_half : {y.high, y.low}) {
        const DoubleDouble product = two_product(x_half, y_half);
        add(product.low);
        add(product.high);
      }
    }
  }
  while (terms > 0 && sum[terms - 1] == 0) --terms;
  if (terms == 0) return 0;
  return sum[terms - 1] > 0 ? 1 : -1;
}

/// Returns the sign of a d - b c, or nothing where a product might underflow.
std::optional<int> sign_of_determinant(DoubleDouble a, DoubleDouble b, DoubleDouble c,
                                       DoubleDouble d) noexcept {
  return sign_of_sum<2>({{{a, d}, {-b, c}}});
}

std::optional<int> sign_of_dot(const Vector& a, const Vector& b) noexcept {
  return sign_of_sum<3>({{{a[0], b[0]}, {a[1], b[1]}, {a[2], b[2]}}});
}

PreciseClosestPoint at(const Vector& direction, DoubleDouble distance, double error) noexcept {
  PreciseClosestPoint close;
  close.closest.distance = distance;
  close.closest.error = error;
  // A difference, so that no zero comes out negative.
  close.closest.offset =
      Vec3::Zero() - Vec3(direction[0].rounded(), direction[1].rounded(), direction[2].rounded());
  if (close.closest.distance.high > 0) close.closest.direction = close.closest.offset.normalized();
  return close;
}

PreciseClosestPoint at(const Vector& direction, double error) noexcept {
  return at(direction, square_root(dot(direction, direction)), error);
}

PreciseClosestPoint at_corner(const Vector& w, const Vec3& corner, double m) noexcept {
  PreciseClosestPoint close = at(w, 0x1p-98 * m);
  close.feature = {corner, corner};
  return close;
}

/// Returns the closest point of the segment from corner p, which is at w, to corner q.
std::optional<PreciseClosestPoint> on_segment(const Vec3& p, const Vec3& q, const Vector& w,
                                              const Vector& to_q, double m) noexcept {
  const Vector edge = difference(q, p);
  const DoubleDouble squared = dot(edge, edge), along = -dot(w, edge);
  // 16 m^2 v of error in the one, 32 m^2 v in the other.
  const double uncertain = 0x1p-96 * m * m;
  const auto sign_of = [&](double value, const Vector& to) {
    return std::abs(value) > uncertain ? std::optional(value > 0 ? 1 : -1) : sign_of_dot(to, edge);
  };
  const std::optional<int> before = sign_of(-along.high, w);
  if (!before) return std::nullopt;
  if (*before >= 0) return at_corner(w, p, m);
  const std::optional<int> before_q = sign_of((squared - along).high, to_q);
  if (!before_q) return std::nullopt;
  if (*before_q <= 0) return at_corner(to_q, q, m);
  const DoubleDouble part = along / squared;  // off by less than 2^-96 m^2 / |edge|^2
  Vector direction;
  for (std::size_t k = 0; k < 3; ++k) direction[k] = w[k] + edge[k] * part;
  PreciseClosestPoint close = at(direction, 0x1p-94 * m * (m / std::sqrt(squared.high)));
  close.feature = {p, q};
  return close;
}

PreciseClosestPoint on_face(const Vector& w, const Vector& normal, double m) noexcept {
  const DoubleDouble squared = dot(normal, normal);
  const DoubleDouble part = dot(w, normal) / squared;
  Vector direction;
  for (std::size_t k = 0; k < 3; ++k) direction[k] = normal[k] * part;
  PreciseClosestPoint close = at(direction, 0);
  // With N = |normal| each coordinate of the way is off by 112 v m^3 / N for the height's error, and by
  // 1472 v d (m^2 / N)^2 + 2^-101 d for the other factors' and the quotient's. N <= 12 m^2.
  const double ratio = m * m / std::sqrt(squared.high);
  close.closest.error = ratio * (0x1p-94 * m + 0x1p-90 * close.closest.distance.high * ratio);
  return close;
}

/// The face is across a coordinate axis, and that sees it turn counter-clockwise (1) or clockwise (-1).
struct Level {
  std::size_t axis;
  int sense;

  std::size_t x() const noexcept { return (axis + 1) % 3; }
  std::size_t y() const noexcept { return (axis + 2) % 3; }
};

/// Returns the axis that the face is across, or nothing where it is oblique or has no area.
std::optional<Level> level_of(const TriangleCorners& triangle) noexcept {
  for (Level level{0, 0}; level.axis < 3; ++level.axis) {
    const auto k = static_cast<Eigen::Index>(level.axis);
    if (triangle[0][k] != triangle[1][k] || triangle[0][k] != triangle[2][k]) continue;
    const Vector u = difference(triangle[1], triangle[0]), v = difference(triangle[2], triangle[0]);
    level.sense = sign_of_determinant(u[level.x()], u[level.y()], v[level.x()], v[level.y()]).value_or(0);
    if (level.sense != 0) return level;
  }
  return std::nullopt;
}

/// The height over it is a coordinate, and exact, however small.
PreciseClosestPoint on_level_face(const Vector& w, std::size_t axis) noexcept {
  Vector direction{};
  direction[axis] = w[axis];
  const bool above = w[axis].high < 0;
  PreciseClosestPoint close = at(direction, above ? -w[axis] : w[axis], 0);
  if (w[axis].high != 0)
    close.closest.direction = (above ? 1 : -1) * Vec3::Unit(static_cast<Eigen::Index>(axis));
  return close;
}

/// Bounds the error of a side's value in over_face: 320 m^4 v.
double side_error(double m) noexcept { return 0x1p-93 * (m * m) * (m * m); }

bool has_corner(const TriangleCorners& triangle, const Vec3& position) noexcept {
  return std::find(triangle.begin(), triangle.end(), position) != triangle.end();
}

struct Interval {
  double middle, error;
};

/// Returns the largest coordinate difference between the corners and the point.
double largest_difference(const TriangleCorners& triangle, const Vec3& point) noexcept {
  double largest = 0;
  for (const Vec3& corner : triangle) largest = std::max(largest, (corner - point).cwiseAbs().maxCoeff());
  return largest;
}

enum class OverFace { inside, on_border, no, unknown };

OverFace over_face(const Corners& w, const Vector& normal, const std::optional<Level>& level,
                   double m) noexcept {
  const double uncertain = side_error(m);
  bool known = true, inside = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    // The normal of the side in the plane, (w_j - w_i) x (0 - w_i), is w_i x w_j.
    const double side = dot(cross(w[i], w[j]), normal).high;
    if (side < -uncertain) return OverFace::no;
    if (side > uncertain) continue;
    if (!level) {
      known = false;
      continue;
    }
    const std::optional<int> sign =
        sign_of_determinant(w[i][level->x()], w[i][level->y()], w[j][level->x()], w[j][level->y()]);
    if (!sign) {
      known = false;
    } else if (*sign == 0) {
      inside = false;
    } else if (*sign != level->sense) {
      return OverFace::no;
    }
  }
  if (!known) return OverFace::unknown;
  return inside ? OverFace::inside : OverFace::on_border;
}

std::optional<PreciseClosestPoint> on_border(const TriangleCorners& triangle, const Corners& w,
                                             double m) noexcept {
  std::optional<PreciseClosestPoint> best;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = (i + 1) % 3;
    const std::optional<PreciseClosestPoint> other = on_segment(triangle[i], triangle[j], w[i], w[j], m);
    if (!other) return std::nullopt;
    if (!best) {
      best = other;
      continue;
    }
    const std::partial_ordering order = compare(other->closest, best->closest);
    if (order == std::partial_ordering::unordered && !on_same_feature(*other, *best)) return std::nullopt;
    if (order < 0) best = other;
  }
  return best;
}

}  // namespace

std::optional<PreciseClosestPoint> precise_closest_point(const TriangleCorners& triangle,
                                                         const Vec3& point) noexcept {
  const double m = largest_difference(triangle, point);
  // Otherwise fourth powers leave the range in which double-doubles keep both halves.
  if (!(m >= 0x1p-132 && m <= 0x1p232)) return std::nullopt;
  const Corners w = {difference(triangle[0], point), difference(triangle[1], point),
                     difference(triangle[2], point)};
  const Vector normal = cross(difference(triangle[1], triangle[0]), difference(triangle[2], triangle[0]));
  const std::optional<Level> level = level_of(triangle);
  const OverFace over = over_face(w, normal, level, m);
  if (over == OverFace::unknown) return std::nullopt;
  std::optional<PreciseClosestPoint> close;
  if (over == OverFace::no) {
    close = on_border(triangle, w, m);
  } else {
    close = level ? on_level_face(w[0], level->axis) : on_face(w[0], normal, m);
    close->inside = over == OverFace::inside;
  }
  if (close && !(close->closest.error <= 0x1p-60 * m)) return std::nullopt;
  return close;
}

std::partial_ordering compare_inside(const TriangleCorners& a, const TriangleCorners& b,
                                     const Vec3& point) noexcept {
  // Both are as far as the edge that they share, but for how far inside they are of it.
  const auto off_edge = [&](const TriangleCorners& t,
                            const TriangleCorners& other) -> std::optional<Interval> {
    for (std::size_t i = 0; i < 3; ++i) {
      // The edge from the next corner to the one after.
      const std::size_t j = (i + 1) % 3, k = (i + 2) % 3;
      if (!has_corner(other, t[j]) || !has_corner(other, t[k])) continue;
      const Vector normal = cross(difference(t[j], t[i]), difference(t[k], t[i]));
      const double side = dot(cross(difference(t[j], point), difference(t[k], point)), normal).high;
      const double length = std::sqrt(dot(normal, normal).high);
      return Interval{side / length, side_error(largest_difference(t, point)) / length};
    }
    return std::nullopt;
  };
  const std::optional<Interval> in_a = off_edge(a, b), in_b = off_edge(b, a);
  if (!in_a || !in_b) return std::partial_ordering::unordered;
  // With three roundings of each, and the normal's length within 2^-90.
  const double error = in_a->error + in_b->error + 0x1p-48 * (in_a->middle + in_b->middle);
  const double farther_in = in_a->middle - in_b->middle;
  // NaN, where a normal vanishes, is not ordered either.
  if (!(std::abs(farther_in) > error)) return std::partial_ordering::unordered;
  return farther_in > 0 ? std::partial_ordering::less : std::partial_ordering::greater;
}

bool is_nearer_inside(const PreciseClosestPoint& a, const TriangleCorners& triangle_of_a,
                      const PreciseClosestPoint& b) noexcept {
  if (!a.inside || !b.feature) return false;
  return has_corner(triangle_of_a, b.feature->front()) && has_corner(triangle_of_a, b.feature->back());
}

bool on_same_feature(const PreciseClosestPoint& a, const PreciseClosestPoint& b) noexcept {
  if (!a.feature || !b.feature) return false;
  const auto& [a_first, a_second] = *a.feature;
  const auto& [b_first, b_second] = *b.feature;
  return (a_first == b_first && a_second == b_second) || (a_first == b_second && a_second == b_first);
}

}  // namespace touchmark
