/// Checks that a document is a run.json. Its schema is bench/results/schemas/run.schema.json, built into the
/// program.
#pragma once

#include <string>

#include "bench/results/validation/fault.h"
#include "bench/results/validation/located_json.h"

namespace touchmark::bench::results::validation {

/// bench/results/schemas/run.schema.json, as it was when the program was built.
extern const char* const run_schema;

void check_run(const std::string& path, const LocatedJson& run, Faults& faults);

}  // namespace touchmark::bench::results::validation
