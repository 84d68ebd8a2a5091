#include "bench/contestants/selectors.h"

#include <stdexcept>

#include <fmt/format.h>

#include "bench/support/checked.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::contestants {
namespace {

constexpr std::uint64_t max_steps = 100'000'000;

workload::Query checked_query(const std::string& text) {
  const std::optional<workload::Query> query = workload::query_named(text);
  if (!query) throw support::bad_value("--query", text, "one of touches, nearest, sweep, moving");
  return *query;
}

}  // namespace

std::optional<support::LengthUnit> checked_unit(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::optional<support::LengthUnit> unit = support::length_unit_named(text);
  if (!unit) throw support::bad_value("--unit", text, "one of um, mm, cm, m, in");
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
  if (selection.queries.front() == workload::Query::moving && selectors.scene.empty())
    throw std::invalid_argument("--query moving is of bodies, and there is no --scene");
  selection.radius = support::checked_length("--radius", selectors.radius, support::Infinity::allowed);
  if (!selectors.reach.empty())
    selection.reach = support::checked_length("--reach", selectors.reach, support::Infinity::allowed);
  if (!selectors.steps.empty())
    selection.steps = support::checked_count("--steps", selectors.steps, 1, max_steps);
  selection.motion = trajectories::parse_motion_options(selectors.motion.columns, selectors.motion.scale,
                                                        selectors.motion.rate, selectors.motion.drape);
  selection.unit = checked_unit(selectors.unit);
  selection.seed = support::checked_seed(selectors.seed);
  selection.contestants = roster.parse_all(selectors.detectors);
  if (selection.contestants.empty())
    selection.contestants = !selectors.scene.empty()  ? roster.forms(&Forms::scenes)
                            : variety == Variety::one ? roster.default_set()
                                                      : roster.thorough_set();
  return selection;
}

CheckedSelectors check(const Selectors& selectors, const Roster& roster,
                       std::vector<std::string> Forms::*otherwise) {
  CheckedSelectors selection = check(selectors, roster);
  if (selectors.detectors.empty()) selection.contestants = roster.forms(otherwise);
  return selection;
}

}  // namespace touchmark::bench::contestants
