/// Checks that a file is a proxy.csv of schema 1, and agrees with itself and with its run.json.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include "bench/results/validation/fault.h"
#include "bench/results/validation/results_check.h"

namespace touchmark::bench::experiments::proxy {

/// `run` is the run.json beside the file, if there is one.
void check_proxy(const results::validation::CsvTable& table, const nlohmann::json* run,
                 results::validation::Faults& faults);

}  // namespace touchmark::bench::experiments::proxy
