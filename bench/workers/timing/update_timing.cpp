#include "bench/workers/timing/update_timing.h"

#include <exception>
#include <memory>
#include <vector>

#include "bench/support/median.h"
#include "bench/workers/build_cores.h"

namespace touchmark::bench::workers {

Updated time_updates(contestants::Contestant& contestant, const contestants::Roster& roster,
                     const contestants::ContestantSpec& spec, const TriangleMesh& rest,
                     const meshes::Deformation& deformation) {
  constexpr std::size_t min_rounds = 3, max_rounds = 25;
  constexpr double enough_ns = 1e9;
  Updated updated;
  updated.supported = true;
  const TriangleMesh moved = meshes::deformed(rest, deformation);
  const auto timed_update = [&](const TriangleMesh& mesh) {
    const Clock::time_point start = Clock::now();
    contestant.update(mesh);
    return ns_since(start);
  };
  std::vector<double> builds, updates, ratios;
  const BuildCores cores(spec);
  try {
    contestant.update(rest);
    roster.prepare_to_build(spec, moved.size());
    const Clock::time_point start = Clock::now();
    while (builds.size() < min_rounds || (builds.size() < max_rounds && ns_since(start) < enough_ns)) {
      const double there = timed_update(moved), back = timed_update(rest);
      const Clock::time_point before = Clock::now();
      std::unique_ptr<contestants::Contestant> anew = roster.build(spec, moved);
      builds.push_back(ns_since(before));
      updates.insert(updates.end(), {there, back});
      ratios.push_back(0.5 * (there + back) / builds.back());
    }
    contestant.update(moved);
  } catch (const std::exception& error) {
    updated.refused = error.what();
    return updated;
  }
  updated.rounds = builds.size();
  updated.build_ms = support::median(builds) / 1e6;
  updated.update_ms = support::median(updates) / 1e6;
  updated.update_over_build = support::median(ratios);
  return updated;
}

}  // namespace touchmark::bench::workers
