#include "bench/cli/extra/extra_commands.h"

#include <vector>

#include "bench/cli/extra/bench_suite.h"

namespace touchmark::bench::cli {

const ProgramParts& all_parts() {
  static const std::vector<Command> commands = [] {
    std::vector<Command> all{{"servo", add_servo}, {"choose", add_choose},     {"stress", add_stress},
                             {"scale", add_scale}, {"update", add_update},     {"proxy", add_proxy},
                             {"many", add_many},   {"paper", add_paper},       {"tune", add_tune},
                             {"gate", add_gate},   {"plan", add_plan},         {"run", add_run},
                             {"merge", add_merge}, {"validate", add_validate}, {"audit", add_audit}};
    all.insert(all.end(), main_commands().begin(), main_commands().end());
    return all;
  }();
  static const ProgramParts parts{commands, run_suite};
  return parts;
}

}  // namespace touchmark::bench::cli
