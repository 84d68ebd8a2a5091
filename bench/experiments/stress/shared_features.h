/// Meshes whose triangles are all as near to some point: by a corner or an edge that they share, in one
/// plane, or each by a place of its own.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace touchmark::bench::experiments::stress {

struct SharedFeature {
  std::string name;
  TriangleMesh mesh;
  std::vector<Vec3> centers;
};

/// Returns meshes of about so many triangles, at least 64. Equal numbers give equal meshes.
std::vector<SharedFeature> shared_feature_meshes(std::size_t triangles);

}  // namespace touchmark::bench::experiments::stress
