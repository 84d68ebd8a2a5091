#include "bench/experiments/audit/convex_hull.h"

#include <algorithm>
#include <cstdio>
#include <limits>
#include <memory>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <libqhull_r/libqhull_r.h>

namespace touchmark::bench::experiments::audit {

ConvexHull::ConvexHull(std::span<const Vec3> points, double error) {
  const std::unique_ptr<std::FILE, int (*)(std::FILE*)> messages(std::tmpfile(), std::fclose);
  std::vector<Vec3> copies(points.begin(), points.end());
  // W: what is within that of a facet adds none. Q12: facets may be wide where points are nearly the same.
  std::string options = fmt::format("qhull Qt Q12 W{}", error / 2);
  const auto state = std::make_unique<qhT>();
  qhT* const qh = state.get();
  qh_zero(qh, messages.get());
  // Fails where all points lie in a plane.
  if (qh_new_qhull(qh, 3, static_cast<int>(copies.size()), copies.front().data(), 0, options.data(), nullptr,
                   messages.get()) == 0) {
    const facetT* facet = nullptr;
    FORALLfacets planes_.push_back({Eigen::Map<const Vec3>(facet->normal), facet->offset});
  }
  qh_freeqhull(qh, 1);  // all of it: qhT itself is not its
}

double ConvexHull::depth(const Vec3& point) const noexcept {
  double depth =
      planes_.empty() ? -std::numeric_limits<double>::infinity() : std::numeric_limits<double>::infinity();
  for (const Plane& plane : planes_) depth = std::min(depth, -plane.normal.dot(point) - plane.offset);
  return depth;
}

}  // namespace touchmark::bench::experiments::audit
