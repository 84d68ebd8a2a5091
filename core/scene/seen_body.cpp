#include "core/scene/seen_body.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/exact/double_double.h"
#include "core/float_limits.h"
#include "core/simd/dispatch.h"
#include "core/simd/target.h"

#if TOUCHMARK_HAS_AVX2
#include <immintrin.h>

#include "core/geometry/edge_cross.h"
#include "core/geometry/point_triangle_avx2.h"
#endif

namespace touchmark {
namespace {

/// A sum of absolute values is no less than the norm, and takes no root.
double length_above(const Vec3& v) noexcept { return v.cwiseAbs().sum(); }

/// The corners' places in both triangles where they are the same stored point.
struct SharedCorner {
  std::size_t in_a, in_b;
};

/// Is the corner surely the nearest point? All others lie behind the plane through it across the way to it.
bool corner_is_nearest(const SeenTriangle& seen, std::size_t corner) noexcept {
  const double margin = 8 * seen.error * seen.largest;
  const Vec3& w = seen.corner[corner];
  for (std::size_t other = 0; other < 3; ++other)
    if (other != corner && !((seen.corner[other] - w).dot(w) > margin)) return false;
  return true;
}

/// Is a point inside the edge between two corners surely nearest? The foot is between them, and the third
/// corner is behind the plane through the foot.
bool edge_is_nearest(const SeenTriangle& seen, std::size_t from, std::size_t to) noexcept {
  const Vec3& w = seen.corner[from];
  const Vec3 edge = seen.corner[to] - w, third = seen.corner[3 - from - to] - w;
  const double squared = edge.squaredNorm(), along = -w.dot(edge);
  const double margin = 8 * seen.error * seen.largest;
  if (!(along > margin && squared - along > margin)) return false;
  const Vec3 foot = squared * w + along * edge;  // times the square of the edge's length
  return third.dot(foot) > 64 * seen.error * seen.largest * seen.largest * std::sqrt(squared);
}

/// Returns the way from the point to the image of what it is in the body's frame, nearly exact.
Vec3 rest_of(const Pose& pose, const Vec3& center, const Vec3& point) noexcept {
  Vec3 rest;
  for (int k = 0; k < 3; ++k) {
    // A compensated sum (Ogita, Rump and Oishi 2005): what each step rounds off is added at the end.
    DoubleDouble sum = two_sum(pose.translation[k], -point[k]);
    for (int j = 0; j < 3; ++j) {
      const DoubleDouble product = two_product(pose.rotation(k, j), center[j]);
      const DoubleDouble next = two_sum(sum.high, product.high);
      sum = {next.high, sum.low + (next.low + product.low)};
    }
    rest[k] = sum.rounded();
  }
  return rest;
}

/// Writes where the corners are as seen from the point. Returns the square of the longest of these ways and
/// of those in the body's frame.
double see(const TriangleCorners& triangle, const Vec3& center, const Eigen::Matrix3d& rotation,
           const Vec3& rest, TriangleCorners& seen) noexcept {
  double squared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 way = triangle[i] - center;
    seen[i] = rotation * way + rest;
    squared = std::max({squared, way.squaredNorm(), seen[i].squaredNorm()});
  }
  return squared;
}

}  // namespace
}  // namespace touchmark

#if TOUCHMARK_HAS_AVX2
TOUCHMARK_TARGET("avx2")
namespace touchmark::avx2 {
namespace {

/// Returns what touchmark::rest_of does, bit for bit: an axis a lane.
Vec3 rest_of(const Pose& pose, const Vec3& center, const Vec3& point) noexcept {
  DoubleDoubles sum = two_sums(axes_of(pose.translation), -axes_of(point));
  for (int j = 0; j < 3; ++j) {
    const DoubleDoubles product = two_products(axes_of(pose.rotation.col(j)), all(center[j]));
    const DoubleDoubles next = two_sums(sum.high, product.high);
    sum = {next.high, sum.low + (next.low + product.low)};
  }
  alignas(32) std::array<double, 4> rest;
  _mm256_store_pd(rest.data(), sum.high + sum.low);
  return {rest[0], rest[1], rest[2]};
}

/// Does what touchmark::see does, bit for bit: a corner a lane.
double see(const TriangleCorners& triangle, const Vec3& center, const Eigen::Matrix3d& rotation,
           const Vec3& rest, TriangleCorners& seen) noexcept {
  const auto lanes = [&](int axis) {
    return _mm256_set_pd(0, triangle[2][axis], triangle[1][axis], triangle[0][axis]);
  };
  const QuadVec way =
      minus({lanes(0), lanes(1), lanes(2)}, {all(center.x()), all(center.y()), all(center.z())});
  const auto product = [&](int row, int column) {
    return _mm256_mul_pd(all(rotation(row, column)), column == 0 ? way.x : column == 1 ? way.y : way.z);
  };
  // Eigen takes the first two rows as a packet, from the first product on, and the last row from the last
  // one.
  const auto image = [&](int row) {
    const Quad middle = product(row, 1);
    const Quad sum = row < 2 ? _mm256_add_pd(_mm256_add_pd(product(row, 0), middle), product(row, 2))
                             : _mm256_add_pd(product(row, 0), _mm256_add_pd(middle, product(row, 2)));
    return _mm256_add_pd(sum, all(rest[row]));
  };
  const QuadVec at = {image(0), image(1), image(2)};
  alignas(32) std::array<double, 4> x, y, z, in_body, in_scene;
  _mm256_store_pd(x.data(), at.x);
  _mm256_store_pd(y.data(), at.y);
  _mm256_store_pd(z.data(), at.z);
  _mm256_store_pd(in_body.data(), dot(way, way));
  _mm256_store_pd(in_scene.data(), dot(at, at));
  double squared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    seen[i] = {x[i], y[i], z[i]};
    squared = std::max({squared, in_body[i], in_scene[i]});
  }
  return squared;
}

}  // namespace
}  // namespace touchmark::avx2
TOUCHMARK_END_TARGET
#endif

namespace touchmark {

SeenBody::SeenBody(const Pose& pose, double rigid, const Vec3& point) noexcept
    : pose_(&pose), point_(&point), rigid_(rigid), center_(in_frame(pose, point)) {
  // The image of `center` is off the point by R R^T - I times the way from the body's origin, by its seven
  // roundings, and by underflow.
  residue_ = (1.01 * rigid + 8 * unit_roundoff) * (point - pose.translation).norm() + 0x1p-900;
}

DistanceInterval SeenBody::in_scene(double distance, double error) const noexcept {
  const double off = rigid_ * (distance + error) + error + residue_;
  const double rounding = 8 * unit_roundoff * (distance + off);
  return {distance - off - rounding, distance + off + rounding};
}

double SeenBody::reach_in_frame(double reach, double error) const noexcept {
  return (reach + residue_) * (1 + 1.01 * rigid_ + 16 * unit_roundoff) + error;
}

double SeenBody::slack(double distance) const noexcept {
  // Each is off by what in_scene takes for an exact distance, and its rounding.
  return 2.1 * (rigid_ * distance + residue_ + 16 * unit_roundoff * distance);
}

double SeenBody::surely_within(double reach, double error) const noexcept {
  return (reach - residue_) * (1 - 1.01 * rigid_ - 16 * unit_roundoff) - error;
}

SeenCorners::SeenCorners(const Pose& pose, const Vec3& center, const Vec3& point) noexcept
    : pose_(&pose), center_(center) {
#if TOUCHMARK_HAS_AVX2
  rest_ = has_avx2 ? avx2::rest_of(pose, center, point) : rest_of(pose, center, point);
#else
  rest_ = rest_of(pose, center, point);
#endif
  const double scale = length_above(center) + length_above(pose.translation) + length_above(point);
  // Above that, double-doubles lose their lower halves.
  constexpr double largest = 0x1p900;
  rest_error_ = scale < largest ? 2 * unit_roundoff * length_above(rest_) + 0x1p-98 * scale + 0x1p-960
                                : std::numeric_limits<double>::infinity();
}

SeenTriangle SeenCorners::operator()(const TriangleCorners& triangle) const noexcept {
  SeenTriangle seen;
#if TOUCHMARK_HAS_AVX2
  const double squared = has_avx2 ? avx2::see(triangle, center_, pose_->rotation, rest_, seen.corner)
                                  : see(triangle, center_, pose_->rotation, rest_, seen.corner);
#else
  const double squared = see(triangle, center_, pose_->rotation, rest_, seen.corner);
#endif
  const double longest = std::sqrt(squared);
  seen.largest = longest;
  const bool fits = longest >= 0x1p-132 && longest <= 0x1p231;
  seen.error = fits ? error_at(longest) : std::numeric_limits<double>::infinity();
  return seen;
}

double SeenCorners::error_at(double longest) const noexcept {
  // One rounding of the way, three of each product's row and one of the sum: below 8 u of its length.
  return 8.1 * unit_roundoff * longest + rest_error_;
}

bool surely_tied(const TriangleCorners& a, const SeenTriangle& seen_a, const TriangleCorners& b,
                 const SeenTriangle& seen_b) noexcept {
  std::array<SharedCorner, 3> shared{};
  std::size_t count = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    for (std::size_t j = 0; j < 3 && count < shared.size(); ++j) {
      if (a[i] != b[j]) continue;
      shared[count++] = {i, j};
      break;
    }
  }
  if (count == 3) {
    const auto is_in_a = [&](const Vec3& corner) { return std::find(a.begin(), a.end(), corner) != a.end(); };
    if (std::all_of(b.begin(), b.end(), is_in_a)) return true;
  }
  for (std::size_t i = 0; i < count; ++i) {
    if (corner_is_nearest(seen_a, shared[i].in_a) && corner_is_nearest(seen_b, shared[i].in_b)) return true;
    for (std::size_t j = 0; j < i; ++j) {
      if (shared[i].in_b == shared[j].in_b) continue;
      if (edge_is_nearest(seen_a, shared[i].in_a, shared[j].in_a) &&
          edge_is_nearest(seen_b, shared[i].in_b, shared[j].in_b))
        return true;
    }
  }
  return false;
}

}  // namespace touchmark
