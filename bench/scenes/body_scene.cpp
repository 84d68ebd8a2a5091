#include "bench/scenes/body_scene.h"

#include <utility>

namespace touchmark::bench::scenes {

Aabb bounds_of(const BodyScene& scene) {
  Aabb box;
  for (const Body& body : scene.bodies) {
    const Pose pose = pose_of(body.start);
    if (const auto round = scene.round.find(body.shape); round != scene.round.end()) {
      Aabb axis;
      for (const double z : {-round->second.half_length, round->second.half_length})
        axis.extend(image(pose, {0, 0, z}));
      box.extend(axis.padded(round->second.radius));
      continue;
    }
    for (const Vec3& vertex : scene.shapes[body.shape]->vertices()) box.extend(image(pose, vertex));
  }
  return box;
}

TriangleMesh merged(const BodyScene& scene, std::size_t most) {
  std::vector<Vec3> vertices;
  std::vector<TriangleMesh::Corners> triangles;
  for (const Body& body : scene.bodies) {
    const TriangleMesh& shape = *scene.shapes[body.shape];
    if (!triangles.empty() && triangles.size() + shape.size() > most) break;
    const auto first = static_cast<std::uint32_t>(vertices.size());
    const Pose pose = pose_of(body.start);
    for (const Vec3& vertex : shape.vertices()) vertices.push_back(image(pose, vertex));
    for (const TriangleMesh::Corners& corners : shape.triangles())
      triangles.push_back({first + corners[0], first + corners[1], first + corners[2]});
  }
  return {std::move(vertices), std::move(triangles)};
}

}  // namespace touchmark::bench::scenes
