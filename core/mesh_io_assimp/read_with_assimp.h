/// Files of all formats that have no reader of their own.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/mesh_io/scene_graph.h"

namespace touchmark::mesh_io {

/// Reads a file's nodes with their triangles and polygons. `ending` is ".3ds" or another that assimp knows,
/// in lower case; `bytes` is what the file holds, for files that can be read only once. Throws MeshError,
/// also where assimp's log says that faces or vertices were dropped or changed.
SceneGraph read_with_assimp(const std::filesystem::path& path, std::string_view bytes,
                            const std::string& ending);

}  // namespace touchmark::mesh_io
