/// Bodies that move along screws, and distances to them at any time, in long double by formulas of its own.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Dense>

#include "core/scene/pose.h"
#include "core/scene/shape.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "core/triangle_mesh.h"

namespace touchmark::test {

using Real = long double;
using Point = Eigen::Matrix<Real, 3, 1>;
using Turn = Eigen::Matrix<Real, 3, 3>;

/// A screw: a turn about an axis through a point, and a travel along it.
struct Screw {
  Point axis = Point::UnitZ(), through = Point::Zero();
  Real angle = 0, travel = 0;

  Turn turn(Real time) const { return Eigen::AngleAxis<Real>(time * angle, axis).toRotationMatrix(); }
  Point operator()(const Point& point, Real time) const {
    return turn(time) * (point - through) + through + time * travel * axis;
  }
  /// Returns where a point came from that is there at this time.
  Point undone(const Point& point, Real time) const {
    return turn(time).transpose() * (point - time * travel * axis - through) + through;
  }
  /// The pose that it makes of one in the whole tick, rounded.
  Pose after(const Pose& before) const {
    return {(turn(1) * before.rotation.cast<Real>()).cast<double>(),
            (*this)(before.translation.cast<Real>(), 1).cast<double>()};
  }
};

/// Points of a surface: all as far as the radius from triangles.
struct Solid {
  TriangleMesh mesh;
  double radius = 0;

  Shape<SphereCluster> shape() const {
    return radius > 0 ? Shape<SphereCluster>::round(mesh.vertices()[0], mesh.vertices()[1], radius)
                      : Shape<SphereCluster>::build(mesh);
  }
};

inline Real to_segment(const Point& p, const Point& a, const Point& b) {
  const Point e = b - a;
  const Real squared = e.squaredNorm();
  const Real t = squared > 0 ? std::clamp<Real>((p - a).dot(e) / squared, 0, 1) : 0;
  return (p - a - t * e).norm();
}

inline Real to_triangle(const Point& p, const std::array<Point, 3>& c) {
  Real least = std::min({to_segment(p, c[0], c[1]), to_segment(p, c[1], c[2]), to_segment(p, c[2], c[0])});
  const Point normal = (c[1] - c[0]).cross(c[2] - c[0]);
  if (!(normal.norm() > 0)) return least;
  bool is_over = true;
  for (std::size_t i = 0; i < 3; ++i)
    is_over = is_over && (c[(i + 1) % 3] - c[i]).cross(p - c[i]).dot(normal) >= 0;
  return is_over ? std::abs((p - c[0]).dot(normal)) / normal.norm() : least;
}

struct Mover {
  Solid solid;
  Pose before;
  Screw screw;

  Real distance(const Point& p, Real time) const {
    Real least = std::numeric_limits<Real>::infinity();
    for (std::size_t i = 0; i < solid.mesh.size(); ++i) {
      std::array<Point, 3> corner;
      for (std::size_t k = 0; k < 3; ++k)
        corner[k] = screw(before.rotation.cast<Real>() * solid.mesh.corner(i, k).cast<Real>() +
                              before.translation.cast<Real>(),
                          time);
      least = std::min(least, to_triangle(p, corner));
    }
    return std::abs(least - static_cast<Real>(solid.radius));
  }
};

}  // namespace touchmark::test
