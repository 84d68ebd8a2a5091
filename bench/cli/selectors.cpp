#include "bench/cli/selectors.h"

#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/scenes/scenes.h"
#include "bench/support/numbers.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench {
namespace {

constexpr std::uint64_t most_steps = 100'000'000;

std::invalid_argument bad_value(std::string_view option, std::string_view value, std::string_view expected) {
  return std::invalid_argument(fmt::format("{} \"{}\" is not {}", option, value, expected));
}

Query checked_query(const std::string& text) {
  const std::optional<Query> query = query_named(text);
  if (!query) throw bad_value("--query", text, "one of touches, nearest, sweep");
  return *query;
}

Length checked_length(std::string_view option, const std::string& text) {
  const std::optional<Length> length = parse_length(text);
  if (!length) {
    throw bad_value(option, text,
                    "a length: 0 or more in mesh units, or in percent of the box diagonal, as 0.5%");
  }
  return *length;
}

std::size_t checked_steps(const std::string& text) {
  const std::optional<std::uint64_t> steps = parse_count(text);
  if (!steps || *steps < 1 || *steps > most_steps) {
    throw bad_value("--steps", text, fmt::format("a whole number from 1 to {}", most_steps));
  }
  return *steps;
}

std::uint64_t checked_seed(const std::string& text) {
  const std::optional<std::uint64_t> seed = parse_count(text);
  if (!seed) throw bad_value("--seed", text, "a whole number from 0 to 18446744073709551615");
  return *seed;
}

}  // namespace

void add_motion_selectors(CLI::App& command, MotionSelectors& motion) {
  command
      .add_option("--columns", motion.columns,
                  "of motion files, by name or number: x=COL,y=COL,z=COL[,time=COL][,radius=COL]")
      ->type_name("COLUMNS");
  command
      .add_option(
          "--motion-scale", motion.scale,
          "factor on the coordinates and radii of motion files, to mesh units: 1000 for metres on a mesh "
          "in millimetres")
      ->type_name("S");
  command
      .add_option(
          "--rate", motion.rate,
          "resample motion files by their times to this servo rate, linearly; default: a row is a step")
      ->type_name("HZ");
}

void add_unit(CLI::App& command, std::string& unit) {
  command
      .add_option("--unit", unit, "what a mesh unit is, um, mm, cm, m or in: reports then speak of metres")
      ->type_name("UNIT");
}

std::optional<LengthUnit> checked_unit(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::optional<LengthUnit> unit = length_unit_named(text);
  if (!unit) throw bad_value("--unit", text, "one of um, mm, cm, m, in");
  return unit;
}

void add_selectors(CLI::App& command, Selectors& selectors, Variety variety) {
  CLI::Option* mesh = command.add_option("--mesh", selectors.meshes,
                                         "a scene (touchmark list) or a mesh file; modifiers may follow: "
                                         "bunny@scale=1e-3@offset=1e6");
  mesh->type_name("MESH")->expected(1);
  if (variety == Variety::one) {
    mesh->multi_option_policy(CLI::MultiOptionPolicy::Throw);
  } else {
    mesh->take_all();
  }
  command.add_flag("--normalize", selectors.normalize, "scale to box diagonal 1 about the origin");
  command
      .add_option("--trajectory", selectors.trajectories,
                  "a name (touchmark list) or a motion file, CSV with columns x,y,z; repeatable")
      ->type_name("T")
      ->expected(1)
      ->take_all();
  command
      .add_option("--detector", selectors.detectors,
                  "a contestant (touchmark list) as NAME[:key=value,...]; repeatable")
      ->type_name("D")
      ->expected(1)
      ->take_all();
  command
      .add_option("--query", selectors.query,
                  variety == Variety::one ? "touches, nearest or sweep" : "touches, nearest, sweep or all")
      ->type_name("QUERY")
      ->capture_default_str();
  command.add_option("--radius", selectors.radius, "the probe's, in mesh units or % of the box diagonal")
      ->type_name("LENGTH")
      ->capture_default_str();
  command
      .add_option("--reach", selectors.reach, "how far nearest looks; inf is allowed; default: the radius")
      ->type_name("LENGTH");
  add_motion_selectors(command, selectors.motion);
  command.add_option("--steps", selectors.steps, "steps a trajectory")->type_name("N");
  command.add_option("--seed", selectors.seed, "of trajectories and of the order of measuring")
      ->type_name("N")
      ->capture_default_str();
}

CheckedSelectors check(const Selectors& selectors, const Roster& roster, Variety variety) {
  CheckedSelectors selection;
  if (variety == Variety::many && selectors.query == "all") {
    selection.queries.assign(all_queries.begin(), all_queries.end());
  } else {
    selection.queries.push_back(checked_query(selectors.query));
  }
  selection.radius = checked_length("--radius", selectors.radius);
  if (!selectors.reach.empty()) selection.reach = checked_length("--reach", selectors.reach);
  if (!selectors.steps.empty()) selection.steps = checked_steps(selectors.steps);
  selection.motion =
      parse_motion_options(selectors.motion.columns, selectors.motion.scale, selectors.motion.rate);
  selection.unit = checked_unit(selectors.unit);
  selection.seed = checked_seed(selectors.seed);
  for (const std::string& text : selectors.detectors) selection.contestants.push_back(roster.parse(text));
  if (selection.contestants.empty()) {
    selection.contestants = variety == Variety::one ? roster.default_set() : roster.thorough_set();
  }
  return selection;
}

}  // namespace touchmark::bench
