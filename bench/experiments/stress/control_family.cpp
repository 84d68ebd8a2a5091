#include <cmath>
#include <cstdint>
#include <utility>

#include "bench/experiments/stress/corner_cases.h"
#include "bench/experiments/stress/makers.h"
#include "bench/experiments/stress/questions.h"
#include "bench/meshes/generated_meshes.h"
#include "core/float_limits.h"

namespace touchmark::bench::experiments::stress {
namespace {

/// More often few than many.
std::uint32_t some(CornerCases& random, double least, double most) {
  return static_cast<std::uint32_t>(random.magnitude(std::log10(least), std::log10(most + 1)));
}

/// Triangles of every size from a hundredth of the box to all of it, others with each seed.
TriangleMesh scattered(CornerCases& random, std::size_t triangles) {
  std::vector<CornerCases::Corners> list;
  while (list.size() < triangles) {
    const Vec3 position = random.vector();
    const double size = random.magnitude(-2, 0);
    list.push_back({position + size * random.vector(), position + size * random.vector(),
                    position + size * random.vector()});
  }
  return mesh_of(list);
}

/// A point of the box made larger by a tenth, or within a hundredth of the diagonal of the surface.
Vec3 somewhere(CornerCases& random, const TriangleMesh& mesh) {
  if (random.below(2) == 0)
    return mesh.bounds().center() + 0.6 * random.vector().cwiseProduct(mesh.bounds().extent());
  const std::size_t i = random.below(mesh.size());
  const double a = random.fraction(), b = random.fraction();
  const Vec3 on = support::point_in_triangle(mesh.corner(i, 0), mesh.corner(i, 1), mesh.corner(i, 2), a, b);
  return on + 0.01 * mesh.diagonal() * random.vector();
}

}  // namespace

std::vector<workload::Workload> control_family(std::uint64_t seed, std::size_t probes) {
  CornerCases random(seed);
  std::vector<NamedMesh> meshes;
  const auto moved = [&](const TriangleMesh& mesh) {
    return mesh.transformed(random.magnitude(-1, 1), random.vector());
  };
  meshes.push_back({"noisy-sphere", moved(meshes::noisy_sphere(some(random, 6, 100)))});
  meshes.push_back({"torus", moved(meshes::torus(some(random, 3, 10), some(random, 3, 6)))});
  meshes.push_back({"scattered", scattered(random, some(random, 1, 100))});
  const std::size_t each = share_of(probes, meshes.size());
  std::vector<workload::Workload> workloads;
  for (NamedMesh& mesh : meshes) {
    std::vector<workload::Step> trace;
    for (std::size_t i = 0; i < each; ++i) {
      const double radius = random.magnitude(-4, -1) * mesh.mesh.diagonal();
      // As far as they reach, then without end.
      trace.push_back({{somewhere(random, mesh.mesh), radius}, i < each / 2 ? radius : infinity});
    }
    workloads.push_back(workload_on(std::move(mesh), "anywhere", std::move(trace)));
  }
  return workloads;
}

}  // namespace touchmark::bench::experiments::stress
