/// What the regression gate asks of every build. A case keeps its name for as long as it asks the same.
#pragma once

#include <cstddef>
#include <span>
#include <string>

#include "bench/regression/driver/plugin.h"

namespace touchmark::bench::regression::driver {

struct Case {
  const char* detector;  ///< as the plug-in knows it
  const char* mesh;      ///< as load_mesh knows it
  const char* trajectory;
  TouchmarkGateQuery query;
  std::size_t steps;
  bool timed;  ///< false: only its answers and its work are compared

  /// DETECTOR/MESH/TRAJECTORY/QUERY
  std::string name() const;
  /// Returns true if the mesh comes from a file that another machine may lack, or have another edition of.
  bool needs_file() const;
};

/// Returns all cases; those of one mesh and detector stand together.
std::span<const Case> cases();

}  // namespace touchmark::bench::regression::driver
