/// Meshes that change their shape and keep their triangles: what `touchmark update` moves.
#pragma once

#include <cstddef>
#include <cstdint>

#include "core/triangle_mesh.h"

namespace touchmark::bench::meshes {

/// Moves this share of all vertices. Less than 1: a dent, the vertices nearest to one drawn at random,
/// inwards by up to a quarter of their patch's radius, less towards its border. 1: a wave through everything,
/// 1 % of the box's diagonal high and half a diagonal long.
struct Deformation {
  double share = 1;  ///< above 0, at most 1
  std::uint64_t seed = 1;
};

/// Returns the deformed mesh, equal on every machine for equal meshes.
TriangleMesh deformed(const TriangleMesh& mesh, const Deformation& deformation);

/// Vertices whose bits differ. Both meshes have as many.
std::size_t moved_vertices(const TriangleMesh& before, const TriangleMesh& after);

}  // namespace touchmark::bench::meshes
