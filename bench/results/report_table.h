/// The comparison as people read it: a table a trajectory, and a line that says who won.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "bench/measurement/result_row.h"
#include "bench/measurement/steadiness.h"
#include "bench/support/table.h"

namespace touchmark::bench::results {

/// The comparison over one trajectory in 120 columns: the fastest first, long names cut in the middle. Below
/// it stand the kinds of wrong answers, a line for each contestant that gave any.
std::string comparison_text(const std::vector<measurement::ResultRow>& rows);
/// All columns of the rows of one trajectory, in their order.
support::Table timing_table(const std::vector<measurement::ResultRow>& rows);
/// Over all trajectories: who is the fastest that was never wrong, and which rates its slowest query holds.
std::string overall_verdict(const std::vector<measurement::ResultRow>& rows);
/// Who is fastest, and who cannot be told from it; whose 99.9 % is least; how disturbed the run was.
std::string verdict(const std::vector<measurement::ResultRow>& rows,
                    const measurement::Steadiness& steadiness);
/// What a step looked at on average, and at most; the rest of the mesh was skipped. Of most rivals only the
/// triangles are seen that they hand to a callback.
/// A line for each contestant: its queries warm and with emptied caches, and what the clock takes then with
/// nothing asked. Empty where no row has such times.
std::string cold_table(const std::vector<measurement::ResultRow>& rows);

/// How many cache lines a query touches, a line a row; nothing where they were not counted.
std::string lines_table(const std::vector<measurement::ResultRow>& rows);

std::string work_table(const std::vector<measurement::ResultRow>& rows);

/// Says on stderr, a line each, which rows violated their guarantee or were timed with other answers than the
/// verified ones; `where` names a row beside its contestant. False when there are none.
bool print_faults(const std::vector<measurement::ResultRow>& rows,
                  const std::function<std::string(const measurement::ResultRow&)>& where);

}  // namespace touchmark::bench::results
