#include "core/geometry/smallest_sphere.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstddef>
#include <limits>
#include <optional>

#include <Eigen/Dense>

namespace touchmark {
namespace {

/// At most four points determine the smallest sphere in space.
struct Support {
  std::array<Vec3, 4> point{Vec3::Zero(), Vec3::Zero(), Vec3::Zero(), Vec3::Zero()};
  std::size_t size = 0;

  void add(const Vec3& p) noexcept { point[size++] = p; }
};

/// The sphere through all the support's points with its centre in their hull's plane, when the points are
/// independent.
std::optional<Sphere> sphere_through(const Support& support) noexcept {
  const Vec3& first = support.point[0];
  if (support.size == 1) return Sphere{first, 0};
  // Centre = first + sum x_i a_i, with 2 (a_i . a_j) x = |a_j|^2.
  const Eigen::Index n = static_cast<Eigen::Index>(support.size) - 1;
  using Edges = Eigen::Matrix<double, 3, Eigen::Dynamic, 0, 3, 3>;
  Edges edges = Edges::Zero(3, n);  // GCC 14 takes what is set below for unset
  double scale = 0;
  for (Eigen::Index i = 0; i < n; ++i) {
    const Vec3 edge = support.point[static_cast<std::size_t>(i) + 1] - first;
    edges.col(i) = edge;
    scale = std::max(scale, edge.cwiseAbs().maxCoeff());
  }
  if (!(scale > 0)) return std::nullopt;
  edges /= scale;
  // Least squares of minimal norm: the centre stays in the points' hull.
  Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 3, 3> system = edges.transpose();
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> half = 0.5 * edges.colwise().squaredNorm().transpose();
  Eigen::CompleteOrthogonalDecomposition<Eigen::Matrix<double, Eigen::Dynamic, 3, 0, 3, 3>> solver(system);
  if (solver.rank() < n) return std::nullopt;
  const Vec3 offset = scale * Vec3(solver.solve(half));
  return Sphere{first + offset, offset.norm()};
}

/// The smallest sphere around at most five points, the last of which lies on it, and the points that carry
/// it.
std::optional<Sphere> smallest_of_few(std::span<const Vec3> points, Support& carrying) noexcept {
  constexpr double tolerance = 1 + 1e-13;
  std::optional<Sphere> best;
  const std::size_t others = points.size() - 1;
  for (unsigned subset = 0; subset < 1u << others; ++subset) {
    if (std::popcount(subset) > 3) continue;
    Support support;
    support.add(points[others]);
    for (std::size_t i = 0; i < others; ++i)
      if (subset >> i & 1u) support.add(points[i]);
    const std::optional<Sphere> sphere = sphere_through(support);
    if (!sphere || (best && sphere->radius >= best->radius)) continue;
    bool holds = true;
    for (const Vec3& p : points) holds &= (p - sphere->center).norm() <= sphere->radius * tolerance;
    if (!holds) continue;
    best = sphere;
    carrying = support;
  }
  return best;
}

std::size_t farthest_from(const Vec3& center, std::span<const Vec3> points) noexcept {
  std::size_t farthest = 0;
  double most = -1;
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double squared = (points[i] - center).squaredNorm();
    if (squared > most) {
      most = squared;
      farthest = i;
    }
  }
  return farthest;
}

}  // namespace

bool Sphere::contains(const Vec3& point) const noexcept { return (point - center).norm() <= radius; }

Sphere sphere_about(const Vec3& center, std::span<const Vec3> points) noexcept {
  // Four roundings in the norm and one in each difference, with room.
  const double radius = (points[farthest_from(center, points)] - center).norm();
  constexpr double eps = std::numeric_limits<double>::epsilon();
  return {center, radius * (1 + 8 * eps)};
}

Sphere smallest_sphere(std::span<const Vec3> points) noexcept {
  Support support;
  support.add(points[farthest_from(points[0], points)]);
  Sphere sphere{support.point[0], 0};
  // Each round's sphere is larger than the last, so no support returns; the cap is for rounding.
  for (int round = 0; round < 200; ++round) {
    const Vec3& outside = points[farthest_from(sphere.center, points)];
    if ((outside - sphere.center).norm() <= sphere.radius * (1 + 1e-13)) break;
    std::array<Vec3, 5> few;
    for (std::size_t i = 0; i < support.size; ++i) few[i] = support.point[i];
    few[support.size] = outside;
    Support carrying;
    const auto larger = smallest_of_few(std::span(few).first(support.size + 1), carrying);
    if (!larger || !(larger->radius > sphere.radius)) break;
    sphere = *larger;
    support = carrying;
  }
  return sphere_about(sphere.center, points);
}

}  // namespace touchmark
