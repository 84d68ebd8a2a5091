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
#include "bench/length_unit.h"
#include "bench/motion/motion_options.h"
#include "core/triangle_mesh.h"

namespace CLI {
class App;
}

namespace touchmark::bench {

/// How motion files are read, as the command line says it; empty: as motion_options.h says.
struct MotionSelectors {
  std::string columns, scale, rate;
};

void add_motion_selectors(CLI::App& command, MotionSelectors& motion);

/// --unit, for commands whose reports speak of lengths or speeds.
void add_unit(CLI::App& command, std::string& unit);
/// Nothing for an empty text. Throws std::invalid_argument.
std::optional<LengthUnit> checked_unit(const std::string& text);

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
  MotionSelectors motion;
  std::string unit;  ///< empty: unknown
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
  MotionOptions motion;
  std::optional<LengthUnit> unit;  ///< of the mesh; nothing: unknown
  std::uint64_t seed = 1;
  std::vector<ContestantSpec>
      contestants;  ///< with --detector absent the default set, or (many) the thorough one
};

Selection check(const Selectors& selectors, const Roster& roster, Variety variety = Variety::one);

/// The mesh that --mesh names, normalised if asked to. Throws std::invalid_argument or MeshError.
TriangleMesh load_mesh(const std::string& name, bool normalize);

}  // namespace touchmark::bench
