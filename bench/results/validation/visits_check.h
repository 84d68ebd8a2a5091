/// Checks that a document is a visited.json, and that it is of the results.csv beside it. Its schema is
/// bench/results/schemas/visited.schema.json, built into the program.
#pragma once

#include <string>

#include "bench/results/validation/fault.h"
#include "bench/results/validation/located_json.h"
#include "bench/results/validation/results_check.h"

namespace touchmark::bench::results::validation {

/// Is bench/results/schemas/visited.schema.json, as it was when the program was built.
extern const char* const visits_schema;

/// `results` is the results.csv beside the file, if there is one. Returns what the file holds: "15 rows".
std::string check_visits(const std::string& path, const LocatedJson& visits, const CsvTable* results,
                         Faults& faults);

}  // namespace touchmark::bench::results::validation
