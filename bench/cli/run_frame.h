/// What commands that run long have in common: --out, the description of the run, progress, and Ctrl-C.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>

#include "bench/results/results_folder.h"
#include "bench/results/run_json.h"
#include "bench/support/progress.h"

namespace touchmark::bench::cli {

struct ProgramContext;

/// A command checks its options, then makes its frame, and only then loads meshes and measures: a folder that
/// cannot be written to is known at once. `tune` and `paper` need the mesh to check their lengths.
struct RunFrame {
  /// Creates the folder, unless `out` is empty, and switches denormal numbers on. Throws as ResultsFolder.
  RunFrame(const ProgramContext& context, const std::string& out);

  /// Does the work, which Ctrl-C ends between two requests, and clears the line of progress. Returns
  /// description.finished: false after Ctrl-C.
  bool finishes(const std::function<void()>& work);

  std::optional<results::ResultsFolder> folder;
  results::RunDescription description;
  support::ProgressLine progress;
};

/// Says on stderr that Ctrl-C ended the run, and what is kept; returns the exit status.
int interrupted(const std::string& kept);
int interrupted(std::size_t finished_rows);

}  // namespace touchmark::bench::cli
