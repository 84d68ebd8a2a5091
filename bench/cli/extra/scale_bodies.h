/// `touchmark scale --bodies`: how ticks, placing and memory grow with the number of bodies.
#pragma once

#include <string>

#include "bench/cli/program.h"
#include "bench/contestants/selectors.h"

namespace touchmark::bench::cli {

struct ScaleBodiesOptions {
  const contestants::Selectors& selectors;
  std::string sizes, limit, out;
  bool quick = false;
};

/// An exit status. Throws std::invalid_argument, ResourceError.
int run_scale_bodies(const ProgramContext& context, const ScaleBodiesOptions& options);

}  // namespace touchmark::bench::cli
