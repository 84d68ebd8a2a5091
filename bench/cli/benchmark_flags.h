/// Google Benchmark's flags on our command line: a few mean something to the program, the rest goes to the
/// library in the workers.
#pragma once

#include <cstddef>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace touchmark::bench::cli {

struct BenchmarkFlags {
  std::optional<std::size_t> repetitions;
  std::optional<double> min_time_s;                ///< a repetition lasts at least so long
  std::function<bool(const std::string&)> wanted;  ///< --benchmark_filter on "contestant/trajectory"
  bool list_tests = false;
  std::string out;               ///< file for Google Benchmark's JSON; empty: none
  bool aggregates_only = false;  ///< without an entry a repetition there
  std::vector<std::string> forwarded;
};

/// `arguments` are those the program's own options left over. Throws std::invalid_argument for anything that
/// is no --benchmark_ flag, that the library does not know, or whose value is wrong.
BenchmarkFlags parse_benchmark_flags(const std::vector<std::string>& arguments);

}  // namespace touchmark::bench::cli
