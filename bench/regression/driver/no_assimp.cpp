/// The pinned meshes are generated, or in formats that core reads itself without libraries: so the gate needs
/// neither assimp nor pugixml nor nlohmann-json, which exist for fewer processors than core does.
#include "bench/meshes/mesh_import.h"
#include "core/mesh_io/dae/read_dae.h"
#include "core/mesh_io/gltf/read_gltf.h"

namespace touchmark {

mesh_io::SceneGraph mesh_io::read_dae(std::string_view) {
  throw MeshError("the regression gate reads no COLLADA");
}

mesh_io::SceneGraph mesh_io::read_gltf(std::string_view, const std::filesystem::path&) {
  throw MeshError("the regression gate reads no glTF");
}

bench::meshes::ImportedMesh bench::meshes::import_mesh(const std::filesystem::path& path) {
  return {load_mesh_file(path)};
}

}  // namespace touchmark
