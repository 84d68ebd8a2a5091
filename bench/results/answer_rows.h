/// Answers as CSV rows, one a step: what `touchmark query` prints.
#pragma once

#include <cstddef>
#include <string>

#include "bench/contestants/contestant.h"
#include "bench/workload/answer.h"

namespace touchmark::bench::results {

/// Returns the header with its line end. All queries have these columns; `sweep` appends the fraction of the
/// way, and a contestant that is asked for it the side.
std::string answer_header(workload::Query query, bool with_side = false);

/// Appends a step's row. `touching` is 1 where the distance is at most the probe's radius (sweep: where it
/// was hit on the way); what the query does not tell or found nothing to tell about stays empty. Doubles in
/// the shortest form that reads back to the same bits.
void append_answer_row(std::string& rows, workload::Query query, std::size_t index,
                       const workload::Step& step, const workload::Answer& answer, bool with_side = false);

}  // namespace touchmark::bench::results
