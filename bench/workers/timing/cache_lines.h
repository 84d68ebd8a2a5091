/// How many cache lines a query touches, of data and of code: counted by valgrind, which simulates caches
/// that are large enough to lose nothing and empty before each query. Each line is then missed once.
#pragma once

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

#include "bench/contestants/contestant.h"
#include "bench/workload/steps.h"

namespace touchmark::bench::workers {

/// Means of a query.
struct CacheLines {
  double data = 0, code = 0;
};

/// Throws ResourceError where lines cannot be counted: without valgrind, or built without its headers.
void require_line_counting();

/// A folder of its own for what valgrind leaves, gone with the object.
class CountsFolder {
 public:
  /// Throws ResourceError where none can be made.
  CountsFolder();
  CountsFolder(const CountsFolder&) = delete;
  CountsFolder& operator=(const CountsFolder&) = delete;
  ~CountsFolder();
  std::filesystem::path counts() const { return folder_ / "lines"; }

 private:
  std::filesystem::path folder_;
};

/// Returns the program, with its options, that a worker runs under to be counted; it leaves its counts in
/// files that begin with `counts`
std::vector<std::string> counting_program(const std::filesystem::path& counts);

/// In a worker that runs so: replays samples of the ranges' steps, spread evenly, each counted alone and
/// after the steps before it, uncounted. What is prepared after the query is counted with it, as are the
/// replay's own lines, some five of each kind.
void count_lines(contestants::Contestant& contestant, const workload::QueryTrace& trace,
                 const std::vector<workload::StepRange>& ranges, std::size_t samples);

/// Reads what came of so many samples. Throws ResourceError for a file that is not there or says something
/// else.
CacheLines counted_lines(const std::filesystem::path& counts, std::size_t samples);

}  // namespace touchmark::bench::workers
