#include "bench/validation/run_check.h"

#include "bench/validation/json_schema.h"

namespace touchmark::bench {

void check_run(const std::string& path, const LocatedJson& run, Faults& faults) {
  static const JsonSchema schema(nlohmann::json::parse(run_schema));
  for (const SchemaFault& fault : schema.check(run.value)) {
    faults.push_back({path, run.line_of(fault.pointer), fault.pointer.empty() ? "/" : fault.pointer,
                      fault.value, fault.wrong});
  }
}

}  // namespace touchmark::bench
