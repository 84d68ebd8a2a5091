/// The mesh, scene and trajectories that the selectors name.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "bench/contestants/selectors.h"
#include "bench/scenes/scene_source.h"
#include "bench/workload/workload.h"

namespace touchmark::bench::cli {

/// Returns the first mesh, or the default one.
std::string mesh_of(const contestants::Selectors& selectors);

/// Loads --scene with its poses. Throws as load_body_scene.
scenes::GeneratedScene scene_of(const contestants::Selectors& selectors);

/// Returns the workload over the scene or, without one, over the mesh. Throws as make_workload.
workload::Workload workload_of(const contestants::Selectors& selectors, const std::string& mesh,
                               const workload::Selection& selection,
                               const std::vector<std::string>& trajectories, std::size_t default_steps);

}  // namespace touchmark::bench::cli
