/// Checks that a file is an audit.csv of schema 1, and agrees with itself.
#pragma once

#include "bench/results/validation/fault.h"
#include "bench/results/validation/results_check.h"

namespace touchmark::bench::experiments::audit {

void check_audit(const results::validation::CsvTable& table, results::validation::Faults& faults);

}  // namespace touchmark::bench::experiments::audit
