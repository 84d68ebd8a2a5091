/// The subcommands of `touchmark mesh` that have files of their own, and what all of them share.
#pragma once

#include <string>

namespace CLI {
class App;
}

namespace touchmark::bench::cli {

/// --mesh, also without its name, and --normalize.
void add_mesh_options(CLI::App& command, std::string& mesh, bool& normalize);

void add_mesh_measure(CLI::App& mesh_command);
void add_mesh_subdivide(CLI::App& mesh_command);

}  // namespace touchmark::bench::cli
