#include "bench/contestants/selectors.h"

#include <stdexcept>

#include <fmt/format.h>

#include "bench/support/numbers.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::contestants {
namespace {

constexpr std::uint64_t max_steps = 100'000'000;

std::invalid_argument bad_value(std::string_view option, std::string_view value, std::string_view expected) {
  return std::invalid_argument(fmt::format("{} \"{}\" is not {}", option, value, expected));
}

workload::Query checked_query(const std::string& text) {
  const std::optional<workload::Query> query = workload::query_named(text);
  if (!query) throw bad_value("--query", text, "one of touches, nearest, sweep");
  return *query;
}

support::Length checked_length(std::string_view option, const std::string& text) {
  const std::optional<support::Length> length = support::parse_length(text);
  if (!length) {
    throw bad_value(option, text,
                    "a length: 0 or more in mesh units, or in percent of the box diagonal, as 0.5%");
  }
  return *length;
}

std::size_t checked_steps(const std::string& text) {
  const std::optional<std::uint64_t> steps = support::parse_count(text);
  if (!steps || *steps < 1 || *steps > max_steps) {
    throw bad_value("--steps", text, fmt::format("a whole number from 1 to {}", max_steps));
  }
  return *steps;
}

std::uint64_t checked_seed(const std::string& text) {
  const std::optional<std::uint64_t> seed = support::parse_count(text);
  if (!seed) throw bad_value("--seed", text, "a whole number from 0 to 18446744073709551615");
  return *seed;
}

}  // namespace

std::optional<support::LengthUnit> checked_unit(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::optional<support::LengthUnit> unit = support::length_unit_named(text);
  if (!unit) throw bad_value("--unit", text, "one of um, mm, cm, m, in");
  return unit;
}

void check_scene(const Selectors& selectors) {
  if (selectors.scene.empty()) {
    if (!selectors.poses.empty())
      throw std::invalid_argument("--poses are of bodies, and there is no --scene");
    return;
  }
  if (!selectors.meshes.empty())
    throw std::invalid_argument(fmt::format("--scene \"{}\" does not go with --mesh", selectors.scene));
  if (selectors.normalize)
    throw std::invalid_argument("--normalize is of a mesh, and does not go with --scene");
}

CheckedSelectors check(const Selectors& selectors, const Roster& roster, Variety variety) {
  check_scene(selectors);
  CheckedSelectors selection;
  if (variety == Variety::many && selectors.query == "all") {
    selection.queries.assign(workload::all_queries.begin(), workload::all_queries.end());
  } else {
    selection.queries.push_back(checked_query(selectors.query));
  }
  selection.radius = checked_length("--radius", selectors.radius);
  if (!selectors.reach.empty()) selection.reach = checked_length("--reach", selectors.reach);
  if (!selectors.steps.empty()) selection.steps = checked_steps(selectors.steps);
  selection.motion = trajectories::parse_motion_options(selectors.motion.columns, selectors.motion.scale,
                                                        selectors.motion.rate);
  selection.unit = checked_unit(selectors.unit);
  selection.seed = checked_seed(selectors.seed);
  selection.contestants = roster.parse_all(selectors.detectors);
  if (selection.contestants.empty()) {
    selection.contestants = !selectors.scene.empty()  ? roster.forms(&Forms::scenes)
                            : variety == Variety::one ? roster.default_set()
                                                      : roster.thorough_set();
  }
  return selection;
}

}  // namespace touchmark::bench::contestants
