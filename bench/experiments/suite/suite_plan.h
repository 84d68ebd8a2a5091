/// What `touchmark bench --suite` measures: cells of mesh, motion, question and reach, as many of each kind
/// as of any other, however few are chosen. Motions that no hand makes are a section "stress".
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bench/support/names.h"
#include "bench/workload/answer.h"

namespace touchmark::bench::experiments::suite {

/// Which caches are emptied before each query.
enum class Caches { warm, l2, cold };

inline constexpr std::array<support::Name<Caches>, 3> cache_names{
    {{Caches::warm, "warm"}, {Caches::l2, "l2"}, {Caches::cold, "cold"}}};
constexpr std::string_view name_of(Caches caches) { return support::name_in(cache_names, caches); }

/// One thing to measure on a mesh.
struct SuiteCell {
  std::string trajectory;  ///< as --trajectory takes it: "slide:speed=0.1%"
  workload::Query query = workload::Query::nearest;
  std::string reach;    ///< as --reach takes it; "inf" is of `nearest` only
  bool stress = false;  ///< the motion is faster than hands, and the cell is in no score
  bool l2 = false;      ///< also with the second-level cache emptied
  bool cold = false;    ///< also with all caches emptied, which takes longest

  /// True if the motion stays within the probe's radius of the surface.
  bool is_in_contact() const { return trajectory == "hand" || trajectory.starts_with("slide"); }

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

/// Returns every cell of one mesh: motions, three queries, four reaches; all that makes sense. The motions
/// are the kinds of `hand`, and three others at two speeds of hands; of the stress these at two higher
/// speeds, and one without coherence.
std::vector<SuiteCell> every_cell();

/// Returns the meshes: every kind that comes in any size, from about a sixth of `triangles` to twice as many,
/// some more, and scans where their files are installed.
std::vector<std::string> suite_meshes(std::uint64_t triangles);

/// Chooses `cells_each` cells, at least 1, for every mesh (all, where there are not so many), such that over
/// the plan the motions, and the queries with their reaches, come up equally often in each section. Every
/// sixth is of the stress. A plan of fewer cells is the beginning of one of more. Where `emptied`, all but
/// the stress are also measured with the second-level cache emptied, and the first of each mesh with all
/// caches.
SuitePlan make_plan(const std::vector<std::string>& meshes, std::size_t cells_each, std::uint64_t seed,
                    bool emptied = true);

}  // namespace touchmark::bench::experiments::suite
