/// Trajectories by name, or from a CSV file: seeded, and the same bits for every contestant on every machine.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/support/length_unit.h"
#include "bench/trajectories/motion_options.h"
#include "bench/trajectories/trajectory.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::trajectories {

struct TrajectoryInfo {
  std::string name;
  std::string description;  ///< one line
  double own_percent = 0;   ///< its speed, % of the diagonal a tick, with 8,000 steps or more; 0: it has none
  std::string words = {};   ///< what may follow its name, in brackets
};

/// Returns the trajectories that need no file.
std::vector<TrajectoryInfo> trajectories();

struct TrajectoryOptions {
  std::size_t steps =
      0;  ///< 0: 20,000 generated ones, all of a file; else at most the first so many of a file
  std::uint64_t seed = 1;     ///< for generated ones
  double radius = 0;          ///< the probe's, mesh units: says what "in contact" is; may be infinite
  MotionOptions motion = {};  ///< for a file
  std::optional<support::LengthUnit> unit = std::nullopt;  ///< the mesh's; nothing: unknown
};

/// True of a name from the list, with or without its words.
bool is_generated(const std::string& name);

/// `what` is a name from the list, perhaps with words ("slide:speed=0.4%", "hand:tap"), or the path of a CSV
/// file (trajectory_csv.h). Lengths are measured in box diagonals, so a scaled mesh gets a scaled trajectory;
/// a mesh that is a single point counts its radius, or 1, for a diagonal. Throws std::invalid_argument for an
/// unknown name, a file that cannot be used, or a radius that is negative or not a number.
Trajectory make_trajectory(const std::string& what, const TriangleMesh& mesh,
                           const TrajectoryOptions& options = {});

}  // namespace touchmark::bench::trajectories
