/// What every report begins with.
#pragma once

#include <string>

#include "bench/experiments/papers/paper_meshes.h"

namespace touchmark::bench::experiments::papers {

/// Machine, compiler and commit, the mesh, and what the times are.
std::string report_setting(const PaperMesh& mesh);
/// The machine's line alone.
std::string report_machine();

}  // namespace touchmark::bench::experiments::papers
