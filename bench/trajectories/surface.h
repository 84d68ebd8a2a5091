/// A mesh as trajectories see it: the nearest point, random places on it, and a length to measure steps with.
#pragma once

#include <vector>

#include "bench/support/random.h"
#include "core/probe.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::trajectories {

/// A point of the surface and the unit normal of its face, counter-clockwise side; for a triangle without
/// area a unit vector across it.
struct SurfacePoint {
  Vec3 point;
  Vec3 normal;
};

class Surface {
 public:
  /// Keeps a reference to the mesh.
  explicit Surface(const TriangleMesh& mesh);

  /// Exact, so a trajectory does not depend on which exact detector helped to make it. The centre must be
  /// finite.
  Contact nearest(const Vec3& center);
  /// Uniform by area; by length, then by count, where the mesh has no area or is a single point.
  SurfacePoint random_surface_point(support::Random& random) const;
  /// About how far it is to the other side behind the place, within a factor of two; infinity when there is
  /// none within half of `scale`, or an edge is nearer.
  double thickness(const SurfacePoint& surface_point, double scale);

 private:
  using Nearest = SphereCluster;

  const TriangleMesh& mesh_;
  Nearest detector_;
  Nearest::Session session_;
  std::vector<double> weight_up_to_;  ///< one a triangle, the sum of the weights so far
};

}  // namespace touchmark::bench::trajectories
