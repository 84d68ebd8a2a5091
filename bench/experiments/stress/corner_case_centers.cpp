#include "bench/experiments/stress/corner_case_centers.h"

#include <algorithm>
#include <limits>

#include "bench/experiments/stress/corner_cases.h"

namespace touchmark::bench::experiments::stress {

std::vector<Vec3> corner_case_centers(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed) {
  CornerCases cases(seed);
  std::vector<Vec3> centers;
  const Aabb& box = mesh.bounds();
  // The box's diagonal, also where the squares of its sides leave the range of double.
  const bool fits = mesh.diagonal() > 1e-150 && mesh.diagonal() < 1e150;
  const double size =
      std::max(fits ? mesh.diagonal() : box.extent().stableNorm(), std::numeric_limits<double>::min());
  centers.push_back(box.center());
  Vec3 mean = Vec3::Zero();
  for (const Vec3& v : mesh.vertices()) mean += (v - box.min) / static_cast<double>(mesh.vertices().size());
  centers.push_back(box.min + mean);  // of a generated ball, its middle
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 weight(corner & 1, corner >> 1 & 1, corner >> 2 & 1);
    centers.push_back(box.min + weight.cwiseProduct(box.extent()));
  }
  for (const double distance : {1.0, 1e3, 1e6, 1e12})
    centers.push_back(box.center() + distance * size * cases.vector());
  while (centers.size() < count) {
    const std::size_t i = cases.below(mesh.size());
    const Vec3 &a = mesh.corner(i, 0), &b = mesh.corner(i, 1), &c = mesh.corner(i, 2);
    const Vec3 eighths(static_cast<double>(cases.below(9)) / 8, static_cast<double>(cases.below(9)) / 8,
                       static_cast<double>(cases.below(9)) / 8);
    centers.push_back(a);
    centers.push_back(a + 0.5 * (b - a));
    centers.push_back((a + b + c) / 3);
    centers.push_back(box.min + eighths.cwiseProduct(box.extent()));
    centers.push_back(cases.point_near({a, b, c}));
    centers.push_back(a + 0.005 * size * cases.vector());
    centers.push_back(box.center() + 0.6 * size * cases.vector());
  }
  return centers;
}

}  // namespace touchmark::bench::experiments::stress
