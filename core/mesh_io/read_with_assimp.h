/// Every format that has no reader of its own here.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/mesh_io/mesh_io.h"
#include "core/triangle_mesh.h"

namespace touchmark::mesh_io {

/// `ending` is ".glb" and the like. Formats in several files (a .gltf with its .bin) are not read from
/// memory: their other files count as missing. Throws MeshError.
TriangleMesh read_with_assimp(std::string_view bytes, const std::string& ending);

/// Reads the nodes that have meshes. Files that the format names are read, too. Throws MeshError.
NodeTree read_tree_with_assimp(const std::filesystem::path& path, const std::string& ending);

}  // namespace touchmark::mesh_io
