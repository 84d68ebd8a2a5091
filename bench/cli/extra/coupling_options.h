/// The options that say how a device is coupled to its proxy: the same for every command that runs one.
#pragma once

#include <string>

#include "core/haptics/coupling.h"

namespace CLI {
class App;
}

namespace touchmark::bench::cli {

/// As the command line gave them.
struct CouplingSelectors {
  std::string stiffness = "1000", friction = "0", damping = "0", shading = "0";
};

void add_coupling(CLI::App& command, CouplingSelectors& selectors);

/// Returns the coupling of a bare point in ticks of a millisecond. Throws std::invalid_argument naming the
/// option and the value.
Coupling checked_coupling(const CouplingSelectors& selectors);

}  // namespace touchmark::bench::cli
