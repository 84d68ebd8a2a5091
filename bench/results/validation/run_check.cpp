#include "bench/results/validation/run_check.h"

#include "bench/results/validation/json_schema.h"

namespace touchmark::bench::results::validation {

void check_run(const std::string& path, const LocatedJson& run, Faults& faults) {
  static const JsonSchema schema(nlohmann::json::parse(run_schema));
  schema.check(path, run, faults);
}

}  // namespace touchmark::bench::results::validation
