/// The options of the command line that fill the selectors.
#pragma once

#include <string>

#include "bench/contestants/selectors.h"

namespace CLI {
class App;
}

namespace touchmark::bench::cli {

struct ProgramContext;

/// Plug-ins that are named come into the context's roster.
void add_selectors(CLI::App& command, ProgramContext& context, contestants::Selectors& selectors,
                   contestants::Variety variety = contestants::Variety::one);

/// Adds --scene and --poses, for commands that take scenes of bodies.
void add_scene_selectors(CLI::App& command, contestants::Selectors& selectors);

/// Adds the options that say how motion files are read.
void add_motion_selectors(CLI::App& command, contestants::MotionSelectors& motion);

/// Adds --unit, for commands whose reports speak of lengths or speeds.
void add_unit(CLI::App& command, std::string& unit);

}  // namespace touchmark::bench::cli
