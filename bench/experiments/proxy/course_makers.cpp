#include "bench/experiments/proxy/course_makers.h"

#include <cmath>
#include <utility>

#include "bench/meshes/portable_sincos.h"

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

double Swing::at(std::size_t change) const {
  const double turns = static_cast<double>(change) / period + phase;
  return meshes::portable_sincos(turns - std::floor(turns)).sin;
}

std::vector<Vec3> about_the_middle(const Vec3& start, std::size_t ticks, support::Random& random) {
  Motion motion(start, ticks);
  while (!motion.done()) {
    motion.line(0.2 * course_size * random.unit() * random.direction(), 10 + random.below(40));
    motion.rest(random.below(30));
    if (random.below(4) == 0) motion.line(course_size * random.direction(), 20);
  }
  return std::move(motion).take();
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
