#include "bench/workers/timing/cache_lines.h"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <map>
#include <sstream>
#include <string_view>
#include <system_error>

#include <fmt/format.h>
#include <unistd.h>

#include "bench/support/failures.h"
#include "bench/workers/timing/cold_replay.h"
#include "bench/workload/sample_steps.h"

#if __has_include(<valgrind/callgrind.h>)
#include <valgrind/callgrind.h>
#else
#define CALLGRIND_START_INSTRUMENTATION
#define CALLGRIND_STOP_INSTRUMENTATION
#define CALLGRIND_DUMP_STATS
#define TOUCHMARK_LACKS_CALLGRIND
#endif

namespace touchmark::bench::workers {
namespace {

#ifdef TOUCHMARK_LACKS_CALLGRIND
constexpr bool has_headers = false;
#else
constexpr bool has_headers = true;
#endif

/// Returns the file of that name in the first folder of PATH that has it, or nothing.
std::string found_in_path(const std::string& program) {
  const char* const path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  for (std::string folder; std::getline(folders, folder, ':');) {
    const std::string file = folder + '/' + program;
    if (access(file.c_str(), X_OK) == 0) return file;
  }
  return "";
}

/// The words after `key` on the line that begins with it.
std::vector<std::string> words_after(std::string_view key, const std::filesystem::path& path) {
  std::ifstream file(path);
  for (std::string line; std::getline(file, line);) {
    if (!line.starts_with(key)) continue;
    std::istringstream rest(line.substr(key.size()));
    std::vector<std::string> words;
    for (std::string word; rest >> word;) words.push_back(word);
    return words;
  }
  return {};
}

}  // namespace

CountsFolder::CountsFolder() {
  std::error_code ignored;
  std::string folder = (std::filesystem::temp_directory_path(ignored) / "touchmark-XXXXXX").string();
  if (mkdtemp(folder.data()) == nullptr)
    throw support::ResourceError(fmt::format("no folder for valgrind's counts can be made: {}", folder));
  folder_ = folder;
}

CountsFolder::~CountsFolder() {
  std::error_code ignored;
  std::filesystem::remove_all(folder_, ignored);
}

void require_line_counting() {
  if (found_in_path("valgrind").empty())
    throw support::ResourceError("valgrind is missing, which counts cache lines: scripts/setup develop");
  if (!has_headers)
    throw support::ResourceError(
        "built without valgrind's headers, which count cache lines: build again, with valgrind installed");
}

std::vector<std::string> counting_program(const std::filesystem::path& counts) {
  require_line_counting();
  // 4 MB in 16 ways. Who touches more, as brute force does, comes to most lines once and misses them once.
  constexpr const char* cache = "4194304,16,64";
  return {found_in_path("valgrind"),
          "-q",
          "--tool=callgrind",
          "--instr-atstart=no",
          "--cache-sim=yes",
          fmt::format("--I1={}", cache),
          fmt::format("--D1={}", cache),
          fmt::format("--LL={}", cache),
          "--callgrind-out-file=" + counts.string()};
}

void count_lines(contestants::Contestant& contestant, const workload::QueryTrace& trace,
                 const std::vector<workload::StepRange>& ranges, std::size_t samples) {
  workload::Checksum checksum;
  const std::size_t steps = workload::steps_in(ranges);
  for (std::size_t sample = 0; sample < samples; ++sample) {
    const std::size_t step = workload::step_at(ranges, (2 * sample + 1) * steps / (2 * samples));
    contestant.replay(trace, {step - std::min(step, ColdReplay::lead_up), step}, checksum);
    CALLGRIND_START_INSTRUMENTATION;
    contestant.replay(trace, {step, step + 1}, checksum);
    CALLGRIND_STOP_INSTRUMENTATION;
  }
  CALLGRIND_DUMP_STATS;
}

CacheLines counted_lines(const std::filesystem::path& counts, std::size_t samples) {
  const std::filesystem::path path = counts.string() + ".1";  // the first dump
  const std::vector<std::string> events = words_after("events:", path), totals = words_after("totals:", path);
  std::map<std::string, double> count;
  for (std::size_t i = 0; i < std::min(events.size(), totals.size()); ++i)
    count[events[i]] = std::strtod(totals[i].c_str(), nullptr);
  if (!(count["I1mr"] > 0) || samples == 0)
    throw support::ResourceError(fmt::format("valgrind left no counts of cache lines in {}", path.string()));
  const auto of = static_cast<double>(samples);
  return {(count["D1mr"] + count["D1mw"]) / of, count["I1mr"] / of};
}

}  // namespace touchmark::bench::workers
