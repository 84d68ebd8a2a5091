/// Coarser meshes from a fine one, by OpenMesh where it is installed.
#pragma once

#include <cstddef>

#include "core/triangle_mesh.h"

namespace touchmark::bench::experiments::papers {

/// Returns true if the library is there.
bool can_decimate() noexcept;

/// Edges collapse in the order of their quadric error (Garland & Heckbert 1997) until `triangles` are left,
/// or as near as closed and boundary edges allow. A mesh that has no more comes back as it is, but welded.
/// Throws MeshError when the library is missing or the mesh is no manifold that it can take.
TriangleMesh decimate(const TriangleMesh& mesh, std::size_t triangles);

}  // namespace touchmark::bench::experiments::papers
