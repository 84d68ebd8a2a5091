#include "bench/ground_truth/rounded_scene.h"

#include <utility>

namespace touchmark::bench {
namespace {

TriangleMesh stored(const TriangleMesh& mesh, const Storing& storing) {
  std::vector<Vec3> vertices;
  vertices.reserve(mesh.vertices().size());
  for (const Vec3& vertex : mesh.vertices()) vertices.push_back(storing.point(vertex));
  return {std::move(vertices),
          {mesh.triangles().begin(), mesh.triangles().end()},
          {mesh.ids().begin(), mesh.ids().end()}};
}

}  // namespace

StoredScene::StoredScene(const TriangleMesh& mesh, Storing storing)
    : storing_(std::move(storing)), mesh_(stored(mesh, storing_)), oracle_(mesh_) {}

std::vector<Step> StoredScene::course(std::span<const Step> steps) const {
  std::vector<Step> course;
  course.reserve(steps.size());
  for (const Step& step : steps) {
    const Probe probe{storing_.point(step.probe.center), storing_.length(step.probe.radius)};
    course.push_back({probe, storing_.length(step.reach)});
  }
  return course;
}

}  // namespace touchmark::bench
