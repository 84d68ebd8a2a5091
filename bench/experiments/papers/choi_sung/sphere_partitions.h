/// Choi & Sung make their spheres bottom-up, from single triangles, and say that this makes tighter ones than
/// top-down, by halving the whole: both ways, with as many spheres.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/geometry/smallest_sphere.h"
#include "core/sphere_cluster/clustering.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::experiments::papers {

/// Halves the part whose centroids' box has the longest side, across that side at the middle triangle, until
/// there are so many parts, or as many as triangles. Each part holds the numbers of its triangles.
std::vector<std::vector<std::uint32_t>> halved_into(const TriangleMesh& mesh, std::size_t parts);

/// By the paper's formula, mesh units: the less, the tighter.
struct PartitionTightness {
  double published = 0;  ///< the clusters, about their first triangles' centroids
  double bottom_up = 0;  ///< those clusters, in the smallest spheres
  double top_down = 0;   ///< as many parts by halving, in the smallest spheres
};
PartitionTightness partition_tightness(const TriangleMesh& mesh, const SphereClusters& clusters);

}  // namespace touchmark::bench::experiments::papers
