/// Every format that has no reader of its own here.
#pragma once

#include <string>
#include <string_view>

#include "core/triangle_mesh.h"

namespace touchmark::mesh_io {

/// `ending` is ".glb" and the like. Formats in several files (a .gltf with its .bin) are not read from
/// memory: their other files count as missing. Throws MeshError.
TriangleMesh read_with_assimp(std::string_view bytes, const std::string& ending);

}  // namespace touchmark::mesh_io
