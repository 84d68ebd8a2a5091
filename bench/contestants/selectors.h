/// What is asked of whom, as texts and as checked values: the same for every command that replays
/// trajectories.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "bench/contestants/roster.h"
#include "bench/support/length_unit.h"
#include "bench/workload/selection.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::contestants {

/// How motion files are read, as the command line says it; empty: as motion_options.h says.
struct MotionSelectors {
  std::string columns, scale, rate, drape;
};

/// Nothing for an empty text. Throws std::invalid_argument.
std::optional<support::LengthUnit> checked_unit(const std::string& text);

/// As the command line gave them, still unchecked against mesh, roster and trajectories. A command that wants
/// other defaults sets them before it calls add_selectors.
struct Selectors {
  std::vector<std::string> meshes;  ///< empty: the command's own choice
  bool normalize = false;
  std::string scene;                  ///< names bodies, in place of a mesh; empty: none
  std::string poses;                  ///< how they move; empty: as the scene says
  std::vector<std::string> packages;  ///< NAME=DIR, of a robot's file
  std::vector<std::string> trajectories;
  std::vector<std::string> detectors;  ///< empty: the default set
  std::string query = "nearest";       ///< a query; "all" where the command allows it
  std::string radius = "0.5%";
  std::string reach;  ///< empty: the radius
  std::string steps;  ///< empty: the command's own choice
  MotionSelectors motion;
  std::string unit;  ///< empty: unknown
  std::string seed = "1";
};

/// one: of --mesh and --query. many: --mesh is repeatable and --query may be "all".
enum class Variety { one, many };

/// Throws std::invalid_argument for --scene beside --mesh, and for --poses without --scene.
void check_scene(const Selectors& selectors);

/// The checked values, and who is asked.
struct CheckedSelectors : workload::Selection {
  std::vector<ContestantSpec>
      contestants;  ///< without --detector the default set, or (many) the thorough one
};

/// Throws std::invalid_argument naming the option and the value.
CheckedSelectors check(const Selectors& selectors, const Roster& roster, Variety variety = Variety::one);
/// Likewise, of one mesh and query; without --detector these forms are asked.
CheckedSelectors check(const Selectors& selectors, const Roster& roster,
                       std::vector<std::string> Forms::*otherwise);

}  // namespace touchmark::bench::contestants
