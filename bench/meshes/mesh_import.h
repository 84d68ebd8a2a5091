/// Mesh files of all formats, as the program reads them: what assimp reads, in a process of its own.
#pragma once

#include <filesystem>
#include <string>

#include "core/mesh_io/mesh_io.h"

namespace touchmark::bench::meshes {

/// A mesh file, and a remark about the way it was read where a user should know.
struct ImportedMesh : MeshFile {
  std::string remark = {};
};

/// Reads a mesh as load_mesh_file_with_assimp does. Assimp has 60 s and 2 GB, or 50 times the file's size
/// where that is more; if it ends early for these limits or a crash, that is a MeshError. Where the system
/// makes no other process, assimp runs in this one, and the remark says so. Throws MeshError, and what
/// check_for_interrupt throws.
ImportedMesh import_mesh(const std::filesystem::path& path);

/// Reads nodes as load_node_tree_with_assimp does, in the same way.
NodeTree import_node_tree(const std::filesystem::path& path);

}  // namespace touchmark::bench::meshes
