#include "core/scene/seen_body.h"

#include <algorithm>
#include <cmath>
#include <cstddef>

#include "core/exact/double_double.h"

namespace touchmark {
namespace {

constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2;

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

}  // namespace

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

SeenCorners::SeenCorners(const SeenBody& body) noexcept : body_(&body) {
  const Pose& pose = body.pose();
  for (int k = 0; k < 3; ++k) {
    // A compensated sum (Ogita, Rump and Oishi 2005): what each step rounds off is added at the end.
    DoubleDouble sum = two_sum(pose.translation[k], -body.point()[k]);
    for (int j = 0; j < 3; ++j) {
      const DoubleDouble product = two_product(pose.rotation(k, j), body.center()[j]);
      const DoubleDouble next = two_sum(sum.high, product.high);
      sum = {next.high, sum.low + (next.low + product.low)};
    }
    rest_[k] = sum.rounded();
  }
  const double scale =
      length_above(body.center()) + length_above(pose.translation) + length_above(body.point());
  // Above that, double-doubles lose their lower halves.
  constexpr double largest = 0x1p900;
  rest_error_ = scale < largest ? 2 * unit_roundoff * length_above(rest_) + 0x1p-98 * scale + 0x1p-960
                                : std::numeric_limits<double>::infinity();
}

SeenTriangle SeenCorners::operator()(const TriangleCorners& triangle) const noexcept {
  SeenTriangle seen;
  double squared = 0;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 way = triangle[i] - body_->center();
    seen.corner[i] = body_->pose().rotation * way + rest_;
    squared = std::max({squared, way.squaredNorm(), seen.corner[i].squaredNorm()});
  }
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
