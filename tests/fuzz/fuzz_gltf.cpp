#include "core/mesh_io/read_gltf.h"
#include "tests/fuzz/reader_target.h"

namespace touchmark::fuzz {
namespace {

/// Side files are looked for where there are none.
mesh_io::SceneGraph graph_of(std::string_view bytes) { return mesh_io::read_gltf(bytes, "/nonexistent"); }

/// Few bytes may place a part often: larger meshes tell nothing new.
bool is_small(const mesh_io::SceneGraph& graph) {
  constexpr std::size_t max_placed = 1 << 20;
  std::size_t placed = 0;
  for (const mesh_io::SceneGraph::Node& node : graph.nodes) {
    for (const std::size_t part : node.parts)
      placed += graph.parts[part].vertices.size() + graph.parts[part].corners.size();
  }
  return placed <= max_placed;
}

void read(std::string_view bytes) {
  const mesh_io::SceneGraph graph = graph_of(bytes);
  for (const mesh_io::SceneGraph::Part& part : graph.parts) {
    require(part.corners.size() == (part.ends.empty() ? 0 : part.ends.back()), "corners of no face");
    for (const std::uint32_t corner : part.corners) require(corner < part.vertices.size(), "no vertex");
  }
  if (!is_small(graph)) return;
  const TriangleMesh mesh = mesh_of(graph);
  std::size_t triangles = 0;
  const NodeTree tree = tree_of(graph);
  for (const NodeTree::Node& node : tree.nodes) triangles += tree.meshes[node.mesh].size();
  require(triangles == mesh.size(), "bodies that are not the mesh");
}

}  // namespace
}  // namespace touchmark::fuzz

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  try {
    touchmark::fuzz::read({reinterpret_cast<const char*>(data), size});
  } catch (const touchmark::MeshError& error) {
    touchmark::fuzz::require_one_line(error.what());
  }
  return 0;
}
