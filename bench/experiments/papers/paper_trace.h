/// The steps that all detectors of one experiment are asked about.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/contestants/contestant.h"
#include "bench/trajectories/trajectories.h"

namespace touchmark::bench::experiments::papers {

/// One probe of this radius a position of the trajectory, and as far as that radius is looked.
inline std::vector<workload::Step> paper_trace(const std::string& trajectory, const TriangleMesh& mesh,
                                               std::size_t steps, std::uint64_t seed, double radius) {
  std::vector<workload::Step> trace;
  for (const Vec3& position :
       trajectories::make_trajectory(trajectory, mesh, {steps, seed, radius}).positions)
    trace.push_back({{position, radius}, radius});
  return trace;
}

}  // namespace touchmark::bench::experiments::papers
