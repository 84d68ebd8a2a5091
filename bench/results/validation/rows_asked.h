/// Checks that the rows of a results.csv are those that its run.json says were asked for, each once, and that
/// those that claim exactness agree with each other.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "bench/results/validation/results_check.h"

namespace touchmark::bench::results::validation {

/// No row twice, by what it is about where `run` is known, else as a whole; and, where `run` names what was
/// asked for and is finished, none missing. `run` may be null.
void check_rows_asked(const CsvTable& table, const nlohmann::json* run, Faults& faults);

/// Whoever claims exactness, on the same steps of the same trajectory, decides alike.
void check_exact_peers(const CsvTable& table, Faults& faults);

}  // namespace touchmark::bench::results::validation
