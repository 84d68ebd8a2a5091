/// The folder that --out names: results.csv and run.json, each replaced as a whole whenever it is written.
#pragma once

#include <filesystem>
#include <string>

namespace touchmark::bench::results {

class ResultsFolder {
 public:
  /// Creates it. Throws std::invalid_argument when it cannot be a folder, ResourceError when it cannot be
  /// written to: before the measuring, not after.
  explicit ResultsFolder(const std::string& path);

  /// All throw ResourceError.
  void write(const std::string& results_csv) const;
  void write(const std::string& results_csv, const std::string& run_json) const;
  /// Any file, by its path inside the folder; folders on the way are created.
  void write_file(const std::filesystem::path& name, const std::string& text) const;
  /// Removes a file of an earlier run, where there is one.
  void remove(const std::filesystem::path& name) const;

 private:
  std::filesystem::path path_;
};

}  // namespace touchmark::bench::results
