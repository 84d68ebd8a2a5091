/// What one contestant did with one deformation of one mesh: a row of update.csv and of the printed table.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/oracle/judge.h"
#include "bench/workers/worker_protocol.h"
#include "core/detector.h"

namespace touchmark::bench::experiments::update {

/// Empty is what was not measured, because the contestant did not come so far.
struct UpdateRow {
  std::string detector;
  std::string options;  ///< as written out: "key=value,..."
  std::string mesh;
  std::size_t triangles = 0;
  std::size_t vertices = 0;
  double share = 0;  ///< how many of the vertices were to move
  std::size_t moved_vertices = 0;
  std::string status = "ok";  ///< else unsupported, refused: ..., crashed:..., timeout

  std::optional<Accuracy> accuracy;  ///< as claimed
  std::optional<workers::Updated> updated;
  std::optional<oracle::ErrorCounts> counts;  ///< errors of the answers after the update
  std::optional<double> ns_updated;           ///< a query along the trajectory, after the update
  std::optional<double> ns_built;             ///< a query's time with a detector built of the moved mesh
  std::optional<bool> answers_as_built;       ///< have both the same checksum?

  std::string contestant() const { return options.empty() ? detector : detector + ":" + options; }
  bool violates_guarantee() const {
    return accuracy && counts && !oracle::meets_guarantee(*counts, *accuracy);
  }
};

inline constexpr int update_schema = 1;

std::string update_csv(const std::vector<UpdateRow>& rows);

/// A line a contestant: its update's time over its build's, for each share, and what a query costs then.
std::string update_table(const std::vector<UpdateRow>& rows);

}  // namespace touchmark::bench::experiments::update
