/// The suite as people read it: what the ratios come to, and where we lose.
#pragma once

#include <string>
#include <vector>

#include "bench/experiments/suite/suite_score.h"

namespace touchmark::bench::experiments::suite {

/// Returns a table with a line for each of ours, state of the caches, kind of time and kind of rival, of the
/// cells that count; and a sentence about the stress.
std::string summary_table(const std::vector<SuiteRow>& rows);

/// Returns a line for each cell in which some rival is surely ahead of the best of ours, by mean or tail, the
/// worst first; says so where there is none. `most` limits the lines, and the last says how many were left
/// out.
std::string list_of_losses(const std::vector<SuiteRow>& rows, std::size_t most);

/// Returns a table of the best of ours where it and the fastest exact rival take too little to be compared,
/// at most so many lines; empty where there is none.
std::string list_of_uncounted(const std::vector<SuiteRow>& rows, std::size_t most);

}  // namespace touchmark::bench::experiments::suite
