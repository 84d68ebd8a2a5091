/// Meshes that Draco has compressed.
#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

#include "core/probe.h"

namespace touchmark::mesh_io {

struct DracoMesh {
  std::vector<Vec3> vertices;
  std::vector<std::uint32_t> corners;  ///< three a triangle
};

/// Returns the mesh, its vertices from the attribute of that id. Throws MeshError("what is wrong"), always
/// where this library is built without Draco.
DracoMesh decode_draco(std::string_view bytes, std::uint32_t positions);

}  // namespace touchmark::mesh_io
