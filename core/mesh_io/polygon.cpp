#include "core/mesh_io/polygon.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Geometry>

namespace touchmark::mesh_io {
namespace {

using Point2 = Eigen::Vector2d;

/// Twice the signed area of (a, b, c).
double turn(const Point2& a, const Point2& b, const Point2& c) {
  return (b.x() - a.x()) * (c.y() - a.y()) - (b.y() - a.y()) * (c.x() - a.x());
}

/// The polygon seen along the largest component of its (Newell) normal, counter-clockwise.
std::vector<Point2> flattened(const std::vector<Vec3>& vertices, const std::vector<std::uint32_t>& corners) {
  Vec3 normal = Vec3::Zero();
  const Vec3& origin = vertices[corners[0]];
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Vec3 a = vertices[corners[i]] - origin, b = vertices[corners[(i + 1) % corners.size()]] - origin;
    normal += a.cross(b);
  }
  int drop = 0;
  normal.cwiseAbs().maxCoeff(&drop);
  const int u = (drop + 1) % 3, v = (drop + 2) % 3;
  std::vector<Point2> points;
  points.reserve(corners.size());
  for (const std::uint32_t corner : corners) {
    const Vec3 p = vertices[corner] - origin;
    points.emplace_back(normal[drop] < 0 ? p[v] : p[u], normal[drop] < 0 ? p[u] : p[v]);
  }
  return points;
}

bool is_ear(const std::vector<Point2>& points, const std::vector<std::size_t>& ring, std::size_t at) {
  const std::size_t n = ring.size();
  const Point2 &a = points[ring[(at + n - 1) % n]], &b = points[ring[at]], &c = points[ring[(at + 1) % n]];
  if (!(turn(a, b, c) > 0)) return false;
  for (const std::size_t other : ring) {
    const Point2& p = points[other];
    if (p == a || p == b || p == c) continue;
    if (turn(a, b, p) >= 0 && turn(b, c, p) >= 0 && turn(c, a, p) >= 0) return false;
  }
  return true;
}

}  // namespace

std::vector<PolygonTriangle> clipped_ears(const std::vector<Vec3>& vertices,
                                          const std::vector<std::uint32_t>& corners) {
  const std::vector<Point2> points = flattened(vertices, corners);
  std::vector<std::size_t> ring(corners.size());
  std::iota(ring.begin(), ring.end(), std::size_t{0});
  std::vector<PolygonTriangle> triangles;
  triangles.reserve(corners.size() - 2);
  std::size_t at = 0, since_last_ear = 0;
  while (ring.size() > 3) {
    // No ear left: the polygon crosses itself or has no area; what remains becomes a fan.
    const bool stuck = since_last_ear >= ring.size();
    if (stuck || is_ear(points, ring, at)) {
      const std::size_t n = ring.size();
      triangles.push_back({ring[(at + n - 1) % n], ring[at], ring[(at + 1) % n]});
      ring.erase(ring.begin() + static_cast<std::ptrdiff_t>(at));
      at %= ring.size();
      since_last_ear = 0;
    } else {
      at = (at + 1) % ring.size();
      ++since_last_ear;
    }
  }
  triangles.push_back({ring[0], ring[1], ring[2]});
  return triangles;
}

std::vector<PolygonTriangle> fan(const std::vector<Vec3>& vertices,
                                 const std::vector<std::uint32_t>& corners) {
  const std::vector<Point2> points = flattened(vertices, corners);  // the first is the origin
  double extent = 0;
  for (const Point2& p : points) extent = std::max(extent, p.lpNorm<Eigen::Infinity>());
  // Twice what rounding to single precision moves a corner, seen from another that it moves as well.
  const double error = 2.0 * std::numeric_limits<float>::epsilon() * extent;
  std::vector<PolygonTriangle> triangles;
  triangles.reserve(corners.size() - 2);
  for (std::size_t i = 1; i + 1 < points.size(); ++i) {
    if (!(turn(points[0], points[i], points[i + 1]) >= -error * points[i].norm())) return {};
    triangles.push_back({0, i, i + 1});
  }
  return triangles;
}

}  // namespace touchmark::mesh_io
