/// `--plugin FILE`, for every command that takes --detector.
#pragma once

#include <string>
#include <vector>

namespace CLI {
class App;
}

namespace touchmark::bench::cli {

struct ProgramContext;

/// To be added after --detector, whose values `detectors` has: a plug-in that none of them names is added in
/// its default form. What is in `detectors` where no --detector is given is a default, and goes. Null for a
/// command that has no --detector.
void add_plugins(CLI::App& command, ProgramContext& context, std::vector<std::string>* detectors);

/// Returns the files that the command was given.
std::vector<std::string> plugins_given(const CLI::App& command);

/// Adds the contestants of these files to the roster. Returns their names. Throws std::invalid_argument.
std::vector<std::string> load_plugins(ProgramContext& context, const std::vector<std::string>& files);

}  // namespace touchmark::bench::cli
