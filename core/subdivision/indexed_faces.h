/// What subdivision works on between levels: positions and faces, before TriangleMesh checks them again.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/probe.h"
#include "core/triangle_mesh.h"

namespace touchmark {

template <std::size_t N>
struct IndexedFaces {
  std::vector<Vec3> positions;
  std::vector<std::array<std::uint32_t, N>> faces;
};

using IndexedTriangles = IndexedFaces<3>;
using IndexedQuads = IndexedFaces<4>;

/// Vertices at equal coordinates become one, unused ones go, triangles with two corners in one place go,
/// perhaps all of them.
IndexedTriangles weld(const TriangleMesh& mesh);

}  // namespace touchmark
