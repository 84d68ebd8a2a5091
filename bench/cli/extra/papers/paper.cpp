/// `touchmark paper`: the two papers' experiments again, side by side with what was printed.
#include <CLI/CLI.hpp>

#include "bench/cli/extra/extra_commands.h"
#include "bench/cli/extra/papers/paper_commands.h"

namespace touchmark::bench::cli {

void add_paper(CLI::App& program, ProgramContext& context) {
  CLI::App* command = add_command(program, "paper");
  command->require_subcommand(1);
  command->footer("Example: touchmark paper choi-sung-2017 --out results/papers/choi-sung-2017\n");
  add_paper_park_jang(*command, context);
  add_paper_choi_sung(*command, context);
}

}  // namespace touchmark::bench::cli
