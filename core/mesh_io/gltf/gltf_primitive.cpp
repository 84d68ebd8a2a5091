#include "core/mesh_io/gltf/gltf_primitive.h"

#include <algorithm>
#include <limits>
#include <numeric>
#include <string>
#include <utility>

#include "core/mesh_io/gltf/gltf_accessor.h"
#include "core/mesh_io/gltf/gltf_draco.h"

namespace touchmark::mesh_io {
namespace {

using ComponentType = GltfAccessor::ComponentType;

constexpr std::uint32_t max_index = std::numeric_limits<std::uint32_t>::max();

/// Returns the part without the vertices that no triangle names.
SceneGraph::Part compacted(const std::vector<Vec3>& vertices, std::vector<std::uint32_t> corners) {
  SceneGraph::Part part;
  std::vector<std::uint32_t> used = corners;
  std::sort(used.begin(), used.end());
  used.erase(std::unique(used.begin(), used.end()), used.end());
  for (const std::uint32_t vertex : used) part.vertices.push_back(vertices[vertex]);
  for (std::uint32_t& corner : corners)
    corner = static_cast<std::uint32_t>(std::lower_bound(used.begin(), used.end(), corner) - used.begin());
  part.corners = std::move(corners);
  return part;
}

void check_corners(const std::vector<std::uint32_t>& corners, std::size_t vertices,
                   const JsonValue& primitive) {
  for (std::size_t i = 0; i < corners.size(); ++i) {
    if (corners[i] < vertices) continue;
    primitive.fail("triangle " + std::to_string(i / 3) + " names vertex " + std::to_string(corners[i]) +
                   " of " + std::to_string(vertices));
  }
}

/// A part of triangles. Where many primitives share a long list of vertices each keeps its own only.
SceneGraph::Part part_of(const std::vector<Vec3>& vertices, std::vector<std::uint32_t> corners) {
  SceneGraph::Part part;
  if (vertices.size() > corners.size()) {
    part = compacted(vertices, std::move(corners));
  } else {
    part.vertices = vertices;
    part.corners = std::move(corners);
  }
  part.ends.resize(part.corners.size() / 3);
  for (std::size_t i = 0; i < part.ends.size(); ++i) part.ends[i] = static_cast<std::uint32_t>(3 * i + 3);
  return part;
}

/// Returns the corners of a strip's triangles, all turned as the first is.
std::vector<std::uint32_t> corners_of_strip(const std::vector<std::uint32_t>& indices) {
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 0; i + 2 < indices.size(); ++i) {
    const std::size_t odd = i % 2;
    corners.insert(corners.end(), {indices[i], indices[i + 1 + odd], indices[i + 2 - odd]});
  }
  return corners;
}

std::vector<std::uint32_t> corners_of_fan(const std::vector<std::uint32_t>& indices) {
  std::vector<std::uint32_t> corners;
  for (std::size_t i = 0; i + 2 < indices.size(); ++i)
    corners.insert(corners.end(), {indices[i + 1], indices[i + 2], indices[0]});
  return corners;
}

}  // namespace

GltfPrimitives::Mode GltfPrimitives::mode_of(const JsonValue& primitive) {
  const std::size_t mode = primitive.whole("mode", static_cast<std::size_t>(Mode::triangles));
  if (mode > static_cast<std::size_t>(Mode::fan))
    primitive.fail("has the mode " + std::to_string(mode) + " of 0 to 6");
  return static_cast<Mode>(mode);
}

const std::vector<Vec3>& GltfPrimitives::positions(const JsonValue& index) {
  if (known_ == index.whole()) return known_positions_;
  const GltfAccessor accessor(document_, index, "VEC3", GltfAccessor::Use::attribute);
  const ComponentType type = accessor.component_type();
  if (type == ComponentType::uint32) accessor.fail("has positions of component type 5125");
  if (type != ComponentType::float32 && !document_.uses("KHR_mesh_quantization"))
    accessor.fail("has whole numbers as positions, for which a file must use KHR_mesh_quantization");
  if (accessor.count() > max_index) accessor.fail("has more vertices than 32-bit indices can name");
  known_.reset();
  known_positions_.clear();
  known_positions_.reserve(accessor.count());
  for (std::size_t i = 0; i < accessor.count(); ++i) {
    const Vec3 position(accessor.number(i, 0), accessor.number(i, 1), accessor.number(i, 2));
    if (!position.allFinite()) accessor.fail("vertex " + std::to_string(i) + " is not finite");
    known_positions_.push_back(position);
  }
  known_ = index.whole();
  return known_positions_;
}

std::vector<std::uint32_t> GltfPrimitives::indices(const JsonValue& primitive, std::size_t vertices) const {
  std::vector<std::uint32_t> indices;
  const std::optional<JsonValue> index = primitive.find("indices");
  if (!index) {
    indices.resize(vertices);
    std::iota(indices.begin(), indices.end(), 0u);
    return indices;
  }
  const GltfAccessor accessor(document_, *index, "SCALAR", GltfAccessor::Use::indices);
  const ComponentType type = accessor.component_type();
  const bool is_unsigned =
      type == ComponentType::uint8 || type == ComponentType::uint16 || type == ComponentType::uint32;
  if (!is_unsigned || accessor.is_normalized())
    accessor.fail("has indices that are no plain unsigned numbers");
  const double restart = type == ComponentType::uint8    ? 0xff
                         : type == ComponentType::uint16 ? 0xffff
                                                         : max_index;
  indices.reserve(accessor.count());
  for (std::size_t i = 0; i < accessor.count(); ++i) {
    const double value = accessor.number(i, 0);
    if (value == restart)
      accessor.fail("index " + std::to_string(i) + " is the largest of its type, which glTF does not allow");
    indices.push_back(static_cast<std::uint32_t>(value));
  }
  return indices;
}

SceneGraph::Part GltfPrimitives::compressed_part(const JsonValue& primitive, const JsonValue& draco,
                                                 Mode mode) const {
  if (mode != Mode::triangles) draco.fail("compresses a primitive that is no list of triangles");
  const std::size_t id = draco.at("attributes").at("POSITION").whole();
  const GltfDocument::View view = document_.view(draco.at("bufferView"));
  DracoMesh mesh;
  try {
    if (id >= max_index) throw MeshError("its POSITION is attribute " + std::to_string(id));
    mesh = decode_draco(view.bytes, static_cast<std::uint32_t>(id));
  } catch (const MeshError& error) {
    draco.fail(error.what());
  }
  const auto expect = [&](const JsonValue& index, std::size_t count) {
    const JsonValue stated = document_.named_by(index, "accessors").at("count");
    if (stated.whole() != count)
      stated.fail("is " + std::to_string(stated.whole()) + ", but Draco's data has " + std::to_string(count));
  };
  expect(primitive.at("attributes").at("POSITION"), mesh.vertices.size());
  if (const std::optional<JsonValue> indices = primitive.find("indices"))
    expect(*indices, mesh.corners.size());
  check_corners(mesh.corners, mesh.vertices.size(), primitive);
  return part_of(mesh.vertices, std::move(mesh.corners));
}

SceneGraph::Part GltfPrimitives::part(const JsonValue& primitive) {
  const Mode mode = mode_of(primitive);
  if (mode < Mode::triangles) return {};
  if (const std::optional<JsonValue> extensions = primitive.find("extensions")) {
    if (const std::optional<JsonValue> draco = extensions->find("KHR_draco_mesh_compression"))
      return compressed_part(primitive, *draco, mode);
  }
  const std::vector<Vec3>& vertices = positions(primitive.at("attributes").at("POSITION"));
  std::vector<std::uint32_t> corners = indices(primitive, vertices.size());
  if (corners.size() < 3 || (mode == Mode::triangles && corners.size() % 3 != 0))
    primitive.fail("has " + std::to_string(corners.size()) + " corners, which make no whole triangles");
  if (mode == Mode::strip) corners = corners_of_strip(corners);
  if (mode == Mode::fan) corners = corners_of_fan(corners);
  if (corners.size() > max_index) primitive.fail("has more corners than 32-bit numbers can count");
  check_corners(corners, vertices.size(), primitive);
  return part_of(vertices, std::move(corners));
}

}  // namespace touchmark::mesh_io
