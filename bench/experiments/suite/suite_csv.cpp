#include "bench/experiments/suite/suite_csv.h"

#include <array>

#include "bench/workload/query_name.h"

namespace touchmark::bench::experiments::suite {
namespace {

using A = const SuiteLine&;
namespace kinds = results::kinds;
using enum results::Presence;

using Row = SuiteRow;
using results::rounded, results::text;

const Row& row(A line) { return line.row; }
constexpr auto mean = &Row::mean, tail = &Row::tail;
constexpr auto exact = &Standing::exact, any = &Standing::any;
constexpr auto ns = &Rival::ns, ratio = &Rival::ratio;
constexpr auto is_counted = &Rival::counts;
constexpr double ratio_low(const Rival& rival) { return rival.ratio_bounds.low; }
constexpr double ratio_high(const Rival& rival) { return rival.ratio_bounds.high; }

constexpr results::Kind caches{
    [](std::string_view text) { return support::value_in<Caches>(cache_names, text).has_value(); },
    "one of warm, l2, cold"};
constexpr results::Kind section{[](std::string_view text) { return text == "hand" || text == "stress"; },
                                "one of hand, stress"};
constexpr results::Kind status{
    [](std::string_view text) { return text == "ok" || text == "not measured" || text == "no answer"; },
    "one of ok, not measured, no answer"};

// The order is the contract.
constexpr auto columns = std::to_array<results::Column<SuiteLine>>({
    {"schema", [](A) { return std::to_string(suite_schema); }, always, kinds::one, "version of this format"},
    {"run_id", nullptr, always, kinds::any_text, "as in `run.json`"},
    {"mesh", text<row, &Row::mesh>, always, kinds::any_text, "the scene, without folders"},
    {"triangles", text<row, &Row::triangles>, always, kinds::whole_number,
     "its number of triangles; 0 where it was not loaded"},
    {"trajectory", text<row, &Row::cell, &SuiteCell::trajectory>, always, kinds::any_text,
     "the motion and its speed, as `--trajectory` takes it"},
    {"query", text<row, &Row::cell, &SuiteCell::query>, always, kinds::query, "what was asked"},
    {"radius", text<row, &Row::cell, &SuiteCell::radius>, always, kinds::any_text,
     "the probe's, in percent of the diagonal"},
    {"reach", text<row, &Row::cell, &SuiteCell::reach>, always, kinds::any_text,
     "how far was looked, in percent of the diagonal, or inf"},
    {"caches", text<row, &Row::caches>, always, caches,
     "l2, cold: the second-level cache, all caches were emptied before each query"},
    {"ours", text<row, &Row::ours>, always, kinds::any_text,
     "one of our contestants, or `best`: in each cell the fastest of them"},
    {"status", text<row, &Row::status>, always, status,
     "`not measured`: the run ended before, or its time was used up; `no answer`: none of ours has a time"},
    {"form", text<row, &Row::form>, optional, kinds::any_text, "the contestant whose times these are"},
    {"steps", text<row, &Row::steps>, always, kinds::whole_number, "that ours was timed on"},
    {"ns", rounded<6, row, mean, &Standing::ns>, optional, kinds::positive,
     "time of a query of ours: warm `ns_undisturbed` of results.csv, l2 `cold_l2_ns_p50`, cold "
     "`cold_ns_p50`"},
    {"exact_rival", text<row, mean, exact, &Rival::contestant>, optional, kinds::any_text,
     "the rival that claims exactness, was right, and took least"},
    {"exact_rival_ns", rounded<6, row, mean, exact, ns>, optional, kinds::positive, "its time"},
    {"exact_ratio", rounded<6, row, mean, exact, ratio>, optional, kinds::positive,
     "its time over ours, both less `floor_ns`: below 1 we lose"},
    {"any_rival", text<row, mean, any, &Rival::contestant>, optional, kinds::any_text,
     "the rival that took least, those in single precision and approximate ones included"},
    {"any_rival_ns", rounded<6, row, mean, any, ns>, optional, kinds::positive, "its time"},
    {"any_ratio", rounded<6, row, mean, any, ratio>, optional, kinds::positive, "its time over ours"},
    {"tail_ns", rounded<6, row, tail, &Standing::ns>, optional, kinds::positive,
     "the slowest queries of ours: warm `ns_p999`, else 99 %; empty with too few samples"},
    {"exact_tail_rival", text<row, tail, exact, &Rival::contestant>, optional, kinds::any_text,
     "the exact rival whose slowest queries took least"},
    {"exact_tail_rival_ns", rounded<6, row, tail, exact, ns>, optional, kinds::positive, "their time"},
    {"exact_tail_ratio", rounded<6, row, tail, exact, ratio>, optional, kinds::positive, "this over ours"},
    {"any_tail_rival", text<row, tail, any, &Rival::contestant>, optional, kinds::any_text,
     "the same of all rivals"},
    {"any_tail_rival_ns", rounded<6, row, tail, any, ns>, optional, kinds::positive, "their time"},
    {"any_tail_ratio", rounded<6, row, tail, any, ratio>, optional, kinds::positive, "this over ours"},
    {"build_ms", rounded<6, row, &Row::build_ms>, optional, kinds::finite, "time to build ours"},
    {"exact_rival_build_ms", rounded<6, row, mean, exact, &Rival::build_ms>, optional, kinds::finite,
     "time to build `exact_rival`"},
    {"bytes", text<row, &Row::bytes>, optional, kinds::whole_number, "size of ours by its own count"},
    {"exact_rival_bytes", text<row, mean, exact, &Rival::bytes>, optional, kinds::whole_number,
     "size of `exact_rival`, likewise"},
    {"conclusive", text<row, &Row::conclusive>, always, kinds::bit,
     "0: the same contestant timed in two processes differed by more than 15 %, so that near ratios mean "
     "nothing"},
    {"seed", text<&SuiteLine::seed>, always, kinds::whole_number, "of the plan and of the trajectories"},
    {"section", [](A line) { return std::string(line.row.cell.stress ? "stress" : "hand"); }, always, section,
     "stress: the motion is faster than hands, and the cell is in no score"},
    {"floor_ns", rounded<6, row, &Row::floor_ns>, always, kinds::finite,
     "with caches emptied, the time with nothing asked: median of the cell's contestants; warm 0"},
    {"exact_ratio_low", rounded<6, row, mean, exact, ratio_low>, optional, kinds::positive,
     "`exact_ratio` lies between this, with about 95 % confidence,"},
    {"exact_ratio_high", rounded<6, row, mean, exact, ratio_high>, optional, kinds::positive, "and this"},
    {"any_ratio_low", rounded<6, row, mean, any, ratio_low>, optional, kinds::positive,
     "`any_ratio`, likewise"},
    {"any_ratio_high", rounded<6, row, mean, any, ratio_high>, optional, kinds::positive, ""},
    {"exact_tail_ratio_low", rounded<6, row, tail, exact, ratio_low>, optional, kinds::positive,
     "`exact_tail_ratio`, likewise"},
    {"exact_tail_ratio_high", rounded<6, row, tail, exact, ratio_high>, optional, kinds::positive, ""},
    {"any_tail_ratio_low", rounded<6, row, tail, any, ratio_low>, optional, kinds::positive,
     "`any_tail_ratio`, likewise"},
    {"any_tail_ratio_high", rounded<6, row, tail, any, ratio_high>, optional, kinds::positive, ""},
    {"exact_counts", text<row, mean, exact, is_counted>, optional, kinds::bit,
     "1: `exact_ratio` is in the score; 0: stress, both means below 20 ns, or a time within 300 ns of the "
     "floor"},
    {"any_counts", text<row, mean, any, is_counted>, optional, kinds::bit, "`any_ratio`, likewise"},
    {"exact_tail_counts", text<row, tail, exact, is_counted>, optional, kinds::bit,
     "`exact_tail_ratio`, likewise; 0 also where the times differ by less than 100 ns"},
    {"any_tail_counts", text<row, tail, any, is_counted>, optional, kinds::bit, "`any_tail_ratio`, likewise"},
});

}  // namespace

std::span<const results::Column<SuiteLine>> suite_columns() { return columns; }

std::string suite_csv(const std::string& run_id, std::uint64_t seed, const std::vector<SuiteRow>& rows) {
  support::Table table(results::names_of(columns));
  for (const SuiteRow& row : rows) table.add(results::fields_of(columns, SuiteLine{seed, row}, run_id));
  return table.csv();
}

}  // namespace touchmark::bench::experiments::suite
