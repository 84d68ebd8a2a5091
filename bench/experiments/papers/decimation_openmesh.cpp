#include <OpenMesh/Core/Mesh/TriMesh_ArrayKernelT.hh>
#include <OpenMesh/Tools/Decimater/DecimaterT.hh>
#include <OpenMesh/Tools/Decimater/ModQuadricT.hh>
#include <fmt/format.h>

#include "bench/experiments/papers/decimation.h"
#include "core/subdivision/subdivision.h"

namespace touchmark::bench::experiments::papers {
namespace {

struct DoubleTraits : OpenMesh::DefaultTraits {
  using Point = OpenMesh::Vec3d;
  using Normal = OpenMesh::Vec3d;
};
using OpenMeshMesh = OpenMesh::TriMesh_ArrayKernelT<DoubleTraits>;

OpenMeshMesh converted(const TriangleMesh& mesh) {
  OpenMeshMesh result;
  std::vector<OpenMeshMesh::VertexHandle> vertices;
  for (const Vec3& v : mesh.vertices()) vertices.push_back(result.add_vertex({v.x(), v.y(), v.z()}));
  for (std::size_t i = 0; i < mesh.size(); ++i) {
    const TriangleMesh::Corners& c = mesh.triangles()[i];
    if (!result.add_face(vertices[c[0]], vertices[c[1]], vertices[c[2]]).is_valid())
      throw MeshError(fmt::format("cannot decimate: triangle {} makes the mesh non-manifold", i));
  }
  return result;
}

TriangleMesh converted(const OpenMeshMesh& mesh) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  for (const auto v : mesh.vertices()) {
    const OpenMesh::Vec3d& p = mesh.point(v);
    vertices.emplace_back(p[0], p[1], p[2]);
  }
  for (const auto f : mesh.faces()) {
    TriangleMesh::Corners corners{};
    std::size_t k = 0;
    for (const auto v : mesh.fv_range(f)) corners[k++] = static_cast<std::uint32_t>(v.idx());
    triangles.push_back(corners);
  }
  return {std::move(vertices), std::move(triangles)};
}

}  // namespace

bool can_decimate() noexcept { return true; }

TriangleMesh decimate(const TriangleMesh& mesh, std::size_t triangles) {
  const TriangleMesh welded = subdivide(mesh, {.levels = 0});
  if (welded.size() <= triangles) return welded;
  OpenMeshMesh work = converted(welded);
  OpenMesh::Decimater::DecimaterT<OpenMeshMesh> decimater(work);
  OpenMesh::Decimater::ModQuadricT<OpenMeshMesh>::Handle quadric;
  decimater.add(quadric);
  decimater.module(quadric).unset_max_err();
  decimater.initialize();
  decimater.decimate_to_faces(0, triangles);
  work.garbage_collection();
  return converted(work);
}

}  // namespace touchmark::bench::experiments::papers
