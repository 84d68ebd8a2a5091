/// The pinned meshes are generated, or in formats that core reads itself without libraries: so the gate needs
/// neither assimp nor pugixml nor nlohmann-json, which exist for fewer processors than core does.
#include "core/mesh_io/read_dae.h"
#include "core/mesh_io/read_gltf.h"
#include "core/mesh_io/read_with_assimp.h"

namespace touchmark::mesh_io {

SceneGraph read_with_assimp(const std::filesystem::path&, std::string_view, const std::string& ending) {
  throw MeshError("the regression gate reads no " + ending);
}

SceneGraph read_dae(std::string_view bytes) { return read_with_assimp({}, bytes, ".dae"); }

SceneGraph read_gltf(std::string_view bytes, const std::filesystem::path&) {
  return read_with_assimp({}, bytes, ".gltf");
}

}  // namespace touchmark::mesh_io
