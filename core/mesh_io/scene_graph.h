/// A file's parts and the nodes that place them, as its reader found them. From it come one mesh or a
/// NodeTree.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "core/mesh_io/mesh_io.h"
#include "core/triangle_mesh.h"

namespace touchmark::mesh_io {

/// All coordinates are in the file's own axes and, through the nodes, in its own unit times `unit`.
struct SceneGraph {
  /// One primitive or geometry in its own frame. Points and lines are no faces.
  struct Part {
    std::vector<Vec3> vertices;
    std::vector<std::uint32_t> corners;  ///< all faces, one after the other; each below vertices.size()
    std::vector<std::uint32_t> ends;     ///< the corners of face i end before ends[i]; a face has at least 3
  };
  /// A node that has parts. Those without faces become no bodies.
  struct Node {
    std::string name;                ///< empty where the file gives none
    Eigen::Matrix4d transform;       ///< from the parts' frame to the file's, all parents and `unit` included
    std::vector<std::size_t> parts;  ///< by their place in the graph's parts
    std::string id = {};  ///< another name that the file gives it, such as COLLADA's `id`; or empty
  };
  std::vector<Part> parts;
  std::vector<Node> nodes;  ///< parents before children, else in the file's order
  std::string axes = {};    ///< what the file says of its axes, such as "Z_UP"; empty: nothing
  double unit = 1;          ///< metres (COLLADA's `meter`); 1 where the file states none
  bool states_unit = false;
};

/// Returns all parts as one mesh, in the order of the nodes. A triangle's id is the number of its face in
/// that order, from 0. A transform of negative determinant turns the winding, so that a closed part keeps its
/// inside. Throws MeshError.
TriangleMesh mesh_of(const SceneGraph& graph);

/// Returns the nodes as bodies that are only turned and moved: scales, shears and mirrors are applied to
/// their meshes. Throws MeshError.
NodeTree tree_of(const SceneGraph& graph);

}  // namespace touchmark::mesh_io
