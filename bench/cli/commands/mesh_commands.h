/// The subcommands of `touchmark mesh` that have files of their own, and what all of them share.
#pragma once

#include <string>

#include <nlohmann/json_fwd.hpp>

namespace CLI {
class App;
}

namespace touchmark::bench::cli {

/// --mesh, also without its name, and --normalize.
void add_mesh_options(CLI::App& command, std::string& mesh, bool& normalize);

/// "name: value", one line each; none for null.
std::string lines_of(const nlohmann::ordered_json& members);

void add_mesh_measure(CLI::App& mesh_command);
void add_mesh_subdivide(CLI::App& mesh_command);

}  // namespace touchmark::bench::cli
