/// Meshes into files, with every double as it is.
#pragma once

#include <string>

#include "core/triangle_mesh.h"

namespace touchmark::bench::meshes {

/// By the file's ending, of any case. STL is its text form, since the binary one holds floats; it names no
/// vertices, so a reader finds three for each triangle.
enum class MeshFormat { ply, obj, off, stl };

/// Throws std::invalid_argument naming the path for any other ending.
MeshFormat mesh_format_of(const std::string& path);

/// Triangles in the mesh's order; their ids are not written. The file appears under its name when it is
/// complete. Throws std::invalid_argument as above, ResourceError when it cannot be written.
void write_mesh(const TriangleMesh& mesh, const std::string& path);

}  // namespace touchmark::bench::meshes
