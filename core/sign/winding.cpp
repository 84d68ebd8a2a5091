#include "core/sign/winding.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "core/exact/distance_predicates.h"
#include "core/exact/orientation.h"
#include "core/float_limits.h"

namespace touchmark::sign {
namespace {

int sign(double x) noexcept { return x > 0 ? 1 : x < 0 ? -1 : 0; }

/// The side of a to b that (p.x + e, p.y + e^2) is on, for the smallest of all e; 0 only where a is above b.
int side_aside(const Vec3& a, const Vec3& b, const Vec3& p) noexcept {
  const int side = side_of_line_xy(a, b, p);
  if (side != 0) return side;
  // The determinant grows by (a.y - b.y) e + (b.x - a.x) e^2.
  return a.y() != b.y() ? sign(a.y() - b.y()) : sign(b.x() - a.x());
}

/// 1 where the vertical line meets the triangle and it faces up, -1 where it faces down, else 0.
int facing(const TriangleCorners& t, const Vec3& p) noexcept {
  const int first = side_aside(t[0], t[1], p);
  if (first == 0 || side_aside(t[1], t[2], p) != first || side_aside(t[2], t[0], p) != first) return 0;
  return first;
}

double largest_z(const TriangleCorners& t) noexcept { return std::max({t[0].z(), t[1].z(), t[2].z()}); }

bool in_box(const TriangleCorners& t, const Vec3& p) noexcept {
  return (p.array() >= t[0].cwiseMin(t[1]).cwiseMin(t[2]).array()).all() &&
         (p.array() <= t[0].cwiseMax(t[1]).cwiseMax(t[2]).array()).all();
}

}  // namespace

Winding::Winding(const TriangleMesh& mesh, std::vector<std::array<Vec3, 2>> open_edges)
    : tree_(mesh), open_edges_(std::move(open_edges)) {}

std::optional<int> Winding::count(const Vec3& p) const noexcept {
  int count = 0;
  bool on_surface = false;
  const auto below_point = [&](const Aabb& box) {
    return box.min.x() <= p.x() && p.x() <= box.max.x() && box.min.y() <= p.y() && p.y() <= box.max.y() &&
           box.min.z() <= p.z();
  };
  tree_.visit(below_point, [&](const TriangleTree::Item& item) {
    const TriangleCorners& t = item.corner;
    if (on_surface || std::min({t[0].z(), t[1].z(), t[2].z()}) > p.z()) return;
    int side = 0;
    if (in_box(t, p)) {
      side = side_of_plane(t[0], t[1], t[2], p);
      if (side == 0 && within_exactly(t, p, 0)) {
        on_surface = true;
        return;
      }
    }
    const int up = facing(t, p);
    if (up == 0) return;
    // The point is over or under it; a box that is lower leaves no question.
    if (largest_z(t) >= p.z() && side == 0) side = side_of_plane(t[0], t[1], t[2], p);
    if (largest_z(t) < p.z() || side == up) count -= up;
  });
  if (on_surface) return std::nullopt;
  return count;
}

Winding::Share Winding::of_curtains(const Vec3& p) const noexcept {
  constexpr double whole = 4 * std::numbers::pi;
  Share sum;
  for (const auto& [from, to] : open_edges_) {
    // The curtain runs back along the edge and up: a triangle with its third corner at infinity.
    const Vec3 b = to - p, a = from - p;
    const double length_a = a.norm(), length_b = b.norm();
    const double across = std::abs(b.x() * a.y() - b.y() * a.x());
    const double along = length_a * length_b + a.dot(b) + b.z() * length_a + a.z() * length_b;
    const double angle = 2 * std::atan2(across, along);
    sum.value -= side_aside(from, to, p) * angle / whole;
    // Each of the two is off by at most this, the angle by that over the distance from the origin, and not by
    // more than all.
    const double term_error = 24 * unit_roundoff * length_a * length_b;
    const double size = std::hypot(across, along);
    sum.error += size > 2 * term_error ? 4 * term_error / size / whole + 4 * unit_roundoff : 1;
  }
  return sum;
}

}  // namespace touchmark::sign
