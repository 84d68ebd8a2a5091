/// What came of contact levels of detail: the table, and sentences for the report.
#include <algorithm>

#include <fmt/format.h>

#include "bench/experiments/papers/choi_sung/contact_levels.h"

namespace touchmark::bench::experiments::papers {
namespace {

/// From this part of the queries in time on a rate counts as held.
constexpr double held_part = 0.99;

/// The least error of the rows of this form that hold the rate.
const ContactLevelRow* best_at(const ContactLevelResult& result, const char* form, double hz) {
  const ContactLevelRow* best = nullptr;
  for (const ContactLevelRow& row : result.rows)
    if (row.form == form && row.rate_hz >= hz && (best == nullptr || row.mean_error < best->mean_error))
      best = &row;
  return best;
}

/// Wanted rates at which the session was set beside the best level that alone holds them.
struct Comparison {
  std::size_t rates = 0;                ///< those that some level alone holds
  std::size_t held = 0;                 ///< those at which the session was in time
  std::size_t nearer = 0, farther = 0;  ///< than that level, of those held
};

Comparison compared(const ContactLevelResult& result) {
  constexpr double alike = 0.02;  // of the error
  Comparison comparison;
  for (const ContactLevelRow& row : result.rows) {
    if (row.form != "switched") continue;
    const ContactLevelRow* fixed = best_at(result, "alone", row.wanted_hz);
    if (fixed == nullptr) continue;
    ++comparison.rates;
    if (row.in_time < held_part) continue;
    ++comparison.held;
    comparison.nearer += row.mean_error < (1 - alike) * fixed->mean_error ? 1 : 0;
    comparison.farther += row.mean_error > (1 + alike) * fixed->mean_error ? 1 : 0;
  }
  return comparison;
}

}  // namespace

support::Table contact_levels_table(const ContactLevelResult& result, double diagonal) {
  support::Table table({"form", "level", "wanted_hz", "rate_hz", "in_time_percent", "mean_error",
                        "mean_error_percent", "max_error", "switches", "finest_percent"});
  const auto number = [](double value) { return fmt::format("{:.6g}", value); };
  for (const ContactLevelRow& row : result.rows) {
    const bool switched = row.form == "switched";
    const auto of_switched = [&](double value) { return switched ? number(value) : ""; };
    table.add({row.form, row.level, of_switched(row.wanted_hz), number(row.rate_hz),
               of_switched(100 * row.in_time), number(row.mean_error),
               number(diagonal > 0 ? 100 * row.mean_error / diagonal : 0), number(row.max_error),
               of_switched(static_cast<double>(row.switches)), of_switched(100 * row.finest)});
  }
  return table;
}

std::string contact_levels_verdict(const ContactLevelResult& result, double diagonal) {
  if (!result.finished || !(diagonal > 0)) return "";
  const ContactLevelRow *kilohertz = nullptr, *slowest = nullptr, *tree = nullptr;
  for (const ContactLevelRow& row : result.rows) {
    if (row.form == "alone") slowest = &row;
    if (row.form == "tree") tree = &row;
    if (row.wanted_hz == 1000) kilohertz = &row;
  }
  if (kilohertz == nullptr || slowest == nullptr || tree == nullptr) return "";
  const Comparison comparison = compared(result);
  std::string text = fmt::format(
      "It works: of {} wanted rates that some level alone holds, the session is in time for 99 of 100 "
      "queries at {}. It gains little: nearer to the truth than the best such level it is at {}, farther off "
      "at {}. A level costs nearly the same in contact and out of it, so a trajectory gives little to switch "
      "for, and the room that keeps the session from switching to and fro is lost. Where the time that a "
      "query is given is known, `touchmark tune` finds the level beforehand; where it changes, switching "
      "follows it.\n\n",
      comparison.rates, comparison.held, comparison.nearer, comparison.farther);
  text += fmt::format(
      "At 1 kHz there is nothing to switch: the finest level, which alone holds {:.0f} kHz, answers {:.0f} % "
      "of the queries, all after the first few. ",
      slowest->rate_hz * 1e-3, 100 * kilohertz->finest);
  text += fmt::format(
      "The exact tree over the finest triangles holds {:.0f} kHz with their error of {:.2g} % of the "
      "diagonal and is {} than the spheres alone: with an exact form no level needs to be given up for "
      "time.\n",
      tree->rate_hz * 1e-3, 100 * tree->mean_error / diagonal,
      tree->rate_hz >= result.rows.front().rate_hz ? "faster" : "slower");
  return text;
}

}  // namespace touchmark::bench::experiments::papers
