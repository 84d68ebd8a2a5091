/// A mesh reader on any bytes: it throws MeshError or gives a mesh that can be used.
#pragma once

#include <string_view>

#include "core/triangle_mesh.h"
#include "tests/fuzz/target.h"

namespace touchmark::fuzz {

inline void require_usable(const TriangleMesh& mesh, std::size_t bytes) {
  require(mesh.size() > 0, "a mesh without triangles");
  // No format names a corner in less than a byte; a polygon of n corners becomes n - 2 triangles.
  require(mesh.size() <= bytes, "more triangles than bytes");
  require(mesh.vertices().size() <= bytes, "more vertices than bytes");
  TriangleId last = 0;
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    for (const std::uint32_t vertex : mesh.triangles()[i])
      require(vertex < mesh.vertices().size(), "a corner that is no vertex");
    require(mesh.id(i) >= last && mesh.id(i) < bytes, "an id out of order");
    last = mesh.id(i);
  }
  for (const Vec3& vertex : mesh.vertices()) require(vertex.allFinite(), "a vertex that is not finite");
}

/// Requires a message to be one line, whatever bytes the input has.
inline void require_one_line(std::string_view message) {
  for (const char c : message)
    require(c != '\n' && c != '\r' && c != '\0' && c != '\x1b', "a message of more than one line");
}

using Reader = TriangleMesh (*)(std::string_view bytes);

inline int read_as_mesh(Reader read, const std::uint8_t* data, std::size_t size) {
  const std::string_view bytes(reinterpret_cast<const char*>(data), size);
  try {
    require_usable(read(bytes), size);
  } catch (const MeshError& error) {
    require_one_line(error.what());
  }
  return 0;
}

}  // namespace touchmark::fuzz
