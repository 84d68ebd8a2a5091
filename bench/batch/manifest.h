/// What a sweep consists of, as JSON that travels to the machines that run it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/contestants/roster.h"
#include "bench/contestants/selectors.h"
#include "bench/measurement/effort.h"
#include "bench/workload/workload.h"

namespace touchmark::bench::batch {

inline constexpr int manifest_schema = 1;

struct BatchJob {
  std::string id;  ///< see job_id; also the name of its file
  std::string detector;
};

/// What all rivals are asked alike. Its jobs are run in one process, so that their times can be compared.
struct BatchMesh {
  std::string mesh;  ///< as --mesh takes it
  bool normalize = false;
  std::uint64_t mesh_hash = 0;
  std::string trajectory;        ///< as --trajectory takes it
  std::uint64_t trace_hash = 0;  ///< hash of its steps with radius and reach
  std::size_t steps = 0;
  std::uint64_t seed = 1;
  std::string radius;  ///< as --radius takes it
  std::string reach;   ///< as --reach takes it; empty: the radius
  workload::Query query = workload::Query::nearest;
  std::vector<BatchJob> jobs;
  contestants::MotionSelectors motion = {};  ///< as --columns, --motion-scale and --rate take it
};

/// A contestant that is none of the program's own.
struct BatchPlugin {
  std::string file;  ///< as --plugin takes it
  std::uint64_t hash = 0;
};

struct Manifest {
  std::string version;  ///< the version of the program that planned it
  std::string effort;   ///< full, quick or accuracy
  std::vector<BatchMesh> meshes;
  std::vector<BatchPlugin> plugins = {};

  std::string json() const;
  /// Throws std::invalid_argument for a file that cannot be read or is no manifest, naming line and value.
  static Manifest read(const std::string& path);
  std::size_t jobs() const noexcept;
};

/// Returns the plug-in of a file with the hash of what is in it now. Throws std::invalid_argument.
BatchPlugin plugin_of(const std::string& file);

/// Returns what a job is called by: the contestant's text, for a plug-in with the hash of its file.
std::string identity_of(const contestants::ContestantSpec& contestant);

/// Sixteen hexadecimal digits: a hash of the mesh's and the trace's content, the seed, the query, the
/// detector's identity, the effort and the version. The same wherever and whenever it is computed.
std::string job_id(const BatchMesh& planned, const std::string& detector, const std::string& effort,
                   const std::string& version);

/// Throws std::invalid_argument.
measurement::Effort effort_named(const std::string& name);

/// Mesh and trace of a planned mesh, to be hashed while planning or to be run. Throws std::invalid_argument
/// or MeshError.
workload::Workload workload_of(const BatchMesh& planned, const contestants::Roster& roster);

}  // namespace touchmark::bench::batch
