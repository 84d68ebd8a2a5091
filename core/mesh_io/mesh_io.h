/// Meshes from files.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace touchmark {

/// Reads a mesh; the id of a triangle is the number of its face in the file, from 0, and the triangles cut
/// from a polygon share it. PLY, OBJ, OFF and STL (by the file's ending, of any case) keep every double of
/// the file; every other format goes through assimp, which keeps single precision, and whose parts follow one
/// another in the order of its scene graph. Throws MeshError("PATH: what is wrong", with the line or the
/// byte) for everything else than a mesh that can be used.
TriangleMesh load_mesh(const std::filesystem::path& path);

/// A file's parts where its nodes place them.
struct NodeTree {
  /// A node that has a mesh. A point v of the mesh is at rotation * v + translation.
  struct Node {
    std::string name;
    std::size_t mesh = 0;  ///< which of the tree's
    Eigen::Matrix3d rotation;
    Vec3 translation;
  };
  std::vector<TriangleMesh> meshes;  ///< each in its own frame; nodes may share them
  std::vector<Node> nodes;           ///< at least one; parents before children, else in the file's order
};

/// Reads the nodes of a file that assimp reads, files beside it included, which a glTF names; a PLY, OBJ, OFF
/// or STL is one node that is named after its file. Throws MeshError as load_mesh does, also for a node whose
/// transform does more than turn and move beyond single precision's rounding, and a file without any.
NodeTree load_node_tree(const std::filesystem::path& path);

}  // namespace touchmark
