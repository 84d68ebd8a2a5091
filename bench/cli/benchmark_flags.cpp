#include "bench/cli/benchmark_flags.h"

#include <regex>
#include <stdexcept>
#include <string_view>
#include <utility>

#include <fmt/format.h>

#include "bench/support/checked.h"
#include "bench/support/numbers.h"
#include "bench/workers/timing/throughput.h"

namespace touchmark::bench::cli {
namespace {

constexpr std::size_t max_repetitions = 10000;
constexpr double max_repetition_s = 3600;

/// "--name=value" to the pair; a flag alone has the value "true", as in the library.
std::pair<std::string, std::string> split_flag(const std::string& argument) {
  const std::size_t equals = argument.find('=');
  if (equals == std::string::npos) return {argument, "true"};
  return {argument.substr(0, equals), argument.substr(equals + 1)};
}

double parse_min_time(const std::string& name, const std::string& value) {
  // Newer releases of the library write "0.5s".
  const std::string_view number =
      std::string_view(value).substr(0, value.ends_with('s') ? value.size() - 1 : value.size());
  const auto seconds = support::parse_number(number);
  if (!seconds || !(*seconds > 0) || *seconds > max_repetition_s)
    throw support::bad_value(name, value,
                             fmt::format("a time in seconds, above 0 and at most {}", max_repetition_s));
  return *seconds;
}

/// An extended regular expression that must match somewhere; a leading '-' turns it round; "all" is ".".
std::function<bool(const std::string&)> parse_filter(const std::string& name, const std::string& value) {
  const bool negated = value.starts_with('-');
  const std::string pattern = value == "all" ? "." : value.substr(negated ? 1 : 0);
  try {
    return
        [expression = std::regex(pattern, std::regex::extended), negated](const std::string& name_of_case) {
          return std::regex_search(name_of_case, expression) != negated;
        };
  } catch (const std::regex_error&) {
    throw support::bad_value(name, value, "a regular expression");
  }
}

/// Standard output has tables for people, and CSV files columns of their own, so JSON is the one format that
/// Google Benchmark's readers are given.
bool is_of_output(BenchmarkFlags& flags, const std::string& name, const std::string& value) {
  if (name == "--benchmark_out") {
    if (value.empty() || value == "true")
      throw std::invalid_argument("--benchmark_out needs a file: --benchmark_out=FILE");
    flags.out = value;
  } else if (name == "--benchmark_out_format") {
    if (value != "json")
      throw support::bad_value("--benchmark_out_format", value, "json; --out DIR writes results.csv");
  } else if (name == "--benchmark_format") {
    if (value != "console")
      throw support::bad_value("--benchmark_format", value,
                               "console; --benchmark_out=FILE writes JSON, --out DIR results.csv");
  } else {
    return false;
  }
  return true;
}

void take(BenchmarkFlags& flags, const std::string& argument) {
  const auto [name, value] = split_flag(argument);
  if (name == "--benchmark_repetitions") {
    flags.repetitions = support::checked_count(name, value, 1, max_repetitions);
  } else if (name == "--benchmark_min_time") {
    flags.min_time_s = parse_min_time(name, value);
  } else if (name == "--benchmark_filter") {
    flags.wanted = parse_filter(name, value);
  } else if (name == "--benchmark_list_tests") {
    flags.list_tests = value != "false";
  } else if (name == "--benchmark_report_aggregates_only") {
    flags.aggregates_only = value != "false";
  } else if (is_of_output(flags, name, value)) {
    return;
  } else {
    flags.forwarded.push_back(argument);
  }
}

}  // namespace

BenchmarkFlags parse_benchmark_flags(const std::vector<std::string>& arguments) {
  BenchmarkFlags flags;
  flags.wanted = [](const std::string&) { return true; };
  for (const std::string& argument : arguments) {
    if (!argument.starts_with("--benchmark_"))
      throw std::invalid_argument(fmt::format("unknown argument \"{}\"", argument));
    take(flags, argument);
  }
  for (const std::string& unknown : workers::initialize_throughput(flags.forwarded))
    throw std::invalid_argument(fmt::format("Google Benchmark does not know \"{}\"", unknown));
  return flags;
}

}  // namespace touchmark::bench::cli
