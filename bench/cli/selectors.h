/// The options that say what is asked of whom: shared by every command that replays trajectories.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/contestants/contestant_info.h"
#include "bench/support/length_unit.h"
#include "bench/workload/selection.h"
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

/// The checked values, and who is asked.
struct CheckedSelectors : Selection {
  std::vector<ContestantSpec>
      contestants;  ///< without --detector the default set, or (many) the thorough one
};

/// Throws std::invalid_argument naming the option and the value.
CheckedSelectors check(const Selectors& selectors, const Roster& roster, Variety variety = Variety::one);

}  // namespace touchmark::bench
