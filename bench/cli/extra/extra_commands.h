/// The commands of touchmark-extra, which `scripts/bench` never runs.
#pragma once

#include "bench/cli/program.h"

namespace touchmark::bench::cli {

void add_servo(CLI::App& program, ProgramContext& context);
void add_choose(CLI::App& program, ProgramContext& context);
void add_stress(CLI::App& program, ProgramContext& context);
void add_scale(CLI::App& program, ProgramContext& context);
void add_update(CLI::App& program, ProgramContext& context);
void add_proxy(CLI::App& program, ProgramContext& context);
void add_many(CLI::App& program, ProgramContext& context);
void add_paper(CLI::App& program, ProgramContext& context);
void add_tune(CLI::App& program, ProgramContext& context);
void add_gate(CLI::App& program, ProgramContext& context);
void add_plan(CLI::App& program, ProgramContext& context);
void add_run(CLI::App& program, ProgramContext& context);
void add_merge(CLI::App& program, ProgramContext& context);
void add_audit(CLI::App& program, ProgramContext& context);
void add_validate(CLI::App& program, ProgramContext& context);

/// Every command, those of the main program too.
const ProgramParts& all_parts();

}  // namespace touchmark::bench::cli
