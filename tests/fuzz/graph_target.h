/// A reader of scene graphs on any bytes: it throws MeshError, or gives a graph that a mesh and bodies can be
/// made of.
#pragma once

#include "core/mesh_io/scene_graph.h"
#include "tests/fuzz/reader_target.h"

namespace touchmark::fuzz {

inline void require_whole(const mesh_io::SceneGraph::Part& part) {
  std::size_t begin = 0;
  for (const std::size_t end : part.ends) {
    require(end >= begin + 3 && end <= part.corners.size(), "a face of fewer than three corners");
    begin = end;
  }
  require(begin == part.corners.size(), "corners of no face");
  for (const std::uint32_t corner : part.corners)
    require(corner < part.vertices.size(), "a corner that is no vertex");
}

/// Few bytes may place a part often: larger meshes tell nothing new.
inline bool is_small(const mesh_io::SceneGraph& graph) {
  constexpr std::size_t max_placed = 1 << 20;
  std::size_t placed = 0;
  for (const mesh_io::SceneGraph::Node& node : graph.nodes) {
    for (const std::size_t part : node.parts)
      placed += graph.parts[part].vertices.size() + graph.parts[part].corners.size();
  }
  return placed <= max_placed;
}

template <class Read>
int read_as_graph(const Read& read, const std::uint8_t* data, std::size_t size) {
  try {
    const mesh_io::SceneGraph graph = read(std::string_view(reinterpret_cast<const char*>(data), size));
    for (const mesh_io::SceneGraph::Part& part : graph.parts) require_whole(part);
    if (!is_small(graph)) return 0;
    const TriangleMesh mesh = mesh_io::mesh_of(graph);
    std::size_t triangles = 0;
    const NodeTree tree = mesh_io::tree_of(graph);
    for (const NodeTree::Node& node : tree.nodes) triangles += tree.meshes[node.mesh].size();
    require(triangles == mesh.size(), "bodies that are not the mesh");
  } catch (const MeshError& error) {
    require_one_line(error.what());
  }
  return 0;
}

}  // namespace touchmark::fuzz
