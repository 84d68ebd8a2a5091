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

/// A mesh made fit for connectivity, with the file's numbers for messages.
struct Welded {
  IndexedTriangles mesh;
  std::vector<std::uint32_t> file_vertex;    ///< the first of the file's vertices that became this one
  std::vector<std::uint32_t> file_triangle;  ///< position in the file's mesh
};

/// Vertices at equal coordinates become one, unused ones go, triangles with two corners in one place go,
/// perhaps all of them.
Welded weld(const TriangleMesh& mesh);

}  // namespace touchmark
