/// The options that say what is asked of whom: shared by every command that replays trajectories.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/answer.h"
#include "bench/contestant_info.h"
#include "bench/length.h"
#include "core/triangle_mesh.h"

namespace CLI {
class App;
}

namespace touchmark::bench {

/// As the command line gave them, still unchecked against mesh, roster and trajectories. A command that wants
/// other defaults sets them before it calls add_selectors.
struct Selectors {
  std::vector<std::string> meshes;  ///< empty: the command's own choice
  bool normalize = false;
  std::vector<std::string> trajectories;
  std::vector<std::string> detectors;  ///< empty: the default set
  std::string query = "nearest";       ///< or "all" where the command allows it
  std::string radius = "0.5%";
  std::string reach;  ///< empty: the radius
  std::string steps;  ///< empty: the command's own choice
  std::string seed = "1";
};

/// one: of --mesh and --query. many: --mesh is repeatable and --query may be "all".
enum class Variety { one, many };

void add_selectors(CLI::App& command, Selectors& selectors, Variety variety = Variety::one);

/// The checked values. All throw std::invalid_argument naming the option and the value.
struct Selection {
  std::vector<Query> queries;  ///< one, or all three
  Length radius;
  std::optional<Length> reach;  ///< nothing: each probe's radius
  std::optional<std::size_t> steps;
  std::uint64_t seed = 1;
  std::vector<ContestantSpec>
      contestants;  ///< with --detector absent the default set, or (many) the thorough one
};

Selection check(const Selectors& selectors, const Roster& roster, Variety variety = Variety::one);

/// The mesh that --mesh names, normalised if asked to. Throws std::invalid_argument or MeshError.
TriangleMesh load_mesh(const std::string& name, bool normalize);

}  // namespace touchmark::bench
