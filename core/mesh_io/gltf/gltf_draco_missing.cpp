#include "core/mesh_io/gltf/gltf_draco.h"
#include "core/triangle_mesh.h"

namespace touchmark::mesh_io {

DracoMesh decode_draco(std::string_view, std::uint32_t) {
  throw MeshError("this program is built without Draco; install libdraco-dev and build it again");
}

}  // namespace touchmark::mesh_io
