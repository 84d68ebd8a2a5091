/// The pinned meshes are generated, or in formats that core reads itself: so the gate needs no assimp, which
/// exists for fewer processors than core does.
#include "core/mesh_io/read_with_assimp.h"

namespace touchmark::mesh_io {

TriangleMesh read_with_assimp(std::string_view, const std::string& ending) {
  throw MeshError("the regression gate reads no " + ending);
}

NodeTree read_tree_with_assimp(const std::filesystem::path&, const std::string& ending) {
  throw MeshError("the regression gate reads no " + ending);
}

}  // namespace touchmark::mesh_io
