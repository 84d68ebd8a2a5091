/// Meshes from files of any format: the strict readers' by mesh_io.h, all others by assimp.
#pragma once

#include <filesystem>

#include "core/mesh_io/mesh_io.h"

namespace touchmark {

/// Reads a mesh as load_mesh does where the ending has a strict reader, else through assimp, which keeps
/// single precision. Refuses a file of which assimp reports that it dropped or changed faces or vertices.
/// A malformed file can make assimp read beyond its memory, end the program, or take hours: read files that
/// you do not trust in a process of its own, as the program touchmark does. Throws MeshError.
TriangleMesh load_mesh_with_assimp(const std::filesystem::path& path);

/// Reads a mesh as load_mesh_with_assimp does, with what is known of its frame.
MeshFile load_mesh_file_with_assimp(const std::filesystem::path& path);

/// Reads nodes as load_node_tree does, of the files that load_mesh_with_assimp reads.
NodeTree load_node_tree_with_assimp(const std::filesystem::path& path);

}  // namespace touchmark
