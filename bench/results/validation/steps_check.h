/// Checks that a file is a steps.bin, and that it is of the results.csv beside it.
#pragma once

#include <string>

#include "bench/results/validation/fault.h"
#include "bench/results/validation/results_check.h"

namespace touchmark::bench::results::validation {

/// `results` is the results.csv beside the file, if there is one. Returns what the file holds: "5 traces".
/// Throws std::invalid_argument when the file cannot be read.
std::string check_steps(const std::string& path, const CsvTable* results, Faults& faults);

}  // namespace touchmark::bench::results::validation
