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

std::uint64_t hash_of_things(const Workload& workload) {
  if (!workload.scene) return hash_of(workload.mesh);
  ContentHash hash;
  for (const auto& shape : workload.scene->shapes) {
    const std::uint64_t content = hash_of(*shape);
    hash.add(&content, sizeof content);
  }
  for (const scenes::Body& body : workload.scene->bodies) {
    const std::uint64_t shape = body.shape;
    hash.add(body.name);
    hash.add(&shape, sizeof shape);
    hash.add(body.start.position.data(), 3 * sizeof(double));
    for (const double component : body.start.orientation) hash.add(component);
  }
  return hash.value();
}

std::uint64_t hash_of_motion(const Workload& workload, std::size_t trace) {
  const std::uint64_t steps = hash_of(workload.traces[trace]);
  if (!workload.scene) return steps;
  ContentHash hash;
  hash.add(&steps, sizeof steps);
  const scenes::Schedule& schedule = workload.schedules[trace];
  hash.add(schedule.first.data(), schedule.first.size() * sizeof schedule.first[0]);
  hash.add(schedule.moves.data(), schedule.moves.size() * sizeof schedule.moves[0]);
  return hash.value();
}

}  // namespace touchmark::bench::workload
