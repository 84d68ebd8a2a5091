#include "bench/ground_truth/rounded_mesh.h"

#include <utility>

namespace touchmark::bench::ground_truth {
namespace {

TriangleMesh rounded(const TriangleMesh& mesh, const contestants::StorageRounding& storage_rounding) {
  std::vector<Vec3> vertices;
  vertices.reserve(mesh.vertices().size());
  for (const Vec3& vertex : mesh.vertices()) vertices.push_back(storage_rounding.point(vertex));
  return {std::move(vertices),
          {mesh.triangles().begin(), mesh.triangles().end()},
          {mesh.ids().begin(), mesh.ids().end()}};
}

}  // namespace

RoundedMesh::RoundedMesh(const TriangleMesh& mesh, contestants::StorageRounding storage_rounding)
    : storage_rounding_(std::move(storage_rounding)),
      mesh_(rounded(mesh, storage_rounding_)),
      oracle_(mesh_) {}

std::vector<workload::Step> RoundedMesh::trace(std::span<const workload::Step> steps) const {
  std::vector<workload::Step> trace;
  trace.reserve(steps.size());
  for (const workload::Step& step : steps) {
    const Probe probe{storage_rounding_.point(step.probe.center),
                      storage_rounding_.length(step.probe.radius)};
    trace.push_back({probe, storage_rounding_.length(step.reach)});
  }
  return trace;
}

}  // namespace touchmark::bench::ground_truth
