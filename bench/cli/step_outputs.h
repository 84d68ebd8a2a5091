/// What `touchmark bench` leaves of single steps: steps.bin in its folder, and the file of --steps-out.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/measurement/comparison.h"
#include "bench/measurement/result_row.h"
#include "bench/results/results_folder.h"
#include "bench/support/files/atomic_file.h"
#include "bench/workload/workload.h"

namespace touchmark::bench::cli {

class StepOutputs {
 public:
  /// Opens the CSV file, unless its name is empty, and removes what an earlier run left
  /// in the folder, unless that is null: `folder` must outlive it. Throws ResourceError.
  StepOutputs(const results::ResultsFolder* folder, const std::string& csv_path);

  /// Writes both, once, of those rows that have a log.
  void write(const std::string& run_id, const workload::Workload& workload,
             const measurement::Comparison& comparison, const std::vector<measurement::ResultRow>& rows);

 private:
  const results::ResultsFolder* folder_;
  std::optional<support::AtomicFile> csv_;
};

}  // namespace touchmark::bench::cli
