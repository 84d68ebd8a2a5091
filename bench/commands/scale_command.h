#pragma once

#include "bench/program.h"

namespace touchmark::bench {

/// `touchmark scale`.
void add_scale(CLI::App& program, ProgramContext& context);

}  // namespace touchmark::bench
