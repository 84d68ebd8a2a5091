/// The path of a haptic interface point: one position a servo tick, at 1 kHz unless times say otherwise.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "core/probe.h"

namespace touchmark::bench::trajectories {

/// What a recorded motion's own times say.
struct RecordedTiming {
  std::size_t rows = 0;
  double duration_s = 0;               ///< from the first row to the last
  std::optional<double> resampled_hz;  ///< the steps' rate, where they are not the rows

  /// Rows a second on average; nothing where all is one moment.
  std::optional<double> rate_hz() const noexcept {
    if (!(duration_s > 0)) return std::nullopt;
    return static_cast<double>(rows - 1) / duration_s;
  }
};

struct Trajectory {
  std::string name;
  std::vector<Vec3> positions;       ///< mesh units
  std::vector<double> radii = {};    ///< one a position, or empty: the command line's radius throughout
  std::vector<double> times_s = {};  ///< one a position, or empty: step / 1000
  std::optional<RecordedTiming> recorded = std::nullopt;  ///< for a file with times

  std::size_t size() const noexcept { return positions.size(); }
};

}  // namespace touchmark::bench::trajectories
