/// One mesh, the trajectories on it, and how far is looked along them: the same for every contestant.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "bench/scenes/generated_bodies.h"
#include "bench/scenes/schedule.h"
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
  std::string mesh_name;        ///< the scene's where there is one
  TriangleMesh mesh;            ///< a scene's is the one that its built-in trajectories were made on
  double radius = 0;            ///< mesh units; of the trajectories that bring none of their own
  std::optional<double> reach;  ///< mesh units; nothing: each probe's radius
  std::vector<std::string> trajectories;
  std::vector<std::vector<Step>> traces;                     ///< one a trajectory
  std::vector<Pace> motions = {};                            ///< one a trajectory, or none
  std::optional<support::LengthUnit> unit = std::nullopt;    ///< nothing: unknown
  std::shared_ptr<const scenes::BodyScene> scene = nullptr;  ///< null: the mesh alone, which stands
  std::vector<scenes::Schedule> schedules = {};              ///< one a trajectory of a scene

  std::size_t triangles() const noexcept { return scene ? scene->triangles() : mesh.size(); }
};

/// Generates the trajectories, of `default_steps` unless --steps was given, or reads them whole. Says on
/// stderr, once, where a file has times and its rows are steps nevertheless. Throws std::invalid_argument.
Workload make_workload(std::string mesh_name, TriangleMesh mesh, const Selection& selection,
                       const std::vector<std::string>& trajectories, std::size_t default_steps);

/// Makes a workload over a scene of bodies. Percentages are of the box of all bodies at the start. A built-in
/// trajectory is made over the scene as it stands at the start (over its first bodies, where all together
/// have more than two million triangles), and each position is then carried along by the body that is
/// nearest to it there: what touches a body keeps touching it. A file's positions are where it says. A step's
/// time is the file's, or its number divided by the rate, which is 1000 where none was given.
Workload make_scene_workload(scenes::GeneratedScene scene, const Selection& selection,
                             const std::vector<std::string>& trajectories, std::size_t default_steps);

/// A length of the workload as reports write it: with its unit where that is known.
std::string length_text(const Workload& workload, double length);

/// What reports begin with: "bunny: 69666 triangles, nearest within 0.01, radius 0.01", with the bodies of a
/// scene.
std::string question_text(const Workload& workload, Query query);

/// What reports say of a trajectory beside its name: "20000 steps", its times and, where the unit is known,
/// its speed.
std::string trace_text(const Workload& workload, std::size_t trace);

}  // namespace touchmark::bench::workload
