/// What our detectors looked at in the slowest and in the wrong steps of a run: visited.json.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/measurement/result_row.h"
#include "bench/support/temporary_file.h"
#include "bench/workload/workload.h"

namespace touchmark::bench::cli {

inline constexpr const char* visited_file_name = "visited.json";

/// What the tracer reads and writes. Throws ResourceError where no temporary file can be made.
struct TracerFiles {
  support::File input = support::temporary_file(), output = support::temporary_file();
};

/// Returns the file's text, of the rows that touchmark-tracer can ask again: `nearest` and `touches` of the
/// exact forms of aabb-tree, grid-group and sphere-cluster. Nothing where there is no such row, the mesh has
/// more than two million triangles, or the
/// program is not there or fails; then it says so on stderr.
std::optional<std::string> step_visits(const std::string& run_id, const workload::Workload& workload,
                                       const std::vector<measurement::ResultRow>& rows,
                                       const TracerFiles& files);

}  // namespace touchmark::bench::cli
