/// The path of a haptic interface point: one position a servo tick, at 1 kHz unless times say otherwise.
#pragma once

#include <string>
#include <vector>

#include "core/probe.h"

namespace touchmark::bench {

struct Trajectory {
  std::string name;
  std::vector<Vec3> positions;  ///< mesh units
  std::vector<double> radii;    ///< one a position, or empty: the command line's radius throughout
  std::vector<double> times_s;  ///< one a position, or empty: step / 1000

  std::size_t size() const noexcept { return positions.size(); }
};

}  // namespace touchmark::bench
