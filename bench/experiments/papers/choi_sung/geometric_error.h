/// How far the surface that a detector answers for is from another one: what the level of subdivision and the
/// clustering cost in precision.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <vector>

#include "core/probe.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::experiments::papers {

/// The error at a probe's centre is |distance answered - distance to the reference surface|: by how much a
/// contact of a ball comes too early or too late.
struct GeometricError {
  double mean = 0;  ///< mesh units
  double rms = 0;
  double max = 0;
};

/// Samples around a reference surface, with their true distances to it.
class ReferenceSurface {
 public:
  /// `samples` probe centres, `offset` mesh units off the surface along its outward normal at random places
  /// uniform by area: far enough to be outside of every sphere that stands for the surface there.
  ReferenceSurface(const TriangleMesh& mesh, double offset, std::size_t samples, std::uint64_t seed);

  /// Returns the error of a detector with any reach.
  template <class D>
  GeometricError error_of(const D& detector) const {
    typename D::Session session;
    std::vector<double> distances;
    distances.reserve(centers_.size());
    for (const Vec3& center : centers_) distances.push_back(distance_by(detector, center, session));
    return error_of_distances(distances);
  }

 private:
  template <class D>
  static double distance_by(const D& detector, const Vec3& center, typename D::Session& session) {
    return detector.nearest({center, 0}, std::numeric_limits<double>::infinity(), session)->distance;
  }
  GeometricError error_of_distances(const std::vector<double>& distances) const;

  std::vector<Vec3> centers_;
  std::vector<double> distances_;  ///< from the centres to the reference
};

}  // namespace touchmark::bench::experiments::papers
