/// The schemes against OpenMesh's and OpenSubdiv's, on irregular closed and open meshes.
#include <algorithm>
#include <array>
#include <memory>
#include <vector>

// OpenMesh copies a default-constructed number when it adds a property.
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wmaybe-uninitialized"
#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/LoopT.hh>
#include <OpenMesh/Tools/Subdivider/Uniform/ModifiedButterFlyT.hh>
#pragma GCC diagnostic pop
#include <gtest/gtest.h>
#include <opensubdiv/far/primvarRefiner.h>
#include <opensubdiv/far/topologyDescriptor.h>
#include <opensubdiv/far/topologyRefinerFactory.h>

#include "core/subdivision/subdivision.h"
#include "tests/core/subdivision/meshes.h"

namespace touchmark {
namespace {

using Points = std::vector<Vec3>;

/// Both sets sorted in cells far smaller than the meshes and far larger than a rounding, then compared one by
/// one.
void expect_same_points(Points a, Points b) {
  ASSERT_EQ(a.size(), b.size());
  double largest = 0;
  std::vector<bool> taken(b.size(), false);
  for (const Vec3& p : a) {
    std::size_t nearest = 0;
    double least = 1e300;
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (taken[i] || (b[i] - p).squaredNorm() >= least) continue;
      least = (b[i] - p).squaredNorm();
      nearest = i;
    }
    taken[nearest] = true;
    largest = std::max(largest, std::sqrt(least));
  }
  EXPECT_LT(largest, 1e-13);
}

Points vertices_of(const TriangleMesh& mesh) { return {mesh.vertices().begin(), mesh.vertices().end()}; }

Points centroids_of(const TriangleMesh& mesh) {
  Points points;
  for (std::size_t t = 0; t < mesh.size(); ++t)
    points.push_back((mesh.corner(t, 0) + mesh.corner(t, 1) + mesh.corner(t, 2)) / 3);
  return points;
}

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using OpenMeshMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

template <typename Subdivider>
TriangleMesh by_openmesh(const TriangleMesh& coarse, std::size_t levels) {
  OpenMeshMesh mesh;
  for (const Vec3& v : coarse.vertices()) mesh.add_vertex({v.x(), v.y(), v.z()});
  const auto handle = [](std::uint32_t v) { return OpenMesh::VertexHandle(static_cast<int>(v)); };
  for (const auto& [a, b, c] : coarse.triangles()) mesh.add_face(handle(a), handle(b), handle(c));
  Subdivider subdivider;
  subdivider.attach(mesh);
  subdivider(levels);
  subdivider.detach();
  Points points;
  for (const auto v : mesh.vertices()) {
    const auto& p = mesh.point(v);
    points.emplace_back(p[0], p[1], p[2]);
  }
  std::vector<TriangleMesh::Corners> triangles;
  for (const auto face : mesh.faces()) {
    TriangleMesh::Corners corners{};
    std::size_t i = 0;
    for (const auto v : face.vertices()) corners[i++] = static_cast<std::uint32_t>(v.idx());
    triangles.push_back(corners);
  }
  return {std::move(points), std::move(triangles)};
}

/// What OpenSubdiv interpolates.
struct OsdVertex {
  Vec3 position = Vec3::Zero();
  void Clear(void* = nullptr) { position = Vec3::Zero(); }
  void AddWithWeight(const OsdVertex& source, float weight) {
    position += static_cast<double>(weight) * source.position;
  }
  void AddWithWeight(const OsdVertex& source, double weight) { position += weight * source.position; }
};

Points by_opensubdiv(const TriangleMesh& coarse, OpenSubdiv::Sdc::SchemeType scheme, int levels) {
  using namespace OpenSubdiv;
  std::vector<int> valences(coarse.size(), 3), corners;
  for (const auto& triangle : coarse.triangles())
    for (const std::uint32_t v : triangle) corners.push_back(static_cast<int>(v));
  Far::TopologyDescriptor descriptor;
  descriptor.numVertices = static_cast<int>(coarse.vertices().size());
  descriptor.numFaces = static_cast<int>(coarse.size());
  descriptor.numVertsPerFace = valences.data();
  descriptor.vertIndicesPerFace = corners.data();
  Sdc::Options options;
  options.SetVtxBoundaryInterpolation(Sdc::Options::VTX_BOUNDARY_EDGE_ONLY);
  using Factory = Far::TopologyRefinerFactory<Far::TopologyDescriptor>;
  const std::unique_ptr<Far::TopologyRefiner> refiner(
      Factory::Create(descriptor, Factory::Options(scheme, options)));
  refiner->RefineUniform(Far::TopologyRefiner::UniformOptions(levels));
  const Far::PrimvarRefinerReal<double> interpolator(*refiner);
  std::vector<OsdVertex> level;
  for (const Vec3& v : coarse.vertices()) level.push_back({v});
  for (int l = 1; l <= levels; ++l) {
    std::vector<OsdVertex> next(static_cast<std::size_t>(refiner->GetLevel(l).GetNumVertices()));
    interpolator.Interpolate(l, level, next);
    level = std::move(next);
  }
  Points points;
  for (const OsdVertex& v : level) points.push_back(v.position);
  return points;
}

TriangleMesh ours(const TriangleMesh& coarse, SubdivisionMethod method, int levels) {
  return subdivide(coarse, {.method = method, .levels = levels});
}

void expect_same_mesh(const TriangleMesh& a, const TriangleMesh& b) {
  expect_same_points(vertices_of(a), vertices_of(b));
  expect_same_points(centroids_of(a), centroids_of(b));
}

TriangleMesh torus() { return test::shaken_torus(8, 5, 0.2); }
/// Every vertex extraordinary, of valence 3 to 5, with a few edges between equal and unequal ones.
TriangleMesh closed_irregular() {
  return test::shaken(
      subdivide(test::octahedron(), {.method = SubdivisionMethod::mid_point, .levels = 1, .threshold = 1.3}),
      0.1, 2);
}

TEST(AgainstOpenMesh, LoopIsTheSame) {
  using Loop = OpenMesh::Subdivider::Uniform::LoopT<OpenMeshMesh>;
  for (const TriangleMesh& coarse : {torus(), closed_irregular(), test::tetrahedron(), test::open_patch()})
    expect_same_mesh(ours(coarse, SubdivisionMethod::loop, 2), by_openmesh<Loop>(coarse, 2));
}

TEST(AgainstOpenMesh, ModifiedButterflyIsTheSameOnClosedMeshes) {
  using Butterfly = OpenMesh::Subdivider::Uniform::ModifiedButterflyT<OpenMeshMesh>;
  for (const TriangleMesh& coarse : {torus(), closed_irregular(), test::icosahedron(), test::tetrahedron()})
    expect_same_mesh(ours(coarse, SubdivisionMethod::butterfly, 2), by_openmesh<Butterfly>(coarse, 2));
}

TEST(AgainstOpenSubdiv, CatmullClarkIsTheSame) {
  for (const TriangleMesh& coarse : {torus(), closed_irregular(), test::tetrahedron(), test::open_patch()}) {
    expect_same_points(vertices_of(ours(coarse, SubdivisionMethod::catmull_clark, 2)),
                       by_opensubdiv(coarse, OpenSubdiv::Sdc::SCHEME_CATMARK, 2));
  }
}

TEST(AgainstOpenSubdiv, LoopIsTheSame) {
  for (const TriangleMesh& coarse : {torus(), closed_irregular(), test::tetrahedron(), test::open_patch()}) {
    expect_same_points(vertices_of(ours(coarse, SubdivisionMethod::loop, 2)),
                       by_opensubdiv(coarse, OpenSubdiv::Sdc::SCHEME_LOOP, 2));
  }
}

}  // namespace
}  // namespace touchmark
