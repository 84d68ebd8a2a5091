/// One mesh, the trajectories on it, and how far is looked along them: the same for every contestant.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/trajectories/trajectory.h"
#include "bench/workload/selection.h"
#include "bench/workload/steps.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::workload {

/// How fast a trajectory is, and what its file says of time.
struct Pace {
  double mean_speed = 0, max_speed = 0;  ///< mesh units a second
  std::optional<trajectories::RecordedTiming> recorded;
};

struct Workload {
  std::string mesh_name;
  TriangleMesh mesh;
  double radius = 0;            ///< mesh units; of the trajectories that bring none of their own
  std::optional<double> reach;  ///< mesh units; nothing: each probe's radius
  std::vector<std::string> trajectories;
  std::vector<std::vector<Step>> traces;                   ///< one a trajectory
  std::vector<Pace> motions = {};                          ///< one a trajectory, or none
  std::optional<support::LengthUnit> unit = std::nullopt;  ///< nothing: unknown
};

/// Generates the trajectories, of `default_steps` unless --steps was given, or reads them whole. Says on
/// stderr, once, where a file has times and its rows are steps nevertheless. Throws std::invalid_argument.
Workload make_workload(std::string mesh_name, TriangleMesh mesh, const Selection& selection,
                       const std::vector<std::string>& trajectories, std::size_t default_steps);

/// A length of the workload as reports write it: with its unit where that is known.
std::string length_text(const Workload& workload, double length);

/// What reports say of a trajectory beside its name: "20000 steps", its times and, where the unit is known,
/// its speed.
std::string trace_text(const Workload& workload, std::size_t trace);

}  // namespace touchmark::bench::workload
