#include "bench/experiments/scaling/body_row.h"

#include <array>
#include <cstdint>
#include <string>
#include <tuple>

#include <fmt/format.h>

#include "bench/results/validation/row_check.h"
#include "bench/support/grouping.h"
#include "bench/support/table.h"

namespace touchmark::bench::experiments::scaling {
namespace {

using Row = const BodyRow&;
using R = BodyRow;

using results::Presence, results::Kind, results::text, results::rounded;
using results::kinds::any_text, results::kinds::finite, results::kinds::one, results::kinds::positive,
    results::kinds::positive_count, results::kinds::whole_number;
constexpr Presence always = Presence::always, optional = Presence::optional;
constexpr Kind place{[](std::string_view text) { return text == "free" || text == "beside"; },
                     "one of free, beside"};

// The order is the contract.
constexpr auto columns = std::to_array<results::Column<R>>({
    {"schema", [](Row) { return std::to_string(bodies_schema); }, always, one, "1."},
    {"detector", text<&R::detector>, always, any_text, "The contestant."},
    {"options", text<&R::options>, optional, any_text, "Its options, as they were written."},
    {"bodies", text<&R::bodies>, always, positive_count, "Of the scene `field:N`."},
    {"motion", text<&R::motion>, always, any_text, "How they move."},
    {"place", text<&R::place>, always, place,
     "Where the probe is: `free`, more than a body's size from all, or `beside` one."},
    {"moved", text<&R::moved>, always, whole_number, "Bodies that are placed before each frame."},
    {"frames", text<&R::frames>, always, whole_number, "How often bodies are placed, in each of the rounds."},
    {"ticks_per_frame", text<&R::ticks_a_frame>, always, whole_number, "Queries between two frames."},
    {"build_ms", rounded<4, &R::build_ms>, always, finite, "Shapes included."},
    {"bytes", text<&R::bytes>, always, whole_number, "Of all of it, by its own count."},
    {"bytes_per_body", rounded<4, &R::bytes_per_body>, optional, finite,
     "What it takes more than with one body, over the bodies more."},
    {"publish_ns_per_body", rounded<4, &R::publish_ns_per_body>, optional, finite,
     "Placing a frame's bodies, over their number: the median of the frames. Their poses have just been "
     "read."},
    {"first_tick_ns", rounded<4, &R::first_tick_ns>, always, finite,
     "The query right after a frame: the median, without the clock's cost."},
    {"tick_ns", rounded<4, &R::tick_ns>, always, finite,
     "A query after that: the median of the frames' means, without the clock's cost."},
    {"tick_over_one", rounded<4, &R::tick_over_one>, optional, finite,
     "A tick over that with one body: the median of the ratios of a round's median to those of the rounds "
     "with one body right before and after it. With one body: of two scenes alike, so how far off it may be. "
     "Empty where the clock cannot tell a time from nothing."},
    {"found", text<&R::found>, always, whole_number, "Queries of one round with a body in reach."},
    {"differing", text<&R::differing>, always, whole_number,
     "Answers of one round that are not those of the first contestant, to 1e-9."},
    {"status", text<&R::status>, always, any_text, "`ok`, `differs`, or why it was not measured."},
    {"prepare_ns", rounded<4, &R::prepare_ns>, optional, finite,
     "What the contestant prepares after a frame, outside of the ticks (`Scene::prepare`): the median. This "
     "and the next ones are empty where it prepares nothing."},
    {"first_tick_prepared_ns", rounded<4, &R::first_tick_prepared_ns>, optional, finite,
     "`first_tick_ns` of rounds in which each frame is prepared for."},
    {"tick_prepared_ns", rounded<4, &R::tick_prepared_ns>, optional, finite, "`tick_ns` of these rounds."},
    {"tick_prepared_over_one", rounded<4, &R::tick_prepared_over_one>, optional, finite,
     "`tick_over_one` of rounds in which each frame is prepared for."},
    {"first_tick_over_one", rounded<4, &R::first_tick_over_one>, optional, finite,
     "As `tick_over_one`, of the query right after a frame."},
    {"first_tick_prepared_over_one", rounded<4, &R::first_tick_prepared_over_one>, optional, finite,
     "`first_tick_over_one` of rounds in which each frame is prepared for."},
});

struct Quantity {
  std::string_view name;
  std::optional<double> (*value)(Row row);
};
constexpr std::array quantities{
    Quantity{"tick_ns", [](Row row) { return std::optional(row.tick_ns); }},
    Quantity{"first_tick_ns", [](Row row) { return std::optional(row.first_tick_ns); }},
    Quantity{"tick_prepared_ns", [](Row row) { return row.tick_prepared_ns; }},
    Quantity{"first_tick_prepared_ns", [](Row row) { return row.first_tick_prepared_ns; }},
    Quantity{"publish_ns_per_body", [](Row row) { return row.publish_ns_per_body; }},
    Quantity{"build_ms", [](Row row) { return std::optional(row.build_ms); }},
};

using G = BodyGrowth;
constexpr auto growth_columns = std::to_array<results::Column<G>>({
    {"schema", [](const G&) { return std::to_string(bodies_schema); }},
    {"detector", text<&G::detector>},
    {"options", text<&G::options>},
    {"motion", text<&G::motion>},
    {"place", text<&G::place>},
    {"quantity", text<&G::quantity>},
    {"points", text<&G::law, &PowerLaw::points>},
    {"exponent", rounded<6, &G::law, &PowerLaw::exponent>},
    {"exponent_low", rounded<6, &G::law, &PowerLaw::interval, &ExponentInterval::low>},
    {"exponent_high", rounded<6, &G::law, &PowerLaw::interval, &ExponentInterval::high>},
    {"factor", rounded<6, &G::law, &PowerLaw::factor>},
});

auto curves_of(const std::vector<BodyRow>& rows) {
  return support::grouped_by(
      rows, [](Row row) { return std::tuple(row.motion, row.place, row.detector, row.options); });
}

namespace validation = results::validation;

/// Columns that files of the first releases do not have: those of what is prepared, and of first ticks over
/// those with one body.
constexpr std::size_t newer_columns = 6;

void check_numbers(const validation::RowCheck& row) {
  const std::uint64_t bodies = row.count("bodies"), moved = row.count("moved");
  const std::uint64_t ticks = row.count("frames") * row.count("ticks_per_frame");
  row.expect(moved <= bodies, "moved", fmt::format("is above the {} bodies", bodies));
  row.expect(row.count("found") <= ticks, "found", fmt::format("is above the {} ticks", ticks));
  row.expect(row.count("differing") <= ticks, "differing", fmt::format("is above the {} ticks", ticks));
  row.expect((row.field("status") == "differs") == (row.count("differing") > 0), "status",
             "does not go with differing");
  row.expect(moved > 0 || row.field("publish_ns_per_body").empty(), "publish_ns_per_body",
             "is there, and nothing moves");
  row.expect(bodies > 1 || row.field("bytes_per_body").empty(), "bytes_per_body",
             "is there for a single body");
  const bool prepares = !row.field("prepare_ns").empty();
  for (const std::string column : {"first_tick_prepared_ns", "tick_prepared_ns"})
    row.expect(row.field(column).empty() != prepares, column, "does not go with prepare_ns");
}

}  // namespace

std::string_view name_of(Place place) noexcept { return place == Place::free ? "free" : "beside"; }

std::span<const results::Column<BodyRow>> body_columns() { return columns; }

std::string bodies_csv(const std::vector<BodyRow>& rows) { return results::table_of(columns, rows).csv(); }

std::string bodies_growth_csv(const std::vector<BodyGrowth>& growths) {
  return results::table_of(growth_columns, growths).csv();
}

std::vector<BodyGrowth> growth_of(const std::vector<BodyRow>& rows) {
  std::vector<BodyGrowth> growths;
  for (const auto& [key, curve] : curves_of(rows)) {
    for (const Quantity& quantity : quantities) {
      std::vector<SizedQuantity> measured;
      for (const BodyRow* row : curve) {
        const std::optional<double> value = quantity.value(*row);
        if (row->status == "ok" && value && *value > 0)
          measured.push_back({static_cast<double>(row->bodies), *value});
      }
      const std::optional<PowerLaw> law = fit_power_law(measured);
      const auto& [motion, place, detector, options] = key;
      if (law) growths.push_back({detector, options, motion, place, quantity.name, *law});
    }
  }
  return growths;
}

std::string bodies_table(const std::vector<BodyRow>& rows) {
  std::string text;
  for (const auto& [key, of_key] :
       support::grouped_by(rows, [](Row row) { return std::tuple(row.motion, row.place); })) {
    support::Table table({"detector", "bodies", "tick ns", "/ one", "first tick ns", "/ one",
                          "prepared: tick ns", "/ one", "first tick ns", "/ one", "publish ns/body",
                          "bytes/body", "build ms", "status"});
    for (const BodyRow* row : of_key)
      table.add({row->contestant(), std::to_string(row->bodies), rounded<4, &R::tick_ns>(*row),
                 rounded<4, &R::tick_over_one>(*row), rounded<4, &R::first_tick_ns>(*row),
                 rounded<4, &R::first_tick_over_one>(*row), rounded<4, &R::tick_prepared_ns>(*row),
                 rounded<4, &R::tick_prepared_over_one>(*row), rounded<4, &R::first_tick_prepared_ns>(*row),
                 rounded<4, &R::first_tick_prepared_over_one>(*row),
                 rounded<4, &R::publish_ns_per_body>(*row), rounded<4, &R::bytes_per_body>(*row),
                 rounded<4, &R::build_ms>(*row), row->status});
    text += fmt::format("\nmotion={}, probe {}\n{}", std::get<0>(key),
                        std::get<1>(key) == Place::free ? "in free space" : "beside a body", table.text());
  }
  support::Table exponents({"detector", "motion", "place", "quantity", "exponent [95 %]"});
  for (const BodyGrowth& growth : growth_of(rows)) {
    const std::string name =
        growth.options.empty() ? growth.detector : growth.detector + ":" + growth.options;
    const std::string interval =
        growth.law.interval
            ? fmt::format(" [{:.2f}, {:.2f}]", growth.law.interval->low, growth.law.interval->high)
            : "";
    exponents.add({name, growth.motion, std::string(name_of(growth.place)), std::string(growth.quantity),
                   fmt::format("{:.2f}{}", growth.law.exponent, interval)});
  }
  return text + fmt::format("\nquantity = factor * bodies^exponent\n{}", exponents.text());
}

void check_bodies(const validation::CsvTable& table, validation::Faults& faults) {
  validation::check_rows(table, body_columns(), body_columns().size() - newer_columns, faults,
                         [](const validation::RowCheck& row) {
                           row.check_fields(body_columns(), false);
                           check_numbers(row);
                         });
}

}  // namespace touchmark::bench::experiments::scaling
