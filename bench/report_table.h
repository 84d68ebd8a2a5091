/// The comparison as people read it: a table a trajectory, and a line that says who won.
#pragma once

#include <string>
#include <vector>

#include "bench/result_row.h"

namespace touchmark::bench {

/// `rows` are those of one trajectory.
std::string timing_table(const std::vector<ResultRow>& rows);
std::string verdict(const std::vector<ResultRow>& rows);

}  // namespace touchmark::bench
