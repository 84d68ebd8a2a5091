/// Scripts that show wrong answers of plug-ins to those who maintain them: `verify --reproduce DIR`.
#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>

#include "bench/contestants/roster.h"
#include "bench/measurement/result_row.h"
#include "bench/workers/contestant_process.h"
#include "bench/workload/workload.h"

namespace touchmark::bench::cli {

/// One file a plug-in, mesh, query and kind of fault. The mesh is cut to triangles that still show the fault,
/// as long as it pays. A file is what the plug-in's `reproduce` makes of them, or imports the plug-in.
class Reproducers {
 public:
  /// Creates the folder. The roster must outlive it. Throws std::invalid_argument.
  Reproducers(const std::string& folder, const contestants::Roster& roster, workers::WorkerOptions workers);

  /// Takes the rows' first wrong answers about a mesh. Rows of what is no script are passed over. Says on
  /// stderr what was written.
  void add(const workload::Workload& workload, std::span<const measurement::ResultRow> rows);

 private:
  void write(const workload::Workload& workload, const measurement::ResultRow& row,
             const ground_truth::WrongAnswer& wrong);

  std::filesystem::path folder_;
  const contestants::Roster& roster_;
  workers::WorkerOptions workers_;
  std::set<std::filesystem::path> written_;
};

}  // namespace touchmark::bench::cli
