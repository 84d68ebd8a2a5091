/// Meshes from files, by strict readers.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "core/triangle_mesh.h"

namespace touchmark {

/// Reads a mesh, its coordinates in the axes that the file has them in; the id of a triangle is the number of
/// its face in the file, from 0, and the triangles cut from a polygon share it. PLY, OBJ, OFF, STL, glTF and
/// COLLADA (by the file's ending, of any case) are read strictly and keep every double of the file. The parts
/// of a file follow one another in the order of its nodes. Throws MeshError("PATH: what is wrong", with the
/// place) for everything else than a mesh that can be used. mesh_io_assimp.h has a call for other formats.
TriangleMesh load_mesh(const std::filesystem::path& path);

/// True if the file's ending is one that load_mesh reads.
bool is_read_strictly(const std::filesystem::path& path);

/// A mesh and what is known of its frame.
struct MeshFile {
  TriangleMesh mesh;
  std::string axes;  ///< "as written", or with what the file says: "as written (the file says Z_UP)"
  std::string unit;  ///< "none stated", "not known: ...", or "0.001 m, from the file", which is applied
};

/// Reads a mesh as load_mesh does.
MeshFile load_mesh_file(const std::filesystem::path& path);

/// A file's parts where its nodes place them.
struct NodeTree {
  /// A node that has a mesh. A point v of the mesh is at rotation * v + translation.
  struct Node {
    std::string name;
    std::size_t mesh = 0;  ///< which of the tree's
    Eigen::Matrix3d rotation;
    Vec3 translation;
    std::string id = {};  ///< another name that the file gives the node, such as COLLADA's `id`; or empty
  };
  std::vector<TriangleMesh> meshes;  ///< each in its own frame; nodes may share them
  std::vector<Node> nodes;           ///< at least one; parents before children, else in the file's order
};

/// Reads the nodes of a file that have triangles; a PLY, OBJ, OFF or STL is one node that is named after its
/// file. Scales, shears and mirrors are applied to the meshes of their nodes, with the turns that go with
/// them. Throws MeshError as load_mesh does.
NodeTree load_node_tree(const std::filesystem::path& path);

}  // namespace touchmark
