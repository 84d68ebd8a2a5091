// What a mesh and bodies make of a file's parts and nodes, whatever the format.
#include "core/mesh_io/scene_graph.h"

#include <cmath>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "tests/core/mesh_io/volume.h"

namespace touchmark::mesh_io {
namespace {

using Eigen::Matrix4d;
using test::volume;

/// A tetrahedron of volume 1 with its faces outwards.
SceneGraph::Part tetrahedron() {
  return {{{0, 0, 0}, {1, 0, 0}, {0, 2, 0}, {0, 0, 3}}, {0, 2, 1, 0, 1, 3, 0, 3, 2, 1, 2, 3}, {3, 6, 9, 12}};
}

Matrix4d scaled(double x, double y, double z) {
  return Eigen::Vector4d(x, y, z, 1).asDiagonal().toDenseMatrix();
}

Matrix4d turned(double angle) {
  Matrix4d matrix = Matrix4d::Identity();
  matrix.topLeftCorner<3, 3>() = Eigen::AngleAxisd(angle, Vec3(1, 2, 3).normalized()).toRotationMatrix();
  return matrix;
}

template <class Load>
std::string refusal(const SceneGraph& graph, const Load& load) {
  try {
    load(graph);
  } catch (const MeshError& error) {
    return error.what();
  }
  return "accepted";
}

TEST(SceneGraph, AMirroredPartKeepsItsInside) {
  for (const Vec3& s : {Vec3(-1, 1, 1), Vec3(-1, -1, -1), Vec3(1e-120, 1e-120, -1e120), Vec3(2, -3, 1)}) {
    const SceneGraph graph{{tetrahedron()}, {{"a", scaled(s.x(), s.y(), s.z()), {0}}}};
    EXPECT_NEAR(volume(mesh_of(graph)) / std::abs(s.prod()), 1, 1e-15) << s.transpose();
    EXPECT_NEAR(volume(tree_of(graph).meshes[0]) / std::abs(s.prod()), 1, 1e-15) << s.transpose();
  }
}

TEST(SceneGraph, AMirroredPolygonKeepsItsFirstCorner) {
  const SceneGraph::Part square{{{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, {0, 1, 2, 3}, {4}};
  const TriangleMesh mesh = mesh_of({{square}, {{"", scaled(1, 1, -1), {0}}}});
  ASSERT_EQ(mesh.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const Vec3 normal = (mesh.corner(i, 1) - mesh.corner(i, 0)).cross(mesh.corner(i, 2) - mesh.corner(i, 0));
    EXPECT_EQ(normal, Vec3(0, 0, -1));
    EXPECT_EQ(mesh.id(i), 0u);
  }
}

TEST(SceneGraph, FacesAreNumberedInTheOrderOfNodesAndParts) {
  const SceneGraph graph{{tetrahedron(), {}}, {{"a", turned(1), {0, 1}}, {"b", scaled(2, 2, 2), {1, 0, 0}}}};
  const TriangleMesh mesh = mesh_of(graph);
  ASSERT_EQ(mesh.size(), 12u);
  EXPECT_EQ(mesh.id(11), 11u);
  EXPECT_NEAR(volume(mesh), 1 + 8 + 8, 1e-14);
}

TEST(SceneGraph, ScalesAndShearsAreAppliedToTheMeshesOfBodies) {
  Matrix4d shear = Matrix4d::Identity();
  shear(0, 1) = 1;
  shear(1, 3) = 7;
  const SceneGraph graph{{tetrahedron()}, {{"a", shear, {0}}, {"b", turned(2) * scaled(2, 1, 1), {0}}}};
  const NodeTree tree = tree_of(graph);
  ASSERT_EQ(tree.nodes.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i) {
    const NodeTree::Node& node = tree.nodes[i];
    const TriangleMesh& mesh = tree.meshes[node.mesh];
    EXPECT_NEAR((node.rotation.transpose() * node.rotation - Eigen::Matrix3d::Identity()).norm(), 0, 1e-15);
    for (std::size_t v = 0; v < 4; ++v) {
      const Vec3 expected = (graph.nodes[i].transform * graph.parts[0].vertices[v].homogeneous()).head<3>();
      EXPECT_NEAR((node.rotation * mesh.vertices()[v] + node.translation - expected).norm(), 0, 1e-15);
    }
  }
}

TEST(SceneGraph, BodiesShareAMeshWhileTheirPartsAndScalesAreTheSame) {
  const SceneGraph graph{{tetrahedron(), tetrahedron()},
                         {{"a", turned(1), {0}},
                          {"b", turned(2).cast<float>().cast<double>(), {0}},
                          {"c", scaled(2, 2, 2), {0}},
                          {"d", scaled(2, 2, 2), {0}},
                          {"e", scaled(1 + 1e-5, 1, 1), {0}},
                          {"f", turned(1), {1}}}};
  const NodeTree tree = tree_of(graph);
  std::vector<std::size_t> meshes;
  for (const NodeTree::Node& node : tree.nodes) meshes.push_back(node.mesh);
  EXPECT_EQ(meshes, (std::vector<std::size_t>{0, 0, 1, 1, 2, 3}));
  EXPECT_EQ(tree.meshes.size(), 4u);
}

TEST(SceneGraph, NodesWithoutFacesAreNoBodies) {
  SceneGraph graph{{{}, tetrahedron()}, {{"line", turned(0), {0}}, {"part", turned(0), {0, 1}, "id"}}};
  const NodeTree tree = tree_of(graph);
  ASSERT_EQ(tree.nodes.size(), 1u);
  EXPECT_EQ(tree.nodes[0].name, "part");
  EXPECT_EQ(tree.nodes[0].id, "id");
  graph.nodes.pop_back();
  EXPECT_EQ(refusal(graph, tree_of), "no node has a triangle");
  EXPECT_NE(refusal(graph, mesh_of), "accepted");
}

TEST(SceneGraph, RefusesProjectionsAndWhatIsNotFinite) {
  Matrix4d projection = Matrix4d::Identity(), infinite = Matrix4d::Identity();
  projection(3, 2) = 1e-9;
  infinite(0, 3) = INFINITY;
  for (const auto& [transform, why] : {std::pair{projection, "a projection"}, {infinite, "not finite"}}) {
    const SceneGraph graph{{tetrahedron()}, {{"arm", transform, {0}}}};
    EXPECT_EQ(refusal(graph, mesh_of), std::string("node 'arm': its transform is ") + why);
    EXPECT_EQ(refusal(graph, tree_of), std::string("node 'arm': its transform is ") + why);
  }
  const SceneGraph overflows{{tetrahedron()}, {{"arm", scaled(1e308, 1e308, 1e308), {0}}}};
  EXPECT_NE(refusal(overflows, mesh_of), "accepted");
}

TEST(SceneGraph, RefusesMoreVerticesThanIndicesCanNameBeforeItTakesMemory) {
  SceneGraph::Part part = tetrahedron();
  part.vertices.resize(1 << 16);
  const SceneGraph graph{{part}, std::vector<SceneGraph::Node>(1 << 16, {"leaf", turned(0), {0}})};
  EXPECT_NE(refusal(graph, mesh_of).find("place more than 4294967295 vertices"), std::string::npos);
}

}  // namespace
}  // namespace touchmark::mesh_io
