/// One finished job: its row of results.csv, and the run.json of the process run it was measured in.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

namespace touchmark::bench::batch {

struct JobResult {
  std::string id;
  std::string machine;              ///< machine_fingerprint()
  nlohmann::json run;               ///< as run.json
  std::vector<std::string> fields;  ///< all columns of results.csv

  std::string json() const;
};

/// OUT/ID.json.
std::filesystem::path job_path(const std::filesystem::path& folder, const std::string& id);

/// Throws std::invalid_argument for a file that is no finished job, naming line and value.
JobResult read_job(const std::string& path);

/// Returns true if there is a finished job of that id. A file that is there and is none, or another's, is
/// not.
bool is_finished(const std::filesystem::path& folder, const std::string& id);

}  // namespace touchmark::bench::batch
