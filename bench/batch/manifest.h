/// What a sweep consists of, as JSON that travels to the machines that run it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/contestants/selectors.h"
#include "bench/measurement/effort.h"
#include "bench/workload/workload.h"

namespace touchmark::bench {

inline constexpr int manifest_schema = 1;

struct SweepJob {
  std::string id;  ///< see job_id; also the name of its file
  std::string detector;
};

/// What all rivals are asked alike. Its jobs are run in one process, so that their times can be compared.
struct SweepScene {
  std::string mesh;  ///< as --mesh takes it
  bool normalize = false;
  std::uint64_t mesh_hash = 0;
  std::string trajectory;         ///< as --trajectory takes it
  std::uint64_t course_hash = 0;  ///< of its steps with radius and reach
  std::size_t steps = 0;
  std::uint64_t seed = 1;
  std::string radius;  ///< as --radius takes it
  std::string reach;   ///< as --reach takes it; empty: the radius
  Query query = Query::nearest;
  std::vector<SweepJob> jobs;
  MotionSelectors motion = {};  ///< as --columns, --motion-scale and --rate take it
};

struct Manifest {
  std::string version;  ///< of the program that planned it
  std::string effort;   ///< full, quick or accuracy
  std::vector<SweepScene> scenes;

  std::string json() const;
  /// Throws std::invalid_argument for a file that cannot be read or is no manifest, naming line and value.
  static Manifest read(const std::string& path);
  std::size_t jobs() const noexcept;
};

/// Sixteen hexadecimal digits: a hash of the mesh's and the course's content, the seed, the query, the
/// detector, the effort and the version. The same wherever and whenever it is computed.
std::string job_id(const SweepScene& scene, const std::string& detector, const std::string& effort,
                   const std::string& version);

/// Throws std::invalid_argument.
Effort effort_named(const std::string& name);

/// Mesh and course of a scene, to be hashed while planning or to be run. Throws std::invalid_argument or
/// MeshError.
Workload workload_of(const SweepScene& scene, const Roster& roster);

}  // namespace touchmark::bench
