#include "bench/cli/selected_workload.h"

#include "bench/meshes/meshes.h"
#include "bench/results/system_info.h"

namespace touchmark::bench::cli {

std::string mesh_of(const contestants::Selectors& selectors) {
  return selectors.meshes.empty() ? meshes::default_mesh() : selectors.meshes.front();
}

scenes::GeneratedScene scene_of(const contestants::Selectors& selectors) {
  return scenes::load_body_scene(selectors.scene, selectors.poses, selectors.packages);
}

workload::Workload workload_of(const contestants::Selectors& selectors, const std::string& mesh,
                               const workload::Selection& selection,
                               const std::vector<std::string>& trajectories, std::size_t default_steps) {
  if (!selectors.scene.empty())
    return workload::make_scene_workload(scene_of(selectors), selection, trajectories, default_steps);
  return workload::make_workload(results::without_directories(mesh),
                                 meshes::load_mesh(mesh, selectors.normalize), selection, trajectories,
                                 default_steps);
}

}  // namespace touchmark::bench::cli
