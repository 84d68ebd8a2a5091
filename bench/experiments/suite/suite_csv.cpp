#include "bench/experiments/suite/suite_csv.h"

#include <array>

#include <fmt/format.h>

#include "bench/workload/query_name.h"

namespace touchmark::bench::experiments::suite {
namespace {

using A = const SuiteLine&;
namespace kinds = results::kinds;
using enum results::Presence;

template <class Number>
std::string written(const std::optional<Number>& value) {
  return value ? fmt::format("{:.6g}", static_cast<double>(*value)) : "";
}
std::string count(const std::optional<std::uint64_t>& value) { return value ? std::to_string(*value) : ""; }

using OfRow = Standing SuiteRow::*;
using OfStanding = std::optional<Rival> Standing::*;

template <OfRow standing>
std::string ours_ns(A line) {
  return written((line.row.*standing).ns);
}
template <OfRow standing, OfStanding rival>
std::string name(A line) {
  const std::optional<Rival>& found = line.row.*standing.*rival;
  return found ? found->contestant : "";
}
template <OfRow standing, OfStanding rival, double Rival::*number>
std::string number_of(A line) {
  const std::optional<Rival>& found = line.row.*standing.*rival;
  return found ? written(std::optional((*found).*number)) : "";
}
std::string rival_build(A line) { return line.row.mean.exact ? written(line.row.mean.exact->build_ms) : ""; }
std::string rival_bytes(A line) { return line.row.mean.exact ? count(line.row.mean.exact->bytes) : ""; }

constexpr OfRow mean = &SuiteRow::mean, tail = &SuiteRow::tail;
constexpr OfStanding exact = &Standing::exact, any = &Standing::any;
constexpr auto ns = &Rival::ns, ratio = &Rival::ratio;

constexpr results::Kind caches{[](std::string_view text) { return text == "warm" || text == "cold"; },
                               "one of warm, cold"};
constexpr results::Kind status{
    [](std::string_view text) { return text == "ok" || text == "not measured" || text == "no answer"; },
    "one of ok, not measured, no answer"};

// The order is the contract.
constexpr auto columns = std::to_array<results::Column<SuiteLine>>({
    {"schema", [](A) { return std::to_string(suite_schema); }, always, kinds::one, "version of this format"},
    {"run_id", nullptr, always, kinds::any_text, "as in `run.json`"},
    {"mesh", [](A line) { return line.row.mesh; }, always, kinds::any_text, "the scene, without folders"},
    {"triangles", [](A line) { return std::to_string(line.row.triangles); }, always, kinds::whole_number,
     "its number of triangles; 0 where it was not loaded"},
    {"trajectory", [](A line) { return line.row.cell.trajectory; }, always, kinds::any_text,
     "the motion and its speed, as `--trajectory` takes it"},
    {"query", [](A line) { return std::string(workload::name_of(line.row.cell.query)); }, always,
     kinds::query, "what was asked"},
    {"radius", [](A line) { return line.row.cell.radius(); }, always, kinds::any_text,
     "the probe's, in percent of the diagonal"},
    {"reach", [](A line) { return line.row.cell.reach; }, always, kinds::any_text,
     "how far was looked, in percent of the diagonal, or inf"},
    {"caches", [](A line) { return std::string(line.row.cell.cold ? "cold" : "warm"); }, always, caches,
     "cold: all caches were emptied before each query"},
    {"ours", [](A line) { return line.row.ours; }, always, kinds::any_text,
     "one of our contestants, or `best`: in each cell the fastest of them"},
    {"status", [](A line) { return line.row.status; }, always, status,
     "`not measured`: the run ended before, or its time was used up; `no answer`: none of ours has a time"},
    {"form", [](A line) { return line.row.form; }, optional, kinds::any_text,
     "the contestant whose times these are"},
    {"steps", [](A line) { return std::to_string(line.row.steps); }, always, kinds::whole_number,
     "that ours was timed on"},
    {"ns", ours_ns<mean>, optional, kinds::positive,
     "time of a query of ours: warm `ns_undisturbed` of results.csv, cold `cold_ns_p50`"},
    {"exact_rival", name<mean, exact>, optional, kinds::any_text,
     "the rival that claims exactness, was right, and took least"},
    {"exact_rival_ns", number_of<mean, exact, ns>, optional, kinds::positive, "its time"},
    {"exact_ratio", number_of<mean, exact, ratio>, optional, kinds::positive,
     "its time over ours: below 1 we lose"},
    {"any_rival", name<mean, any>, optional, kinds::any_text,
     "the rival that took least, those in single precision and approximate ones included"},
    {"any_rival_ns", number_of<mean, any, ns>, optional, kinds::positive, "its time"},
    {"any_ratio", number_of<mean, any, ratio>, optional, kinds::positive, "its time over ours"},
    {"tail_ns", ours_ns<tail>, optional, kinds::positive,
     "the slowest queries of ours: warm `ns_p999`, cold `cold_ns_p99`; empty with too few samples"},
    {"exact_tail_rival", name<tail, exact>, optional, kinds::any_text,
     "the exact rival whose slowest queries took least"},
    {"exact_tail_rival_ns", number_of<tail, exact, ns>, optional, kinds::positive, "their time"},
    {"exact_tail_ratio", number_of<tail, exact, ratio>, optional, kinds::positive, "this over ours"},
    {"any_tail_rival", name<tail, any>, optional, kinds::any_text, "the same of all rivals"},
    {"any_tail_rival_ns", number_of<tail, any, ns>, optional, kinds::positive, "their time"},
    {"any_tail_ratio", number_of<tail, any, ratio>, optional, kinds::positive, "this over ours"},
    {"build_ms", [](A line) { return written(line.row.build_ms); }, optional, kinds::finite,
     "time to build ours"},
    {"exact_rival_build_ms", rival_build, optional, kinds::finite, "time to build `exact_rival`"},
    {"bytes", [](A line) { return count(line.row.bytes); }, optional, kinds::whole_number,
     "size of ours by its own count"},
    {"exact_rival_bytes", rival_bytes, optional, kinds::whole_number, "size of `exact_rival`, likewise"},
    {"conclusive", [](A line) { return std::string(line.row.conclusive ? "1" : "0"); }, always, kinds::bit,
     "0: the same contestant timed in two processes differed by more than 15 %, so that near ratios mean "
     "nothing"},
    {"seed", [](A line) { return std::to_string(line.seed); }, always, kinds::whole_number,
     "of the plan and of the trajectories"},
});

}  // namespace

std::span<const results::Column<SuiteLine>> suite_columns() { return columns; }

std::string suite_csv(const std::string& run_id, std::uint64_t seed, const std::vector<SuiteRow>& rows) {
  support::Table table(results::names_of(columns));
  for (const SuiteRow& row : rows) table.add(results::fields_of(columns, SuiteLine{seed, row}, run_id));
  return table.csv();
}

}  // namespace touchmark::bench::experiments::suite
