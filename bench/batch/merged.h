/// The rows of many jobs as one table.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "bench/batch/job_file.h"
#include "bench/batch/manifest.h"

namespace touchmark::bench::batch {

struct FoundJob {
  std::string path;
  JobResult result;
  bool timed = false;  ///< false: only verified
};

/// Throws std::invalid_argument as read_job does.
FoundJob found_job(const std::string& path);

/// Empties the columns that depend on the machine's speed.
void drop_times(FoundJob& job);

/// Fills in the row's column `source`.
void note_source(FoundJob& job);
/// Throws std::invalid_argument, naming both, when jobs that were timed on different machines or by different
/// builds are among them.
void expect_one_machine(const std::vector<FoundJob>& jobs);

/// Without repetitions, in the manifest's order if there is one, else by mesh, trajectory, query, radius,
/// reach, detector and options. Throws std::invalid_argument when a job of the manifest is missing, or was
/// timed twice.
std::vector<FoundJob> in_order(std::vector<FoundJob> jobs, const std::optional<Manifest>& manifest);

}  // namespace touchmark::bench::batch
