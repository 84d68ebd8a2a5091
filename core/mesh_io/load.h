/// The way from a file to its mesh or its nodes, shared by the calls with and without assimp.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

#include "core/mesh_io/mesh_io.h"
#include "core/mesh_io/scene_graph.h"

namespace touchmark::mesh_io {

/// Reads a file whose ending has no strict reader. `bytes` is what the file holds, `ending` is ".3ds" or the
/// like, in lower case. Throws MeshError.
using OtherReader = SceneGraph (*)(const std::filesystem::path& path, std::string_view bytes,
                                   const std::string& ending);

MeshFile load_mesh_file(const std::filesystem::path& path, OtherReader read_other);
NodeTree load_node_tree(const std::filesystem::path& path, OtherReader read_other);

}  // namespace touchmark::mesh_io
