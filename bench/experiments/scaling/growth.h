/// How a contestant grows with the mesh: power laws through the rows of a comparison on meshes of several
/// sizes, as scaling.csv and as a table.
#pragma once

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

#include "bench/experiments/scaling/power_law.h"
#include "bench/measurement/result_row.h"

namespace touchmark::bench::experiments::scaling {

/// What shrinks as the edges of a mesh of more triangles do, so that its part in the growth can be told.
enum class Shrinks { nothing, reach, reach_and_motion };

/// Returns "", "reach" or "all", as the command line and scaling.csv have it.
std::string_view name_of(Shrinks shrinks) noexcept;

/// One quantity of one contestant on the meshes of one family along one trajectory.
struct Growth {
  std::string detector;
  std::string options;
  std::string family;  ///< see family_of
  std::string trajectory;
  workload::Query query = workload::Query::nearest;
  Shrinks shrinks = Shrinks::nothing;
  std::string_view quantity;  ///< its column in results.csv
  std::size_t min_triangles = 0;
  std::size_t max_triangles = 0;
  PowerLaw law;

  std::string contestant() const { return options.empty() ? detector : detector + ":" + options; }
};

/// Fits the growth over rows with status ok; empty where they are of fewer than two sizes.
std::vector<Growth> growth_of(const std::vector<measurement::ResultRow>& rows,
                              Shrinks shrinks = Shrinks::nothing);

std::string scaling_csv(const std::vector<Growth>& growths);

/// Two tables for each family and trajectory. The first has exponents and their intervals. The second splits
/// that of the query time: time is what is looked at, times the time of a look, so their exponents add up.
std::string growth_table(const std::vector<Growth>& growths);

}  // namespace touchmark::bench::experiments::scaling
