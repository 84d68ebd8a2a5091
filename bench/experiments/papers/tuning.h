/// Which of many measured configurations to take.
#pragma once

#include <optional>
#include <string>

#include "bench/experiments/papers/frontier.h"

namespace touchmark::bench::experiments::papers {

struct Tuned {
  std::optional<FrontierPoint> published;  ///< the best of the scans and the fast level
  std::optional<FrontierPoint> fast;       ///< the best of the tree and the grid
};

/// Returns true if 99 of 100 queries end within a period of `rate` Hz.
bool holds_rate(const FrontierPoint& point, double rate);

/// Chooses the point of least mean error that holds the rate; of several the fastest.
Tuned tune(const FrontierResult& result, double rate);

/// As --detector takes it.
std::string detector_of(const FrontierPoint& point);

}  // namespace touchmark::bench::experiments::papers
