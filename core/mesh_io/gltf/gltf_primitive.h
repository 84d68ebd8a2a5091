/// The triangles of a glTF primitive.
#pragma once

#include <optional>
#include <vector>

#include "core/mesh_io/gltf/gltf_document.h"
#include "core/mesh_io/scene_graph.h"

namespace touchmark::mesh_io {

/// Reads primitives one after the other.
class GltfPrimitives {
 public:
  explicit GltfPrimitives(const GltfDocument& document) : document_(document) {}

  /// Returns the triangles of a primitive, in the order of its strip or fan; none of points and lines.
  /// Throws MeshError.
  SceneGraph::Part part(const JsonValue& primitive);

 private:
  enum class Mode { points, lines, line_loop, line_strip, triangles, strip, fan };
  static Mode mode_of(const JsonValue& primitive);
  const std::vector<Vec3>& positions(const JsonValue& index);
  std::vector<std::uint32_t> indices(const JsonValue& primitive, std::size_t vertices) const;
  SceneGraph::Part compressed_part(const JsonValue& primitive, const JsonValue& draco, Mode mode) const;

  const GltfDocument& document_;
  std::optional<std::size_t> known_;  // the accessor of known_positions_: primitives often share one
  std::vector<Vec3> known_positions_;
};

}  // namespace touchmark::mesh_io
