#include "bench/experiments/papers/choi_sung/geometric_error.h"

#include <algorithm>
#include <cmath>

#include "bench/support/random.h"
#include "bench/trajectories/surface.h"
#include "core/subdivision/mesh_measures.h"

namespace touchmark::bench::experiments::papers {

ReferenceSurface::ReferenceSurface(const TriangleMesh& mesh, double offset, std::size_t samples,
                                   std::uint64_t seed) {
  trajectories::Surface surface(mesh);
  support::Random random(seed);
  const double outwards = signed_volume(mesh) < 0 ? -1 : 1;
  for (std::size_t i = 0; i < samples; ++i) {
    const trajectories::SurfacePoint surface_point = surface.random_surface_point(random);
    centers_.push_back(surface_point.point + outwards * offset * surface_point.normal);
    distances_.push_back(surface.nearest(centers_.back()).distance);
  }
}

GeometricError ReferenceSurface::error_of_distances(const std::vector<double>& distances) const {
  GeometricError error;
  for (std::size_t i = 0; i < distances.size(); ++i) {
    const double off = std::abs(distances[i] - distances_[i]);
    error.mean += off;
    error.rms += off * off;
    error.max = std::max(error.max, off);
  }
  const auto count = static_cast<double>(std::max<std::size_t>(distances.size(), 1));
  error.mean /= count;
  error.rms = std::sqrt(error.rms / count);
  return error;
}

}  // namespace touchmark::bench::experiments::papers
