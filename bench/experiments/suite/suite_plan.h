/// What `touchmark bench --suite` measures: cells of mesh, motion, question and reach, as many of each kind
/// as of any other, however few are chosen.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/workload/answer.h"

namespace touchmark::bench::experiments::suite {

/// One thing to measure on a mesh.
struct SuiteCell {
  std::string trajectory;  ///< as --trajectory takes it: "slide:speed=0.1%"
  workload::Query query = workload::Query::nearest;
  std::string reach;  ///< as --reach takes it; "inf" is of `nearest` only
  bool cold = false;  ///< also with emptied caches

  /// Returns the probe's radius, as --radius takes it: the reach, so that a slide stays within it.
  std::string radius() const { return reach == "inf" ? "0.5%" : reach; }
};

struct SuiteMesh {
  std::string mesh;  ///< as --mesh takes it
  std::vector<SuiteCell> cells;
};

struct SuitePlan {
  std::vector<SuiteMesh> meshes;

  std::size_t cells() const noexcept;
};

/// Returns every cell of one mesh: four speeds of three motions and one without coherence, three queries,
/// four reaches; all that makes sense.
std::vector<SuiteCell> every_cell();

/// Returns the meshes: every kind that comes in any size, from about a sixth of `triangles` to twice as many,
/// some more, and scans where their files are installed.
std::vector<std::string> suite_meshes(std::uint64_t triangles);

/// Chooses `cells_each` cells, at least 1, for every mesh (all, where there are not so many), such that over
/// the plan the motions, and the queries with their reaches, come up equally often, as in all cells. A plan
/// of fewer cells is the beginning of one of more. Where `cold`, the last of each mesh is also measured so:
/// it takes longest, and is what is left out where time is short.
SuitePlan make_plan(const std::vector<std::string>& meshes, std::size_t cells_each, std::uint64_t seed,
                    bool cold = true);

}  // namespace touchmark::bench::experiments::suite
