/// What was timed, in the JSON of Google Benchmark's own reporter, for the tools that read that.
#pragma once

#include <string>
#include <vector>

#include "bench/measurement/result_row.h"
#include "bench/results/run_json.h"

namespace touchmark::bench::results {

/// Which entries are written: each repetition and what sums them up, or the latter alone.
enum class Repetitions { each, summed_up };

/// An entry a repetition, named DETECTOR/MESH/TRAJECTORY/QUERY, in nanoseconds a query; of two or more also
/// mean, median, stddev and cv, and always the undisturbed time. Rows without times are in `failed`, since
/// readers would take a time of 0 for a fast one.
std::string google_benchmark_json(const RunDescription& run, const std::vector<measurement::ResultRow>& rows,
                                  Repetitions repetitions);

}  // namespace touchmark::bench::results
