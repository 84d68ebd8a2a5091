/// The subcommands of `touchmark paper`.
#pragma once

namespace CLI {
class App;
}

namespace touchmark::bench::cli {

struct ProgramContext;

void add_paper_choi_sung(CLI::App& paper_command, ProgramContext& context);
void add_paper_park_jang(CLI::App& paper_command, ProgramContext& context);

}  // namespace touchmark::bench::cli
