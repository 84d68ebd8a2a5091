#include "bench/experiments/proxy/course_makers.h"

#include <utility>

namespace touchmark::bench::experiments::proxy {

Frame any_frame(support::Random& random) {
  const Vec3 z = random.direction();
  const Vec3 x = z.unitOrthogonal();
  return {x, z.cross(x), z};
}

TriangleMesh placed(const TriangleMesh& mesh, double scale, const Frame& frame) {
  std::vector<Vec3> vertices;
  vertices.reserve(mesh.vertices().size());
  for (const Vec3& vertex : mesh.vertices()) vertices.push_back(frame(scale * vertex));
  return {std::move(vertices), {mesh.triangles().begin(), mesh.triangles().end()}};
}

Course exploring(std::string name, TriangleMesh mesh, double radius, std::uint64_t seed, std::size_t ticks) {
  support::Random random(seed);
  const Vec3 middle = (mesh.bounds().min + mesh.bounds().max) / 2;
  const Vec3 start = middle + (0.6 * mesh.diagonal() + 2 * radius) * random.direction();
  Motion motion(start, ticks);
  explore(mesh, random, motion);
  return {std::move(name), std::move(mesh), radius, 0, start, std::move(motion).take()};
}

}  // namespace touchmark::bench::experiments::proxy
