/// Scenes in rational arithmetic: every vertex transformed as it is stored, every distance a quotient of
/// whole numbers. Shares nothing with core but the numbers that it is given.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <vector>

#include <gmpxx.h>

#include "core/probe.h"
#include "core/scene/pose.h"
#include "core/triangle_mesh.h"

namespace touchmark::exact_scene {

using Number = mpq_class;

struct Point {
  Number x, y, z;
};
inline Point operator-(const Point& a, const Point& b) {
  return {Number(a.x - b.x), Number(a.y - b.y), Number(a.z - b.z)};
}
inline Point operator+(const Point& a, const Point& b) {
  return {Number(a.x + b.x), Number(a.y + b.y), Number(a.z + b.z)};
}
inline Point operator*(const Number& s, const Point& a) {
  return {Number(s * a.x), Number(s * a.y), Number(s * a.z)};
}
inline Number dot(const Point& a, const Point& b) { return Number(a.x * b.x + a.y * b.y + a.z * b.z); }
inline Point cross(const Point& a, const Point& b) {
  return {Number(a.y * b.z - a.z * b.y), Number(a.z * b.x - a.x * b.z), Number(a.x * b.y - a.y * b.x)};
}
inline Point exactly(const Vec3& v) { return {Number(v.x()), Number(v.y()), Number(v.z())}; }
inline Point exact_image(const Pose& pose, const Vec3& v) {
  const Point x = exactly(v);
  const auto row = [&](int i) { return dot(exactly(pose.rotation.row(i).transpose()), x); };
  return Point{row(0), row(1), row(2)} + exactly(pose.translation);
}
using Triangle = std::array<Point, 3>;

/// Returns the square of the distance from the origin to the segment.
inline Number squared_to_segment(const Point& a, const Point& b) {
  const Point edge = b - a;
  const Number length = dot(edge, edge);
  Number t = length == 0 ? Number(0) : Number(-dot(a, edge) / length);
  if (t < 0) t = 0;
  if (t > 1) t = 1;
  const Point foot = a + t * edge;
  return dot(foot, foot);
}

/// Returns the square of the distance from the point, by the plane's foot in barycentric coordinates.
inline Number squared_distance(const Triangle& triangle, const Point& p) {
  const Point a = triangle[0] - p, b = triangle[1] - p, c = triangle[2] - p;
  Number best = std::min({squared_to_segment(a, b), squared_to_segment(b, c), squared_to_segment(c, a)});
  const Point u = b - a, v = c - a;
  const Number uu = dot(u, u), uv = dot(u, v), vv = dot(v, v), au = -dot(a, u), av = -dot(a, v);
  const Number determinant = uu * vv - uv * uv;
  if (determinant != 0) {
    const Number s = (au * vv - av * uv) / determinant, t = (av * uu - au * uv) / determinant;
    if (s >= 0 && t >= 0 && s + t <= 1) {
      const Point foot = a + s * u + t * v;
      best = std::min(best, dot(foot, foot));
    }
  }
  return best;
}

/// Returns the square of the distance between two segments, the first from the origin along `d`.
inline Number squared_between(const Point& d, const Point& a, const Point& b) {
  const Point e = b - a;
  const auto from_point = [&](const Point& p) { return squared_to_segment(a - p, b - p); };
  Number best = std::min(from_point({0, 0, 0}), from_point(d));
  for (const Point& end : {a, b}) best = std::min(best, squared_to_segment(Point{0, 0, 0} - end, d - end));
  const Number dd = dot(d, d), de = dot(d, e), ee = dot(e, e), da = dot(d, a), ea = dot(e, a);
  const Number determinant = dd * ee - de * de;
  if (determinant != 0) {
    const Number s = (da * ee - ea * de) / determinant, t = (da * de - ea * dd) / determinant;
    if (s >= 0 && s <= 1 && t >= 0 && t <= 1) {
      const Point way = a + t * e - s * d;
      best = std::min(best, dot(way, way));
    }
  }
  return best;
}

/// Returns the square of the distance from the segment to the triangle.
inline Number squared_distance(const Triangle& triangle, const Point& from, const Point& to) {
  const Point d = to - from, a = triangle[0] - from, b = triangle[1] - from, c = triangle[2] - from;
  Number best = std::min(squared_distance(triangle, from), squared_distance(triangle, to));
  best = std::min({best, squared_between(d, a, b), squared_between(d, b, c), squared_between(d, c, a)});
  const Point u = b - a, v = c - a, normal = cross(u, v);
  const Number across = dot(d, normal);
  if (across != 0) {
    const Number at = dot(a, normal) / across;
    if (at >= 0 && at <= 1 && squared_distance({a, b, c}, at * d) == 0) best = 0;
  }
  return best;
}

struct Body {
  std::uint32_t index = 0;
  const TriangleMesh* mesh = nullptr;
  Pose pose;
};

struct Nearest {
  std::uint32_t body = 0;
  TriangleId triangle = 0;
  Number squared;
};

inline Triangle triangle_of(const Body& body, std::size_t i) {
  return {exact_image(body.pose, body.mesh->corner(i, 0)), exact_image(body.pose, body.mesh->corner(i, 1)),
          exact_image(body.pose, body.mesh->corner(i, 2))};
}

/// Bounds the distance from below in long double, generously: saves the rational one for what can matter.
inline long double lower_bound(const Body& body, std::size_t triangle, const Vec3& point) {
  long double least = 1e4000L, size = 0, extent = 0;
  using Wide = Eigen::Matrix<long double, 3, 1>;
  std::array<Wide, 3> corner;
  for (int k = 0; k < 3; ++k) {
    const Wide image =
        body.pose.rotation.cast<long double>() * body.mesh->corner(triangle, k).cast<long double>() +
        (body.pose.translation.cast<long double>() - point.cast<long double>());
    corner[static_cast<std::size_t>(k)] = image;
    least = std::min(least, image.norm());
    size = std::max(size, body.mesh->corner(triangle, k).cast<long double>().norm() + image.norm());
  }
  extent = std::max((corner[1] - corner[0]).norm(), (corner[2] - corner[0]).norm()) +
           (corner[2] - corner[1]).norm();
  return least - extent - 1e-12L * size;
}

/// The nearest triangle; of several at the same distance the lowest body's lowest one. `bodies` by index.
inline std::optional<Nearest> nearest(const std::vector<Body>& bodies, const Vec3& point) {
  std::optional<Nearest> best;
  long double upper = 1e4000L;
  const Point p = exactly(point);
  for (const Body& body : bodies) {
    for (std::size_t i = 0; i < body.mesh->size(); ++i) {
      if (lower_bound(body, i, point) > upper) continue;
      const Number squared = squared_distance(triangle_of(body, i), p);
      if (best && !(squared < best->squared)) continue;
      best = Nearest{body.index, body.mesh->id(i), squared};
      upper = std::sqrt(static_cast<long double>(squared.get_d())) * (1 + 1e-9L) + 1e-300L;
    }
  }
  return best;
}

/// Returns how many triangles are within the radius. Exact.
inline std::size_t count_within(const std::vector<Body>& bodies, const Vec3& point, double radius) {
  const Point p = exactly(point);
  std::size_t count = 0;
  for (const Body& body : bodies)
    for (std::size_t i = 0; i < body.mesh->size(); ++i)
      if (!(lower_bound(body, i, point) > static_cast<long double>(radius)) &&
          squared_distance(triangle_of(body, i), p) <= Number(radius) * Number(radius))
        ++count;
  return count;
}

/// Is some triangle within the radius of the way as far as this fraction? The point there is not rounded.
inline bool comes_within(const std::vector<Body>& bodies, const Vec3& from, const Vec3& to, double fraction,
                         const Number& radius) {
  const Point p = exactly(from), q = p + Number(fraction) * (exactly(to) - p);
  if (radius < 0) return false;
  const long double length = (to - from).cast<long double>().norm() * (1 + 1e-9L);
  for (const Body& body : bodies)
    for (std::size_t i = 0; i < body.mesh->size(); ++i)
      if (!(lower_bound(body, i, from) > length + static_cast<long double>(radius.get_d())) &&
          squared_distance(triangle_of(body, i), p, q) <= radius * radius)
        return true;
  return false;
}

}  // namespace touchmark::exact_scene
