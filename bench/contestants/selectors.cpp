#include "bench/contestants/selectors.h"

#include <stdexcept>

#include <fmt/format.h>

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

std::optional<LengthUnit> checked_unit(const std::string& text) {
  if (text.empty()) return std::nullopt;
  const std::optional<LengthUnit> unit = length_unit_named(text);
  if (!unit) throw bad_value("--unit", text, "one of um, mm, cm, m, in");
  return unit;
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
