#include <utility>

#include "bench/experiments/stress/makers.h"
#include "bench/experiments/stress/questions.h"
#include "bench/scenes/generated_scenes.h"
#include "bench/trajectories/trajectories.h"

namespace touchmark::bench::stress {

std::vector<Workload> motions(std::uint64_t seed, std::size_t probes) {
  std::vector<NamedMesh> meshes;
  meshes.push_back({"torus:48x24", torus(48, 24)});
  meshes.push_back({"thin-plate", thin_plate()});
  meshes.push_back({"noisy-sphere:2000", noisy_sphere(2000)});
  meshes.push_back({"wedge", wedge()});
  meshes.push_back({"soup:1000", soup(1000)});
  const std::vector<TrajectoryInfo> shapes = trajectories();
  const std::size_t steps = share_of(probes, meshes.size() * shapes.size());
  std::vector<Workload> workloads;
  for (NamedMesh& mesh : meshes) {
    const double radius = 0.005 * mesh.mesh.diagonal();
    Workload workload{std::move(mesh.name), std::move(mesh.mesh), radius, {}, {}, {}};
    for (const TrajectoryInfo& shape : shapes) {
      const Trajectory motion = make_trajectory(shape.name, workload.mesh, {steps, seed, radius});
      std::vector<Step>& trace = workload.traces.emplace_back();
      for (const Vec3& position : motion.positions) trace.push_back(asked(position, radius));
      workload.trajectories.push_back(shape.name);
    }
    workloads.push_back(std::move(workload));
  }
  return workloads;
}

}  // namespace touchmark::bench::stress
