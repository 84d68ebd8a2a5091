/// How far a path is from a mesh.
#pragma once

#include <algorithm>
#include <vector>

#include "bench/trajectories/trajectories.h"
#include "core/aabb_tree/aabb_tree.h"
#include "core/float_limits.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::trajectories {

/// Returns the distance of each place from the mesh, in mesh units.
inline std::vector<double> distances(const std::vector<Vec3>& way, const TriangleMesh& mesh) {
  const AabbTree detector = AabbTree::build(mesh);
  AabbTree::Session session;
  std::vector<double> all;
  for (const Vec3& p : way) all.push_back(detector.nearest({p, 0}, infinity, session)->distance);
  return all;
}
inline std::vector<double> distances(const Trajectory& path, const TriangleMesh& mesh) {
  return distances(path.positions, mesh);
}

inline double least(const std::vector<double>& values) {
  return *std::min_element(values.begin(), values.end());
}
inline double most(const std::vector<double>& values) {
  return *std::max_element(values.begin(), values.end());
}

}  // namespace touchmark::bench::trajectories
