/// What verify found, contestant by contestant, over any number of meshes, trajectories and queries.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "bench/measurement/result_row.h"
#include "bench/support/table.h"

namespace touchmark::bench::results {

/// Claims exactness and was wrong, crashed or did not come back.
bool claim_is_broken(const measurement::ResultRow& row);

/// "as claimed", "BROKEN", or "nothing judged" of a contestant that had none of its answers judged.
std::string_view verdict_on(bool broken, std::uint64_t judged) noexcept;

/// Returns true if it was refused since there is too little memory.
bool is_short_of_memory(const measurement::ResultRow& row);

/// Sums up rows of one contestant.
struct Summary {
  std::string contestant;
  std::string guarantee;  ///< as claimed; empty where it is not known
  oracle::ErrorCounts counts;
  std::uint64_t unsupported = 0;
  std::uint64_t refusals = 0;
  std::uint64_t crashes = 0;
  std::uint64_t timeouts = 0;
  std::string short_of_memory;  ///< the first status that says so
  bool broken = false;          ///< a claim of exactness, as who sums up sees it

  void add(const measurement::ResultRow& row);
};

/// "N answers judged exactly".
std::string judged_answers(const std::vector<measurement::ResultRow>& rows);

/// What a run of these rows exits with: exit_check_failed where `faulty`, exit_resources where a contestant
/// had nothing judged for want of memory, exit_inconclusive where nobody had anything judged. Says the latter
/// two on stderr.
int status_of(const std::vector<measurement::ResultRow>& rows, bool faulty);
/// Contestants may have several of these.
int status_of(const std::vector<Summary>& summaries, bool faulty);

/// One line a contestant, in the order of first appearance.
support::Table verification_table(const std::vector<measurement::ResultRow>& rows);

/// One line a row that went wrong in any way, at most `most` of them, then how many more there are. After the
/// first line of a contestant its first wrong answers, with the commands that repeat them.
std::string list_of_failures(const std::vector<measurement::ResultRow>& rows, std::size_t most);

}  // namespace touchmark::bench::results
