#include "core/mesh_io/gltf/gltf_draco.h"

#include <array>

#include <draco/compression/decode.h>

#include "core/triangle_mesh.h"

namespace touchmark::mesh_io {

DracoMesh decode_draco(std::string_view bytes, std::uint32_t positions) {
  draco::DecoderBuffer buffer;
  buffer.Init(bytes.data(), bytes.size());
  auto decoded = draco::Decoder().DecodeMeshFromBuffer(&buffer);
  if (!decoded.ok()) throw MeshError("Draco cannot read it");
  const draco::Mesh& mesh = *decoded.value();
  const draco::PointAttribute* attribute = mesh.GetAttributeByUniqueId(positions);
  if (attribute == nullptr) throw MeshError("Draco's data has no attribute " + std::to_string(positions));
  if (attribute->data_type() != draco::DT_FLOAT32 || attribute->num_components() != 3)
    throw MeshError("Draco's positions are no triples in single precision");
  DracoMesh result;
  result.vertices.reserve(mesh.num_points());
  for (draco::PointIndex i(0); i < mesh.num_points(); ++i) {
    const draco::AttributeValueIndex value = attribute->mapped_index(i);
    if (value.value() >= attribute->size())
      throw MeshError("Draco's data has no position of vertex " + std::to_string(i.value()));
    std::array<float, 3> position;
    attribute->GetValue(value, position.data());
    result.vertices.emplace_back(position[0], position[1], position[2]);
  }
  result.corners.reserve(3 * std::size_t{mesh.num_faces()});
  for (draco::FaceIndex i(0); i < mesh.num_faces(); ++i)
    for (const draco::PointIndex& corner : mesh.face(i)) result.corners.push_back(corner.value());
  return result;
}

}  // namespace touchmark::mesh_io
