#include <utility>

#include "bench/experiments/stress/makers.h"
#include "bench/experiments/stress/questions.h"
#include "bench/meshes/generated_meshes.h"
#include "bench/trajectories/trajectories.h"

namespace touchmark::bench::experiments::stress {

std::vector<workload::Workload> motions(std::uint64_t seed, std::size_t probes) {
  std::vector<NamedMesh> meshes;
  meshes.push_back({"torus:48x24", meshes::torus(48, 24)});
  meshes.push_back({"thin-plate", meshes::thin_plate()});
  meshes.push_back({"noisy-sphere:2000", meshes::noisy_sphere(2000)});
  meshes.push_back({"wedge", meshes::wedge()});
  meshes.push_back({"soup:1000", meshes::soup(1000)});
  const std::vector<trajectories::TrajectoryInfo> shapes = trajectories::trajectories();
  const std::size_t steps = share_of(probes, meshes.size() * shapes.size());
  std::vector<workload::Workload> workloads;
  for (NamedMesh& mesh : meshes) {
    const double radius = 0.005 * mesh.mesh.diagonal();
    workload::Workload workload{std::move(mesh.name), std::move(mesh.mesh), radius, {}, {}, {}};
    for (const trajectories::TrajectoryInfo& shape : shapes) {
      const trajectories::Trajectory motion =
          trajectories::make_trajectory(shape.name, workload.mesh, {steps, seed, radius});
      std::vector<workload::Step>& trace = workload.traces.emplace_back();
      for (const Vec3& position : motion.positions) trace.push_back(asked(position, radius));
      workload.trajectories.push_back(shape.name);
    }
    workloads.push_back(std::move(workload));
  }
  return workloads;
}

}  // namespace touchmark::bench::experiments::stress
