#include "bench/oracle/exact/exact_winding.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <limits>
#include <map>
#include <utility>

#include <Eigen/Geometry>

#include "bench/oracle/exact/exact_distance.h"
#include "bench/oracle/exact/exact_integers.h"
#include "bench/support/random.h"

namespace touchmark::bench::oracle {
namespace {

using exact::Grid;
using exact::Integer;
using exact::Vector;

/// No coordinate beyond 2^20, so that doubles and integers hold it alike.
using Direction = std::array<int, 3>;

Direction draw(support::Random& random) {
  const auto coordinate = [&] { return static_cast<int>(random.below(1 << 21)) - (1 << 20); };
  const int x = coordinate(), y = coordinate(), z = coordinate();
  return {x, y, z | 1};
}

bool may_contain(const Triangle& t, const Vec3& p) {
  for (int k = 0; k < 3; ++k)
    if (p[k] < std::min({t[0][k], t[1][k], t[2][k]}) || p[k] > std::max({t[0][k], t[1][k], t[2][k]}))
      return false;
  return true;
}

/// Returns true if doubles show that the line misses the triangle, by their signs of direction . (w_i x w_j),
/// two of them surely opposite.
bool surely_missed(const Triangle& t, const Vec3& p, const Direction& direction) {
  constexpr double roundings = 16 * std::numeric_limits<double>::epsilon();
  const Vec3 along(direction[0], direction[1], direction[2]);
  bool left = false, right = false;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3 a = t[i] - p, b = t[(i + 1) % 3] - p;
    const double value = along.dot(a.cross(b)), size = along.norm() * a.norm() * b.norm();
    if (!(size > 1e-250 && size < 1e250)) return false;
    left = left || value > roundings * size;
    right = right || value < -roundings * size;
  }
  return left && right;
}

enum class Meeting { none, outwards, inwards, edge };

/// How the ray meets a triangle that the point is not on.
Meeting meeting(const Triangle& t, const Vec3& p, const Direction& direction) {
  if (surely_missed(t, p, direction)) return Meeting::none;
  const Grid grid(p, t);
  const Vector origin = grid(p);
  const std::array<Vector, 3> w = {grid(t[0]) - origin, grid(t[1]) - origin, grid(t[2]) - origin};
  const Vector along{Integer(direction[0]), Integer(direction[1]), Integer(direction[2])};
  const Vector normal = cross(w[1] - w[0], w[2] - w[0]);
  if (is_zero(normal)) return Meeting::none;
  int most = -1, least = 1;
  for (std::size_t i = 0; i < 3; ++i) {
    const int side = sgn(dot(along, cross(w[i], w[(i + 1) % 3])));
    most = std::max(most, side);
    least = std::min(least, side);
  }
  if (most > 0 && least < 0) return Meeting::none;
  const int ahead = sgn(dot(w[0], normal)), facing = sgn(dot(along, normal));
  if (most == least && facing != 0) {
    if (ahead != facing) return Meeting::none;  // behind the point
    return facing > 0 ? Meeting::outwards : Meeting::inwards;
  }
  return Meeting::edge;
}

std::optional<int> along_ray(const Vec3& p, std::span<const Triangle> triangles, const Direction& direction) {
  int winding = 0;
  for (const Triangle& t : triangles) {
    switch (meeting(t, p, direction)) {
      case Meeting::none:
        break;
      case Meeting::outwards:
        ++winding;
        break;
      case Meeting::inwards:
        --winding;
        break;
      case Meeting::edge:
        return std::nullopt;
    }
  }
  return winding;
}

/// Sides that run one way cancel those that run back. (-0 and 0 are one position.)
bool is_closed(std::span<const Triangle> triangles) {
  using Coordinates = std::array<double, 3>;
  const auto coordinates = [](const Vec3& v) { return Coordinates{v.x() + 0.0, v.y() + 0.0, v.z() + 0.0}; };
  std::map<std::pair<Coordinates, Coordinates>, int> balance;
  for (const Triangle& t : triangles) {
    for (std::size_t i = 0; i < 3; ++i) {
      const Coordinates a = coordinates(t[i]), b = coordinates(t[(i + 1) % 3]);
      if (a < b) ++balance[{a, b}];
      if (b < a) --balance[{b, a}];
    }
  }
  return std::ranges::all_of(balance, [](const auto& edge) { return edge.second == 0; });
}

/// About the first corner; a closed surface has the same volume about any point.
bool has_negative_volume(std::span<const Triangle> triangles) {
  Grid grid;
  for (const Triangle& t : triangles) grid.add(t);
  const Vector origin = grid(triangles.front()[0]);
  Integer six_volumes = 0;
  for (const Triangle& t : triangles)
    six_volumes += dot(grid(t[0]) - origin, cross(grid(t[1]) - origin, grid(t[2]) - origin));
  return six_volumes < 0;
}

}  // namespace

std::optional<int> winding_exactly(const Vec3& point, std::span<const Triangle> triangles) {
  for (const Triangle& t : triangles)
    if (may_contain(t, point) && compare_distance(point, t, 0) == 0) return std::nullopt;
  support::Random random(20);
  for (;;) {
    const std::optional<int> winding = along_ray(point, triangles, draw(random));
    if (winding) return winding;
  }
}

ExactSides::ExactSides(const TriangleMesh& mesh) {
  for (std::uint32_t t = 0; t < mesh.size(); ++t) triangles_.push_back(triangle_of(mesh, t));
  closed_ = is_closed(triangles_);
  inside_out_ = closed_ && has_negative_volume(triangles_);
}

Side ExactSides::side(const Vec3& point) const {
  const std::optional<int> winding = winding_exactly(point, triangles_);
  if (!winding) return Side::on_surface;
  if (*winding == 0) return inside_out_ ? Side::inside : Side::outside;
  if ((*winding < 0) != inside_out_) return Side::undecided;
  return inside_out_ ? Side::outside : Side::inside;
}

}  // namespace touchmark::bench::oracle
