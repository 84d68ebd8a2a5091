/// One mesh, the trajectories on it, and how far is looked along them: the same for every contestant.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/contestant.h"
#include "bench/selectors.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench {

struct Workload {
  std::string mesh_name;
  TriangleMesh mesh;
  double radius = 0;            ///< mesh units; of the trajectories that bring none of their own
  std::optional<double> reach;  ///< mesh units; nothing: each probe's radius
  std::vector<std::string> trajectories;
  std::vector<std::vector<Step>> courses;  ///< one a trajectory
};

/// Generates the trajectories, of `default_steps` unless --steps was given, or reads them whole. Throws
/// std::invalid_argument.
Workload make_workload(std::string mesh_name, TriangleMesh mesh, const Selection& selection,
                       const std::vector<std::string>& trajectories, std::size_t default_steps);

}  // namespace touchmark::bench
