#include "bench/proxies/half_spaces.h"

#include <limits>

namespace touchmark::bench::proxies {
namespace {

/// Below it two unit normals count as parallel: a few roundings of their product.
constexpr double parallel = 1e-15;

}  // namespace

std::optional<OnPlanes> nearest_on(const Vec3& goal, std::span<const Plane> planes) {
  // x = goal + sum l_i n_i on all planes: (n_i . n_j) l = offset_i - n_i . goal, the system of Zilles and
  // Salisbury with x eliminated.
  const auto count = static_cast<Eigen::Index>(planes.size());
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, 0, 3, 3> gram(count, count);
  Eigen::Matrix<double, Eigen::Dynamic, 1, 0, 3, 1> lack(count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Plane& plane = planes[static_cast<std::size_t>(i)];
    lack[i] = -plane.height(goal);
    for (Eigen::Index j = 0; j < count; ++j)
      gram(i, j) = plane.normal.dot(planes[static_cast<std::size_t>(j)].normal);
  }
  if (count > 1 && std::abs(gram.determinant()) < parallel) return std::nullopt;
  const auto multipliers = gram.fullPivLu().solve(lack).eval();
  OnPlanes found{goal, Vec3::Zero()};
  for (Eigen::Index i = 0; i < count; ++i) {
    found.point += multipliers[i] * planes[static_cast<std::size_t>(i)].normal;
    found.multipliers[i] = multipliers[i];
  }
  return found;
}

Vec3 nearest_outside(const Vec3& goal, std::span<const Plane> planes, const Vec3& otherwise) {
  const double slack = 1e-12 * (1 + goal.norm());
  const auto is_outside = [&](const Vec3& x) {
    for (const Plane& plane : planes)
      if (plane.height(x) < -slack) return false;
    return true;
  };
  if (is_outside(goal)) return goal;
  Vec3 best = otherwise;
  double least = std::numeric_limits<double>::infinity();
  const auto attempt = [&](std::span<const Plane> chosen) {
    const std::optional<OnPlanes> found = nearest_on(goal, chosen);
    if (!found || found->multipliers.minCoeff() < 0 || !is_outside(found->point)) return;
    const double distance = (found->point - goal).squaredNorm();
    if (distance < least) least = distance, best = found->point;
  };
  std::array<Plane, 3> chosen;
  for (std::size_t i = 0; i < planes.size(); ++i) {
    chosen[0] = planes[i];
    attempt({chosen.data(), 1});
    for (std::size_t j = i + 1; j < planes.size(); ++j) {
      chosen[1] = planes[j];
      attempt({chosen.data(), 2});
      for (std::size_t k = j + 1; k < planes.size(); ++k) {
        chosen[2] = planes[k];
        attempt(chosen);
      }
    }
  }
  return best;
}

}  // namespace touchmark::bench::proxies
