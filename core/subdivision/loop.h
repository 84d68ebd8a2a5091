/// Loop's scheme: old and new vertices are weighted means of their neighbours (Loop 1987), as masks, so that
/// LS3 can fit its spheres to the same vertices with the same weights.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/probe.h"
#include "core/subdivision/oriented_surface.h"

namespace touchmark {

struct Weight {
  std::uint32_t vertex;
  double weight;
};

/// A vertex: 1 - k beta for itself and beta for each of its k neighbours, beta = (5/8 - (3/8 + cos(2
/// pi/k)/4)^2)/k (3/16 for k <= 3); on a boundary 3/4 and 1/8 for each boundary neighbour; a corner
/// stays.
void loop_vertex_mask(const TriangleSurface& surface, std::uint32_t vertex, std::vector<Weight>& mask);
/// A new vertex on an edge: 3/8 for its ends, 1/8 for the two apexes; on boundaries and seams 1/2 for its
/// ends.
void loop_edge_mask(const TriangleSurface& surface, std::uint32_t edge, std::vector<Weight>& mask);

Vec3 weighted_mean(std::span<const Weight> mask, std::span<const Vec3> positions);

/// Returns the new positions of all vertices, then the new ones on `edges`.
std::vector<Vec3> loop_points(const TriangleSurface& surface, std::span<const Vec3> positions,
                              std::span<const std::uint32_t> edges);

}  // namespace touchmark
