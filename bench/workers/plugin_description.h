/// What a plug-in says that it is, asked in a worker: loading it may crash, hang or print.
#pragma once

#include <string>

#include "bench/contestants/contestant_info.h"
#include "bench/workload/steps.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::workers {

/// Returns the contestant of this file. It is built in workers alone, as all are. Throws
/// std::invalid_argument for what is no plug-in, and ResourceError.
contestants::ContestantInfo described_plugin(const std::string& path);

/// Returns a script that shows the answer to a step in the engine's own API: what the plug-in's `reproduce`
/// makes of this mesh and question; `from` is where a sweep begins. Empty where the plug-in has no such
/// function. Throws std::invalid_argument with what it raises, and ResourceError.
std::string reproduction(const std::string& path, const TriangleMesh& mesh, workload::Query query,
                         const Vec3& from, const workload::Step& step);

}  // namespace touchmark::bench::workers
