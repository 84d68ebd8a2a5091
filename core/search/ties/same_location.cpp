#include "core/search/ties/same_location.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include <Eigen/Geometry>

#include "core/exact/double_double_vector.h"
#include "core/float_limits.h"

namespace touchmark {
namespace {

using double_double::cross, double_double::difference, double_double::dot, double_double::Vector;

/// Lengths below this may have lost bits when they were multiplied, and what is made of them.
constexpr double min_length = 0x1p-300;
/// What underflow may have done to a squared distance, by far, where edges and normals are as long as below.
constexpr double underflow = 0x1p-520;
constexpr double min_squared_edge = 0x1p-260, min_squared_normal = 0x1p-520;

Feature corner_at(const Vec3& a) noexcept { return {{a, a, a}, 1}; }
Feature edge_between(const Vec3& a, const Vec3& b) noexcept { return {{a, b, a}, 2}; }

/// 1 or -1 where the value's sign is certain, else 0.
int sure_sign(double value, double squared_error) noexcept {
  if (!(value * value > squared_error)) return 0;
  return value > 0 ? 1 : -1;
}

/// Are the differences between these points, and their dot product, what doubles make of them, and 0?
bool is_exactly_across(const Vec3& to, const Vec3& from, const Vec3& end) noexcept {
  double sum = 0;
  for (Eigen::Index k = 0; k < 3; ++k) {
    const DoubleDouble a = two_sum(to[k], -from[k]);
    if (a.high == 0) continue;
    const DoubleDouble b = two_sum(end[k], -from[k]);
    if (b.high == 0) continue;
    if (a.low != 0 || b.low != 0) return false;
    if (std::abs(a.high) < min_length || std::abs(b.high) < min_length) return false;
    const DoubleDouble product = two_product(a.high, b.high), total = two_sum(sum, product.high);
    if (product.low != 0 || total.low != 0) return false;
    sum = total.high;
  }
  return sum == 0;
}

/// Is the point on the line through both, by products that doubles hold?
bool is_exactly_on_line(const Vec3& point, const Vec3& a, const Vec3& b) noexcept {
  const Vector w = difference(point, a), e = difference(b, a);
  const auto is_short = [](const DoubleDouble& x) {
    return x.low != 0 || (x.high != 0 && std::abs(x.high) < min_length);
  };
  if (std::any_of(w.begin(), w.end(), is_short) || std::any_of(e.begin(), e.end(), is_short)) return false;
  for (std::size_t k = 0; k < 3; ++k) {
    const std::size_t l = (k + 1) % 3;
    const DoubleDouble one = two_product(w[k].high, e[l].high), other = two_product(w[l].high, e[k].high);
    if (one.high != other.high || one.low != other.low) return false;
  }
  return true;
}

/// Is the point surely not in front of the plane through the corner across the way to `end`?
bool is_surely_behind_corner(const Vec3& point, const Vec3& to, double to_squared, const Vec3& corner,
                             const Vec3& end) noexcept {
  // One unit for each of the two differences, three for the products and sums.
  constexpr double relative_error = 8 * unit_roundoff;
  const Vec3 edge = end - corner;
  const int sign = sure_sign(to.dot(edge), relative_error * relative_error * to_squared * edge.squaredNorm());
  return sign < 0 || (sign == 0 && is_exactly_across(point, corner, end));
}

/// The position of a point relative to an edge.
struct EdgeSide {
  int side = 0;  ///< 1: surely off the triangle or on its edge, -1: surely over it
  bool between_ends = false;
};

/// Tells the side of the edge from corner i to the next, of which `near` is the end that `to` begins at.
EdgeSide side_of_edge(const PreparedTriangle& t, std::size_t i, std::size_t near, const Vec3& point,
                      const Vec3& to, double to_squared) noexcept {
  const std::size_t j = i == 2 ? 0 : i + 1, far = near == i ? j : i;
  const Vec3 edge = t.corner[far] - t.corner[near];
  const double edge_squared = edge.squaredNorm();
  // As in shared_nearest.cpp.
  constexpr double along_part = 8 * unit_roundoff, across_part = 16 * unit_roundoff;
  const double along_error = 2 * along_part * along_part * edge_squared * (to_squared + edge_squared);
  const double along = to.dot(edge);
  const double across_error = across_part * across_part * edge_squared * to_squared;
  const double across = (near == i ? 1 : -1) * to.cross(edge).dot(t.normal);
  EdgeSide edge_side{sure_sign(across, across_error),
                     sure_sign(along, along_error) > 0 && sure_sign(edge_squared - along, along_error) > 0};
  if (edge_side.side == 0 && edge_side.between_ends && is_exactly_on_line(point, t.corner[i], t.corner[j]))
    edge_side.side = 1;
  return edge_side;
}

bool has(const PreparedTriangle& triangle, const Vec3& corner) noexcept {
  return triangle.corner[0] == corner || triangle.corner[1] == corner || triangle.corner[2] == corner;
}

/// All the corners have this coordinate.
bool are_level(const Feature& feature, Eigen::Index axis) noexcept {
  const double first = feature.corner[0][axis];
  return feature.corner[1][axis] == first && feature.corner[2][axis] == first;
}

/// Over the face across an axis, the height is a coordinate.
SquaredDistance squared_height(const Vec3& corner, const Vec3& point, Eigen::Index axis) noexcept {
  const DoubleDouble height = two_sum(point[axis], -corner[axis]);
  if (height.high == 0) return {};
  if (std::abs(height.high) < min_length) return {{}, infinity};
  const DoubleDouble square = height * height;
  return {square, height.low == 0 ? 0 : 0x1p-100 * square.high};
}

SquaredDistance squared_off_corner(const Vec3& corner, const Vec3& point) noexcept {
  const Vector w = difference(corner, point);
  const DoubleDouble square = dot(w, w);
  bool exact = true;
  double sum = 0;
  for (const DoubleDouble& x : w) {
    const DoubleDouble own = two_product(x.high, x.high), total = two_sum(sum, own.high);
    exact = exact && x.low == 0 && own.low == 0 && total.low == 0 &&
            (x.high == 0 || std::abs(x.high) >= min_length);
    sum = total.high;
  }
  if (exact) return {{sum, 0}, 0};
  return {square, 0x1p-100 * square.high + underflow};  // 5 u^2 for each square and 3 u^2 for each sum
}

/// The error: docs/exactness.md, E7.
SquaredDistance squared_off_edge(const Feature& edge, const Vec3& point) noexcept {
  const Vec3 &p = edge.corner[0], &q = edge.corner[1];
  const double pp = (point - p).squaredNorm(), qq = (point - q).squaredNorm();
  const Vector w = difference(point, pp < qq ? p : q), e = difference(q, p);
  const Vector moment = cross(w, e);
  const DoubleDouble length = dot(e, e);
  if (!(length.high >= min_squared_edge)) return {{}, infinity};
  const DoubleDouble square = dot(moment, moment) / length;
  const double d = std::sqrt(std::abs(square.high)), nearer = std::sqrt(std::min(pp, qq));
  return {square, 0x1p-97 * d * nearer + 0x1p-194 * nearer * nearer + 0x1p-98 * d * d + underflow};
}

/// The error: docs/exactness.md, E7; `stretch` is its s.
SquaredDistance squared_over_face(const Feature& face, const Vec3& point) noexcept {
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    if (are_level(face, axis)) return squared_height(face.corner[0], point, axis);
  std::size_t near = 0;
  std::array<double, 3> squared;
  for (std::size_t i = 0; i < 3; ++i) {
    squared[i] = (point - face.corner[i]).squaredNorm();
    if (squared[i] < squared[near]) near = i;
  }
  const Vec3& a = face.corner[near];
  const Vec3 &b = face.corner[(near + 1) % 3], &c = face.corner[(near + 2) % 3];
  const Vector normal = cross(difference(b, a), difference(c, a));
  const DoubleDouble length = dot(normal, normal), along = dot(difference(point, a), normal);
  if (!(length.high >= min_squared_normal)) return {{}, infinity};
  const double stretch = std::sqrt((b - a).squaredNorm() * ((c - a).squaredNorm() / length.high));
  if (!(stretch < 0x1p40)) return {{}, infinity};
  const DoubleDouble square = along * along / length;
  const double d = std::sqrt(square.high), off = 0x1p-97 * stretch * (std::sqrt(squared[near]) + d);
  return {square, 2 * d * off + off * off + 0x1p-98 * square.high + underflow};
}

}  // namespace

std::optional<Feature> sure_feature(const PreparedTriangle& t, const Vec3& point) noexcept {
  std::array<Vec3, 3> to;
  std::array<double, 3> squared;
  std::size_t near = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    to[i] = point - t.corner[i];
    squared[i] = to[i].squaredNorm();
    if (squared[i] < squared[near]) near = i;
  }
  const std::size_t next = (near + 1) % 3, last = (near + 2) % 3;
  const auto is_behind = [&](std::size_t end) {
    return is_surely_behind_corner(point, to[near], squared[near], t.corner[near], t.corner[end]);
  };
  if (point == t.corner[near] || (is_behind(next) && is_behind(last))) return corner_at(t.corner[near]);
  bool is_over = true;
  for (std::size_t i = 0; i < 3; ++i) {
    const std::size_t j = i == 2 ? 0 : i + 1, from = squared[j] < squared[i] ? j : i;
    const EdgeSide edge_side = side_of_edge(t, i, from, point, to[from], squared[from]);
    if (edge_side.side >= 0 && edge_side.between_ends) {
      const Feature edge = edge_between(t.corner[i], t.corner[j]);
      if (edge_side.side > 0 || SharedFeature(edge, point).is_nearest_of(t)) return edge;
    }
    is_over = is_over && edge_side.side < 0;
  }
  if (is_over) return Feature{t.corner, 3};
  return std::nullopt;
}

bool is_same_location(const Feature& a, const Feature& b) noexcept {
  if (a.corners != b.corners) return false;
  const auto& [a0, a1, a2] = a.corner;
  const auto& [b0, b1, b2] = b.corner;
  if (a.corners == 1) return a0 == b0;
  std::array<bool, 3> level{};
  for (Eigen::Index k = 0; k < 3; ++k)
    level[static_cast<std::size_t>(k)] = are_level(a, k) && are_level(b, k) && a0[k] == b0[k];
  if (a.corners == 2) {
    // Along an axis, the other two coordinates are those of all the line.
    return (a0 == b0 && a1 == b1) || (a0 == b1 && a1 == b0) || level[0] + level[1] + level[2] >= 2;
  }
  // The whole feature: clang 14 lets no lambda see parts of one that have names of their own.
  const auto is_of_b = [&b](const Vec3& corner) {
    return std::find(b.corner.begin(), b.corner.end(), corner) != b.corner.end();
  };
  return level[0] || level[1] || level[2] || (is_of_b(a0) && is_of_b(a1) && is_of_b(a2));
}

SquaredDistance squared_distance(const Feature& feature, const Vec3& point) noexcept {
  if (feature.corners == 1) return squared_off_corner(feature.corner[0], point);
  return feature.corners == 2 ? squared_off_edge(feature, point) : squared_over_face(feature, point);
}

SquaredDistance squared(double radius) noexcept {
  if (radius == 0) return {};
  if (!(radius >= min_length && radius <= 0x1p150)) return {{}, infinity};
  return {two_product(radius, radius), 0};
}

std::partial_ordering compare(const SquaredDistance& a, const SquaredDistance& b) noexcept {
  const double error = a.error + b.error;
  if (!(error < infinity)) return std::partial_ordering::unordered;
  if (error == 0) {
    const std::partial_ordering order = a.value.high <=> b.value.high;
    return order != 0 ? order : a.value.low <=> b.value.low;
  }
  const double difference = (a.value.high - b.value.high) + (a.value.low - b.value.low);
  // Twice: with room for the roundings of the difference itself.
  return std::abs(difference) > 2 * error ? difference <=> 0 : std::partial_ordering::unordered;
}

SharedFeature::SharedFeature(const Feature& feature, const Vec3& point) noexcept : feature_(feature) {
  const Vec3& from = feature.corner[0];
  if (feature.corners == 1) {
    offset_ = point - from;
    is_exact_ = true;
    for (Eigen::Index k = 0; k < 3; ++k) is_exact_ = is_exact_ && two_sum(point[k], -from[k]).low == 0;
    return;
  }
  is_known_ = feature.corners == 2;
  if (!is_known_) return;
  const Vec3& end = feature.corner[1];
  const bool first = (point - from).squaredNorm() <= (point - end).squaredNorm();
  const Vector w = difference(point, first ? from : end),
               e = difference(first ? end : from, first ? from : end);
  const DoubleDouble length = dot(e, e);
  is_known_ = length.high >= min_squared_edge;
  if (!is_known_) return;
  const DoubleDouble part = dot(w, e) / length;
  for (std::size_t k = 0; k < 3; ++k) offset_[static_cast<Eigen::Index>(k)] = (w[k] - e[k] * part).rounded();
  // Along an axis, the offset is what the other two coordinates differ by.
  for (Eigen::Index k = 0; k < 3; ++k) {
    const auto is_level = [&](Eigen::Index axis) {
      return are_level(feature_, axis) && two_sum(point[axis], -from[axis]).low == 0;
    };
    if (!is_level((k + 1) % 3) || !is_level((k + 2) % 3)) continue;
    offset_ = point - from;
    offset_[k] = 0;
    is_exact_ = true;
    return;
  }
  // Off by 2^-96 |w| at most in each coordinate, so by 2^-94 of the largest one of w.
  const double nearer = std::max({std::abs(w[0].high), std::abs(w[1].high), std::abs(w[2].high)});
  const double largest = offset_.cwiseAbs().maxCoeff();
  is_known_ = largest > 0x1p-80 * nearer;
  if (is_known_) relative_error_ += 0x1p-94 * nearer / largest;
  if (is_known_ || !is_exactly_on_line(point, from, end)) return;
  // It is on the edge: so it is on whatever has that.
  is_known_ = is_exact_ = true;
  offset_ = Vec3::Zero();
}

/// Behind the plane through the nearest point across the way to the point is nothing nearer.
bool SharedFeature::is_surely_behind(const Vec3& corner) const noexcept {
  // An edge's true offset is across it, so that either end will do: the nearer one to the corner.
  if (is_exact_ && offset_.isZero(0)) return true;
  const Vec3 from_first = corner - feature_.corner[0], from_second = corner - feature_.corner[1];
  const Vec3& to_corner = from_second.squaredNorm() < from_first.squaredNorm() ? from_second : from_first;
  const double along = to_corner.dot(offset_), squared = to_corner.squaredNorm();
  const int sign = sure_sign(along, relative_error_ * relative_error_ * squared * offset_.squaredNorm());
  if (sign != 0 || !is_exact_) return sign < 0;
  const Vec3& from = feature_.corner[0];
  const Vec3 point = from + offset_;
  return point - from == offset_ && is_exactly_across(point, from, corner);
}

bool SharedFeature::is_nearest_of(const PreparedTriangle& triangle) const noexcept {
  for (int i = 0; i < feature_.corners; ++i)
    if (!has(triangle, feature_.corner[static_cast<std::size_t>(i)])) return false;
  if (feature_.corners == 3) {
    // All of one are of the other; a corner of the other that is not would have taken the place of one.
    return std::all_of(triangle.corner.begin(), triangle.corner.end(), [&](const Vec3& corner) {
      return corner == feature_.corner[0] || corner == feature_.corner[1] || corner == feature_.corner[2];
    });
  }
  if (!is_known_) return false;
  return std::all_of(triangle.corner.begin(), triangle.corner.end(), [&](const Vec3& corner) {
    return corner == feature_.corner[0] || corner == feature_.corner[1] || is_surely_behind(corner);
  });
}

}  // namespace touchmark
