#include "core/mesh_io/scene_graph.h"

#include <algorithm>
#include <array>
#include <limits>
#include <map>
#include <utility>

#include <Eigen/LU>

#include "core/mesh_io/mesh_builder.h"

namespace touchmark::mesh_io {
namespace {

using Node = SceneGraph::Node;
using Part = SceneGraph::Part;

/// A node, for errors.
struct At {
  const Node& node;
  [[noreturn]] void fail(const std::string& message) const {
    throw MeshError("node " + mesh_io::quoted(node.name) + ": " + message);
  }
};

/// Refuses a transform that is no affine map.
void check_transform(const Node& node) {
  if (!node.transform.allFinite()) At{node}.fail("its transform is not finite");
  if (node.transform.row(3) != Eigen::RowVector4d(0, 0, 0, 1)) At{node}.fail("its transform is a projection");
}

/// Each column is brought to size 1 first: the determinant of tiny scales would underflow.
bool mirrors(const Eigen::Matrix3d& linear) {
  const Eigen::RowVector3d sizes = linear.cwiseAbs().colwise().maxCoeff();
  return (linear * sizes.cwiseInverse().asDiagonal()).determinant() < 0;
}

/// True if the transform only turns and moves, as far as a file in single precision can say so.
bool is_rigid(const Eigen::Matrix3d& linear) {
  constexpr double rounding = 0x1p-20;  // 16 roundings of single precision
  const Eigen::Matrix3d gram = linear.transpose() * linear;
  return (gram - Eigen::Matrix3d::Identity()).cwiseAbs().maxCoeff() <= rounding && linear.determinant() > 0;
}

void add_part(const Part& part, const Eigen::Matrix4d& transform, const At& at, MeshBuilder& mesh) {
  const Eigen::Matrix3d linear = transform.topLeftCorner<3, 3>();
  const Vec3 shift = transform.topRightCorner<3, 1>();
  const auto first = static_cast<std::int64_t>(mesh.vertex_count());
  for (const Vec3& vertex : part.vertices) mesh.add_vertex(linear * vertex + shift);
  const bool turns = mirrors(linear);
  std::vector<std::uint32_t> corners;
  std::size_t begin = 0;
  for (const std::uint32_t end : part.ends) {
    corners.clear();
    for (; begin < end; ++begin) corners.push_back(mesh.checked_corner(first + part.corners[begin], at));
    if (turns) std::reverse(corners.begin() + 1, corners.end());
    mesh.add_face(corners, at);
  }
}

/// Refuses more than 2^32 - 1 vertices or corners before memory is taken for them: few bytes can place a part
/// often.
void reserve(const SceneGraph& graph, MeshBuilder& mesh) {
  constexpr std::size_t max_count = std::numeric_limits<std::uint32_t>::max();
  std::size_t vertices = 0, corners = 0;
  for (const Node& node : graph.nodes) {
    for (const std::size_t part : node.parts) {
      vertices += graph.parts[part].vertices.size();
      corners += graph.parts[part].corners.size();
      if (std::max(vertices, corners) > max_count)
        At{node}.fail("the nodes up to here place more than " + std::to_string(max_count) +
                      " vertices or corners");
    }
  }
  mesh.reserve(vertices, corners / 3);
}

/// Collects bodies.
class TreeBuilder {
 public:
  explicit TreeBuilder(const SceneGraph& graph) : graph_(graph) {}

  void add(const Node& node) {
    check_transform(node);
    const Eigen::Matrix3d linear = node.transform.topLeftCorner<3, 3>();
    const bool rigid = is_rigid(linear);
    const Eigen::Matrix3d unturned = Eigen::Matrix3d::Identity();
    tree_.nodes.push_back({node.name, mesh_of(node, rigid ? unturned : linear), rigid ? linear : unturned,
                           node.transform.topRightCorner<3, 1>(), node.id});
  }
  NodeTree tree() && { return std::move(tree_); }

 private:
  /// Nodes with the same parts and the same scales share one mesh.
  std::size_t mesh_of(const Node& node, const Eigen::Matrix3d& linear) {
    std::array<double, 9> key;
    Eigen::Matrix3d::Map(key.data()) = linear;
    const auto [known, is_new] = meshes_.emplace(std::pair(node.parts, key), tree_.meshes.size());
    if (!is_new) return known->second;
    Eigen::Matrix4d transform = Eigen::Matrix4d::Identity();
    transform.topLeftCorner<3, 3>() = linear;
    MeshBuilder mesh;
    for (const std::size_t part : node.parts) add_part(graph_.parts[part], transform, At{node}, mesh);
    tree_.meshes.push_back(std::move(mesh).build());
    return known->second;
  }

  const SceneGraph& graph_;
  NodeTree tree_;
  std::map<std::pair<std::vector<std::size_t>, std::array<double, 9>>, std::size_t> meshes_;
};

}  // namespace

TriangleMesh mesh_of(const SceneGraph& graph) {
  MeshBuilder mesh;
  reserve(graph, mesh);
  for (const Node& node : graph.nodes) {
    check_transform(node);
    for (const std::size_t part : node.parts) add_part(graph.parts[part], node.transform, At{node}, mesh);
  }
  return std::move(mesh).build();
}

NodeTree tree_of(const SceneGraph& graph) {
  TreeBuilder builder(graph);
  for (const Node& node : graph.nodes) {
    const auto has_faces = [&](std::size_t part) { return !graph.parts[part].ends.empty(); };
    if (std::any_of(node.parts.begin(), node.parts.end(), has_faces)) builder.add(node);
  }
  NodeTree tree = std::move(builder).tree();
  if (tree.nodes.empty()) throw MeshError("no node has a triangle");
  return tree;
}

}  // namespace touchmark::mesh_io
