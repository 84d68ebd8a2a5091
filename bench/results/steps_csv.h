/// Every step of a run as CSV, for one's own tools: --steps-out of `touchmark bench`.
#pragma once

#include <functional>
#include <string_view>
#include <vector>

#include "bench/measurement/result_row.h"

namespace touchmark::bench::results {

/// The header's line.
inline constexpr std::string_view steps_csv_header =
    "detector,options,mesh,trajectory,query,step,ns,found,triangle,distance,work\n";

/// Hands on header and rows, some at a time: a row a step of each of `rows` that has a log. `triangle` and
/// `distance` are empty where nothing was found or the query tells none.
void write_steps_csv(const std::vector<measurement::ResultRow>& rows,
                     const std::function<void(std::string_view)>& write);

}  // namespace touchmark::bench::results
