/// The subcommands of `touchmark mesh` that have files of their own.
#pragma once

namespace CLI {
class App;
}

namespace touchmark::bench {

void add_mesh_measure(CLI::App& mesh_command);
void add_mesh_subdivide(CLI::App& mesh_command);

}  // namespace touchmark::bench
