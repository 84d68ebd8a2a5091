/// What verify found, contestant by contestant, over any number of meshes, trajectories and queries.
#pragma once

#include <string>
#include <vector>

#include "bench/result_row.h"

namespace touchmark::bench {

/// Claims exactness and was wrong, crashed or did not come back.
bool claim_is_broken(const ResultRow& row);

/// One line a contestant, in the order of first appearance.
std::string verification_table(const std::vector<ResultRow>& rows);

/// One line a row that went wrong in any way, at most `most` of them, then how many more there are.
std::string list_of_failures(const std::vector<ResultRow>& rows, std::size_t most);

}  // namespace touchmark::bench
