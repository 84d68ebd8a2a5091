/// What `touchmark choose` prints.
#pragma once

#include <string>
#include <vector>

#include "bench/experiments/choose/candidate.h"
#include "bench/experiments/choose/choose_csv.h"

namespace touchmark::bench::experiments::choose {

/// Returns what was asked, and how long a query may take.
std::string asked_text(const Asked& asked);

/// A line a candidate: those that hold first, the best one on top, then the others as they were measured.
std::string candidate_table(const Asked& asked, const std::vector<Candidate>& candidates);

/// Returns the recommendation with its reason, the runner-up and the margin; or that none holds, and which
/// came nearest.
std::string recommendation(const Asked& asked, const std::vector<Candidate>& candidates);

}  // namespace touchmark::bench::experiments::choose
