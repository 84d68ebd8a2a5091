/// What Figs 1 to 6 of Park & Jang are drawn from: the program's own groups, as CSV files under pictures/.
#pragma once

#include <cstddef>

#include "bench/experiments/papers/park_jang/park_jang.h"
#include "bench/results/results_folder.h"

namespace touchmark::bench::experiments::papers {

/// How many groups the pictures show.
struct PicturedGroups {
  std::size_t cubes = 0, spheres = 0;
};

/// The mesh needs a box that can be divided into cells (FilterFrame::fits).
PicturedGroups write_group_pictures(const TriangleMesh& mesh, const ParkJangSettings& settings,
                                    const results::ResultsFolder& folder);

}  // namespace touchmark::bench::experiments::papers
