/// Meshes by name: generated ones that need no file, `bunny` and `dragon` from their packages, or any file.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "bench/meshes/mesh_import.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::meshes {

struct NamedMesh {
  std::string name;         ///< as written on the command line, with its parameters' form: "icosphere:N"
  std::string description;  ///< one line
  std::string example;      ///< a small instance that tests can run: "icosphere:3"; empty when it needs a
                            ///< file, or another mesh stands for its kind
  bool available = true;    ///< false when its file is not installed
};

std::vector<NamedMesh> named_meshes();

/// Returns true if the text begins with a mesh's name, whatever follows it; else it is a file's path.
bool is_named(const std::string& text);

/// ${TOUCHMARK_DATA:-${XDG_CACHE_HOME:-~/.cache}/touchmark}, where scripts/setup puts what it fetches.
std::filesystem::path data_folder();

/// What commands use when no mesh is named: the bunny, or where it is not installed a generated mesh of its
/// size.
std::string default_mesh();

/// `name` is a mesh's name or a path, with optional modifiers: "bunny@scale=1e-6@offset=1e6@normalize"
/// (scale about the origin, then shift along (1,1,1), in the order written). A mesh's name goes before a
/// file's: "./cube" is the file. Throws std::invalid_argument for an unknown name or parameter, MeshError for
/// a file that cannot be used, ResourceError for a mesh that would not fit in memory; each names the offender
/// in one line.
TriangleMesh load_mesh(const std::string& name);

/// Returns the mesh of that name or file, normalised if asked to. Throws std::invalid_argument or MeshError.
TriangleMesh load_mesh(const std::string& name, bool normalize);

/// Returns the same with what the file says of its axes and unit; both are empty for a generated mesh.
ImportedMesh load_with_frame(const std::string& name, bool normalize);

}  // namespace touchmark::bench::meshes
