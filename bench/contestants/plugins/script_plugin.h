/// A contestant that is a script, asked over the pipe of script_plugin.cpp. docs/plugins.md says what it
/// holds.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "bench/contestants/contestant_info.h"
#include "bench/contestants/plugins/interpreters.h"
#include "bench/workload/answer.h"

namespace touchmark::bench::contestants {

/// Starts the interpreter and has it load the script. Throws std::invalid_argument that says what keeps it
/// from being a contestant. One a process.
ContestantInfo load_script_plugin(const Interpreter& interpreter, const std::string& path);

/// A question whose answer another script is to show, and the mesh that it is asked of.
struct ReproducedQuestion {
  workload::Query query = workload::Query::nearest;
  std::array<double, 8> values{};      ///< centre and radius, centre and reach, or from, to and radius
  std::vector<double> coordinates;     ///< three a vertex
  std::vector<std::uint32_t> corners;  ///< three a triangle
};

/// Returns what `reproduce` of the loaded script does: a script in the engine's own API. Empty where it has
/// no such function, and where no script is loaded. Throws std::invalid_argument with what the script raises.
std::string reproduction(const ReproducedQuestion& asked);

}  // namespace touchmark::bench::contestants
