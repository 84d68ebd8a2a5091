#include "bench/results/results_folder.h"

#include <stdexcept>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "bench/support/failures.h"
#include "bench/support/files/atomic_file.h"

namespace touchmark::bench::results {

ResultsFolder::ResultsFolder(const std::string& path) : path_(path) {
  std::error_code error;
  std::filesystem::create_directories(path_, error);
  if (std::filesystem::is_directory(path_)) error.clear();
  if (error == std::errc::file_exists || error == std::errc::not_a_directory || path.empty() ||
      (!error && !std::filesystem::is_directory(path_)))
    throw std::invalid_argument(fmt::format("--out \"{}\" is not a folder", path));
  if (error) throw support::ResourceError(fmt::format("cannot create {}: {}", path, error.message()));
  if (access(path_.c_str(), W_OK | X_OK) != 0)
    throw support::ResourceError(fmt::format("cannot write into {}", path));
}

void ResultsFolder::write(const std::string& results_csv) const { write_file("results.csv", results_csv); }

void ResultsFolder::write(const std::string& results_csv, const std::string& run_json) const {
  write(results_csv);
  write_file("run.json", run_json);
}

void ResultsFolder::remove(const std::filesystem::path& name) const {
  std::error_code error;
  std::filesystem::remove(path_ / name, error);
  if (error)
    throw support::ResourceError(
        fmt::format("cannot remove {}: {}", (path_ / name).string(), error.message()));
}

void ResultsFolder::write_file(const std::filesystem::path& name, const std::string& text) const {
  const std::filesystem::path path = path_ / name;
  std::error_code error;
  std::filesystem::create_directories(path.parent_path(), error);
  if (error)
    throw support::ResourceError(
        fmt::format("cannot create {}: {}", path.parent_path().string(), error.message()));
  support::AtomicFile file(path);
  file.write(text);
  file.commit();
}

}  // namespace touchmark::bench::results
