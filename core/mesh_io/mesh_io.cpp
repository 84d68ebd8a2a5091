#include "core/mesh_io/mesh_io.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <new>
#include <string>
#include <string_view>

#include "core/mesh_io/mesh_file.h"
#include "core/mesh_io/read_with_assimp.h"
#include "core/mesh_io/readers.h"

namespace touchmark {
namespace {

std::string lower_case_ending(const std::filesystem::path& path) {
  std::string ending = path.extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

/// Curved surfaces, which become triangles only by a choice that the reader of a mesh should not make.
void refuse_cad_files(const std::string& bytes, const std::string& ending) {
  constexpr std::array<std::string_view, 6> cad_endings = {".step", ".stp", ".stpz", ".p21", ".iges", ".igs"};
  constexpr std::string_view step_header = "ISO-10303-21";
  const bool by_ending = std::find(cad_endings.begin(), cad_endings.end(), ending) != cad_endings.end();
  const bool is_step = bytes.starts_with(step_header) && ending != ".ifc";  // which assimp reads
  if (by_ending || is_step) {
    throw MeshError(std::string("is a CAD exchange file (") + (ending.starts_with(".ig") ? "IGES" : "STEP") +
                    "), not a mesh; export it as STL, PLY or OBJ");
  }
}

bool is_read_here(const std::string& ending) {
  return ending == ".ply" || ending == ".obj" || ending == ".off" || ending == ".stl";
}

TriangleMesh read(const std::string& bytes, const std::string& ending) {
  refuse_cad_files(bytes, ending);
  if (ending == ".ply") return mesh_io::read_ply(bytes);
  if (ending == ".obj") return mesh_io::read_obj(bytes);
  if (ending == ".off") return mesh_io::read_off(bytes);
  if (ending == ".stl") return mesh_io::read_stl(bytes);
  return mesh_io::read_with_assimp(bytes, ending);
}

NodeTree read_tree(const std::filesystem::path& path) {
  const std::string ending = lower_case_ending(path);
  const std::string bytes = mesh_io::read_file(path);
  refuse_cad_files(bytes, ending);
  if (!is_read_here(ending)) return mesh_io::read_tree_with_assimp(path, ending);
  NodeTree tree;
  tree.meshes.push_back(read(bytes, ending));
  tree.nodes.push_back({path.stem().string(), 0, Eigen::Matrix3d::Identity(), Vec3::Zero()});
  return tree;
}

/// Calls load(), whose errors then name the file.
template <class Load>
auto named(const std::filesystem::path& path, const Load& load) {
  try {
    return load();
  } catch (const MeshError& error) {
    throw MeshError(path.string() + ": " + error.what());
  } catch (const std::bad_alloc&) {
    throw MeshError(path.string() + ": does not fit in memory");
  }
}

}  // namespace

TriangleMesh load_mesh(const std::filesystem::path& path) {
  return named(path, [&] { return read(mesh_io::read_file(path), lower_case_ending(path)); });
}

NodeTree load_node_tree(const std::filesystem::path& path) {
  return named(path, [&] { return read_tree(path); });
}

}  // namespace touchmark
