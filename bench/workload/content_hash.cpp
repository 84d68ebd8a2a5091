#include "bench/workload/content_hash.h"

namespace touchmark::bench::workload {

std::uint64_t hash_of(const TriangleMesh& mesh) {
  ContentHash hash;
  for (const Vec3& vertex : mesh.vertices()) hash.add(vertex.data(), 3 * sizeof(double));
  for (const TriangleMesh::Corners& corners : mesh.triangles()) hash.add(corners.data(), sizeof corners);
  for (const TriangleId id : mesh.ids()) hash.add(&id, sizeof id);
  return hash.value();
}

std::uint64_t hash_of(std::span<const Step> trace) {
  ContentHash hash;
  for (const Step& step : trace) {
    hash.add(step.probe.center.data(), 3 * sizeof(double));
    hash.add(step.probe.radius);
    hash.add(step.reach);
  }
  return hash.value();
}

}  // namespace touchmark::bench::workload
