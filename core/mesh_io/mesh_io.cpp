#include "core/mesh_io/mesh_io.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <new>
#include <string>
#include <string_view>

#include "core/mesh_io/dae/read_dae.h"
#include "core/mesh_io/gltf/read_gltf.h"
#include "core/mesh_io/load.h"
#include "core/mesh_io/mesh_builder.h"
#include "core/mesh_io/readers.h"

namespace touchmark {
namespace {

using mesh_io::OtherReader;

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
  if (by_ending || is_step)
    throw MeshError(std::string("is a CAD exchange file (") + (ending.starts_with(".ig") ? "IGES" : "STEP") +
                    "), not a mesh; export it as STL, PLY or OBJ");
}

/// Formats of one mesh, which state neither axes nor a unit.
bool is_plain(const std::string& ending) {
  return ending == ".ply" || ending == ".obj" || ending == ".off" || ending == ".stl";
}

bool is_gltf(const std::string& ending) { return ending == ".gltf" || ending == ".glb"; }

bool is_collada(const std::string& ending) { return ending == ".dae" || ending == ".zae"; }

TriangleMesh read_plain(const std::string& bytes, const std::string& ending) {
  if (ending == ".ply") return mesh_io::read_ply(bytes);
  if (ending == ".obj") return mesh_io::read_obj(bytes);
  if (ending == ".off") return mesh_io::read_off(bytes);
  return mesh_io::read_stl(bytes);
}

mesh_io::SceneGraph read_graph(const std::filesystem::path& path, const std::string& bytes,
                               const std::string& ending, OtherReader read_other) {
  if (is_gltf(ending)) return mesh_io::read_gltf(bytes, path.parent_path());
  return is_collada(ending) ? mesh_io::read_dae(bytes) : read_other(path, bytes, ending);
}

mesh_io::SceneGraph refuse_other(const std::filesystem::path& /*path*/, std::string_view /*bytes*/,
                                 const std::string& ending) {
  throw MeshError("the ending '" + ending +
                  "' is none of .ply, .obj, .off, .stl, .gltf, .glb and .dae, which are read strictly; "
                  "load_mesh_with_assimp of <touchmark/mesh_io_assimp.h> reads more formats");
}

std::string axes_of(const mesh_io::SceneGraph& graph, const std::string& ending) {
  if (is_gltf(ending)) return "as written (glTF is Y up)";
  return graph.axes.empty() ? "as written" : "as written (the file says " + graph.axes + ")";
}

std::string unit_of(const mesh_io::SceneGraph& graph, const std::string& ending) {
  if (is_gltf(ending)) return "1 m, as in every glTF";
  if (!graph.states_unit) return is_collada(ending) ? "none stated" : "not known: assimp does not tell it";
  std::array<char, 32> text;
  char* const end = std::to_chars(text.data(), text.data() + text.size(), graph.unit).ptr;
  return std::string(text.data(), end) + " m, from the file";
}

MeshFile read(const std::filesystem::path& path, OtherReader read_other) {
  const std::string ending = lower_case_ending(path), bytes = mesh_io::read_file(path);
  refuse_cad_files(bytes, ending);
  if (is_plain(ending)) return {read_plain(bytes, ending), "as written", "none stated"};
  const mesh_io::SceneGraph graph = read_graph(path, bytes, ending, read_other);
  return {mesh_of(graph), axes_of(graph, ending), unit_of(graph, ending)};
}

NodeTree read_tree(const std::filesystem::path& path, OtherReader read_other) {
  const std::string ending = lower_case_ending(path), bytes = mesh_io::read_file(path);
  refuse_cad_files(bytes, ending);
  if (!is_plain(ending)) return tree_of(read_graph(path, bytes, ending, read_other));
  NodeTree tree;
  tree.meshes.push_back(read_plain(bytes, ending));
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

MeshFile mesh_io::load_mesh_file(const std::filesystem::path& path, OtherReader read_other) {
  return named(path, [&] { return read(path, read_other); });
}

NodeTree mesh_io::load_node_tree(const std::filesystem::path& path, OtherReader read_other) {
  return named(path, [&] { return read_tree(path, read_other); });
}

bool is_read_strictly(const std::filesystem::path& path) {
  const std::string ending = lower_case_ending(path);
  return is_plain(ending) || is_gltf(ending) || is_collada(ending);
}

TriangleMesh load_mesh(const std::filesystem::path& path) { return load_mesh_file(path).mesh; }

MeshFile load_mesh_file(const std::filesystem::path& path) {
  return mesh_io::load_mesh_file(path, refuse_other);
}

NodeTree load_node_tree(const std::filesystem::path& path) {
  return mesh_io::load_node_tree(path, refuse_other);
}

}  // namespace touchmark
