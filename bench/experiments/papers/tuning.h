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

/// What a simpler mesh may be farther off than the best that holds the rate: a factor on its mean error.
inline constexpr double simpler_within = 1.1;

/// Chooses among the points that hold the rate and whose mean error is the least or nearly so
/// (simpler_within) the one of fewest triangles; of several the fastest.
Tuned tune(const FrontierResult& result, double rate);

struct LevelSearch {
  FrontierResult result;
  std::string stopped;  ///< why no finer level was tried: a clause
};

/// Explores `settings.levels` levels and, unless that is `all`, finer ones as long as some form of the finest
/// holds the rate and its error falls.
LevelSearch search_levels(const TriangleMesh& mesh, FrontierSettings settings, double rate, bool all,
                          const PrintProgress& print_progress);

/// Edges at which the faces turn by more than 60 degrees: corners of the object, or a coarse mesh of
/// something round.
struct SharpEdges {
  std::size_t count = 0;
  double share = 0;  ///< part of the length of all edges that turn by more than 1 degree: those within a flat
                     ///< face say nothing of the object's shape, however finely it is cut
};
SharpEdges sharp_edges(const TriangleMesh& mesh);
/// From this share on the mesh is taken for an object with corners, which LS3's limit would round.
inline constexpr double mostly_sharp = 0.3;

/// Why the error of a method rises from one level to the next, if it does: a sentence with a full stop, or
/// nothing.
std::string rising_error_note(const FrontierResult& result);

/// As --detector takes it.
std::string detector_of(const FrontierPoint& point);

}  // namespace touchmark::bench::experiments::papers
