#include "core/mesh_io_assimp/mesh_io_assimp.h"

#include "core/mesh_io/load.h"
#include "core/mesh_io_assimp/read_with_assimp.h"

namespace touchmark {

TriangleMesh load_mesh_with_assimp(const std::filesystem::path& path) {
  return load_mesh_file_with_assimp(path).mesh;
}

MeshFile load_mesh_file_with_assimp(const std::filesystem::path& path) {
  return mesh_io::load_mesh_file(path, mesh_io::read_with_assimp);
}

NodeTree load_node_tree_with_assimp(const std::filesystem::path& path) {
  return mesh_io::load_node_tree(path, mesh_io::read_with_assimp);
}

}  // namespace touchmark
