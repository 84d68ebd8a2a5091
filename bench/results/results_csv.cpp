#include "bench/results/results_csv.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "bench/support/numbers.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::results {
namespace {

using B = measurement::BracketSummary;
using R = measurement::ResultRow;
using C = measurement::ColdSummary;
using D = measurement::DeadlineMisses;
using N = workers::CacheLines;
using E = oracle::ErrorCounts;
using L = measurement::LatencySummary;
using T = measurement::ThroughputResult;
using U = measurement::UndisturbedTime;
using W = measurement::WorkResult;
using Row = const R&;

template <auto Checksum>
std::string hex(Row row) {
  return row.*Checksum ? support::hex(*(row.*Checksum)) : "";
}

template <auto Latency>
std::string p999_in(Row row) {
  return rounded<6>(measurement::p999_of(row, row.*Latency));
}

template <std::size_t Deadline, auto Count>
std::string deadline(Row row) {
  return row.latency ? text<Count>(row.latency->deadlines[Deadline]) : "";
}

template <auto Member>
std::string work_of(Row row) {
  if (!row.work) return "";
  return fmt::format("{:.6g}", static_cast<double>(row.work->total.*Member) / static_cast<double>(row.steps));
}

std::string guarantee_of(Row row) { return std::string(measurement::guarantee_name(row)); }
std::string update_rate(Row row) {
  return row.throughput ? fmt::format("{:.6g}", 1e9 / row.throughput->ns_per_query) : "";
}
std::string clock_cost(Row row) { return row.latency ? fmt::format("{:.6g}", row.clock_cost_ns) : ""; }

template <auto Part, auto Percentile, std::size_t Needed>
std::string cold_tail(Row row) {
  return row.*Part && (row.*Part)->samples >= Needed ? rounded<6, Part, Percentile>(row) : "";
}
constexpr auto p99_of_l2 = cold_tail<&R::cold_l2, &C::p99, measurement::samples_for_p99>;
constexpr auto p999_of_l2 = cold_tail<&R::cold_l2, &C::p999, measurement::steps_for_p999>;
constexpr auto p99_of_all = cold_tail<&R::cold, &C::p99, measurement::samples_for_p99>;

constexpr Kind angle{[](std::string_view text) {
                       constexpr double rounding = 1e-9;  // of the conversion from radians
                       return kinds::is_number(text, [](double x) { return x <= 180 + rounding; });
                     },
                     "an angle from 0 to 180"};

bool is_options(std::string_view text) {
  while (!text.empty()) {
    const std::string_view option = text.substr(0, text.find(','));
    const std::size_t equals = option.find('=');
    if (equals == 0 || equals == std::string_view::npos || equals + 1 == option.size()) return false;
    if (option.size() == text.size()) return true;
    text.remove_prefix(option.size() + 1);
  }
  return false;  // after a comma comes nothing
}
constexpr Kind option_list{&is_options, "key=value,key=value"};

bool is_status(std::string_view text) {
  constexpr std::array words{"ok", "unsupported", "timeout", "checksum mismatch"};
  constexpr std::array beginnings{"refused: ", "crashed:", "skipped: "};
  const auto begins = [&](std::string_view begin) { return text.starts_with(begin) && text != begin; };
  return std::ranges::find(words, text) != words.end() || std::ranges::any_of(beginnings, begins);
}
constexpr Kind row_status{
    &is_status, "ok, unsupported, timeout, checksum mismatch, refused: WHY, skipped: WHY or crashed:HOW"};

using enum Presence;
using namespace kinds;

// The order is the contract.
constexpr auto columns = std::to_array<Column<R>>({
    {"schema", [](Row) { return std::to_string(results_schema); }, always, one, "version of these columns"},
    {"run_id", nullptr, always, any_text, "ties the row to its [run.json](run-json.md)"},
    {"detector", text<&R::detector>, always, any_text, "the contestant's name, as `--detector` takes it"},
    {"options", text<&R::options>, optional, option_list,
     "the options that were written out, `key=value` joined by commas; the rest were at their defaults. "
     "Older recordings of `auto` also say what it chose"},
    {"mesh", text<&R::mesh>, always, any_text, "the scene's name or file, as `--mesh` took it"},
    {"triangles", text<&R::triangles>, always, whole_number, "number of triangles of the mesh"},
    {"trajectory", text<&R::trajectory>, always, any_text,
     "the motion's name or file, as `--trajectory` took it"},
    {"query", text<&R::query>, always, query,
     "`touches`: is the distance at most the radius; `nearest`: the contact within the reach; `sweep`: the "
     "first touch along the straight line of a tick; `moving`: the same among bodies that move meanwhile"},
    {"steps", text<&R::steps>, always, whole_number,
     "servo ticks replayed, timed and verified, each one query; a slow contestant gets fewer, so that all "
     "get about the same time: blocks of 32 drawn by phase (in contact, within 2 % of the diagonal of it, "
     "free), each phase in its share, at least two blocks of each, the same for the same seed"},
    {"radius", text<&R::radius>, always, length, "the probe's radius"},
    {"reach", text<&R::reach>, always, length, "how far `nearest` looks"},
    {"guarantee", guarantee_of, judged, guarantee,
     "what the contestant claims: `exact`, `conservative` (never misses a contact, may report one too many) "
     "or `approximate`"},
    {"missed", text<&R::counts, &E::missed>, judged, whole_number,
     "steps in contact by the oracle, and not by the contestant"},
    {"false_contacts", text<&R::counts, &E::false_contacts>, judged, whole_number,
     "steps in contact by the contestant, and not by the oracle"},
    {"wrong_triangle", text<&R::counts, &E::wrong_triangle>, judged, whole_number,
     "steps whose triangle is not one of the nearest, or, of a contestant that claims to name it, not the "
     "first of the exactly nearest"},
    {"max_distance_error", text<&R::counts, &E::max_distance_error>, judged, length,
     "largest difference between reported and true distance"},
    {"max_distance_error_ulp", text<&R::counts, &E::max_distance_error_ulp>, judged, length,
     "the same in units of the true distance's last place"},
    {"max_normal_angle_deg", text<&R::counts, &E::max_normal_angle_deg>, judged, angle,
     "largest angle between reported and true normal"},
    {"unresolved", text<&R::counts, &E::unresolved>, judged, whole_number,
     "steps where the truth is within the contestant's declared accuracy of the threshold: neither right nor "
     "wrong; 0 for ours, which decide `touches` and `nearest` exactly"},
    {"status", text<&R::status>, always, row_status,
     "`ok`; `unsupported`: it does not answer this query; `refused: ...`: it would not build, and why; "
     "`crashed:SIGSEGV` and the like; `timeout`; `skipped: ...`: `touchmark scale` left it out, because it "
     "took too long, or failed, on a smaller mesh; `checksum mismatch`: timed answers differ from the "
     "verified ones"},
    {"ns_per_query", rounded<6, &R::throughput, &T::ns_per_query>, timed, positive,
     "time of a query, elapsed, over these steps; the median of the repetitions. Over a scene the placing of "
     "what moved before it is in it, as it is not in `ns_p50` to `ns_max`. Other work on the machine moves "
     "it: compare `ns_undisturbed`"},
    {"ns_p50", rounded<6, &R::latency, &L::p50>, timed, finite,
     "half of the steps took at most this, each clocked alone, the clock's own cost included; of several "
     "passes each step counts with its median, so that one interruption by the system is not the detector's"},
    {"ns_p90", rounded<6, &R::latency, &L::p90>, timed, finite, "90 % of the steps took at most this"},
    {"ns_p99", rounded<6, &R::latency, &L::p99>, timed, finite, "99 % of the steps took at most this"},
    {"ns_p999", p999_in<&R::latency>, optional, finite,
     "99.9 % of the steps took at most this; empty below 1,000 steps"},
    {"ns_max", rounded<6, &R::latency, &L::max>, timed, finite, "time of the slowest step"},
    {"update_rate_hz", update_rate, timed, positive, "queries a second: 1e9 / `ns_per_query`"},
    {"deadline_misses_1khz", deadline<0, &D::misses>, timed, whole_number, "steps that took more than 1 ms"},
    {"longest_miss_run_1khz", deadline<0, &D::max_run>, timed, whole_number, "longest run of such steps"},
    {"build_ms", rounded<6, &R::build_ms>, built, finite,
     "time from the mesh in memory to a detector that can answer"},
    {"first_answer_ms", rounded<6, &R::first_answer_ms>, built, finite,
     "time of building and answering the first query"},
    {"bytes", text<&R::bytes>, judged, whole_number,
     "size of the structure by its own count, its copy of the mesh included"},
    {"heap_bytes", text<&R::heap_bytes>, built, whole_number,
     "by how much the process's heap grew during the build"},
    {"work_mean", rounded<6, &R::work, &W::mean>, optional, finite,
     "cells, spheres, boxes and triangles looked at in a step, on average: the same on every machine, and "
     "with `build=lazy` those of the first queries; of rivals only what passes through our code is counted, "
     "which is triangles and no boxes of theirs"},
    {"work_max", text<&R::work, &W::max>, optional, whole_number, "the most of these in one step"},
    {"repetitions", text<&R::throughput, &T::repetitions>, timed, positive_count,
     "how often the steps were replayed for `ns_per_query`"},
    // Appended to schema 1.
    {"ns_per_query_min", rounded<6, &R::throughput, &T::ns_per_query_min>, timed, positive,
     "the fastest repetition"},
    {"ns_per_query_mad", rounded<6, &R::throughput, &T::ns_per_query_mad>, timed, finite,
     "the median distance of repetitions from their median: small beside `ns_per_query` on a quiet machine"},
    {"ns_per_query_first_pass", rounded<6, &R::throughput, &T::ns_per_query_first_pass>, timed, positive,
     "time of a query with a fresh session, when other contestants have used the caches meanwhile; a "
     "detector with `build=lazy` is built anew just before, so that what its first queries make is in it"},
    {"deadline_misses_4khz", deadline<1, &D::misses>, timed, whole_number,
     "steps that took more than 0.25 ms"},
    {"longest_miss_run_4khz", deadline<1, &D::max_run>, timed, whole_number, "longest run of such steps"},
    {"deadline_misses_10khz", deadline<2, &D::misses>, timed, whole_number,
     "steps that took more than 0.1 ms"},
    {"longest_miss_run_10khz", deadline<2, &D::max_run>, timed, whole_number, "longest run of such steps"},
    {"clock_cost_ns", clock_cost, timed, finite, "cost of reading the clock: a part of every clocked step"},
    {"max_distance_error_of_diagonal", text<&R::counts, &E::max_distance_error_of_diagonal>, judged, length,
     "`max_distance_error` over the diagonal of the mesh's box"},
    {"beyond_bound", text<&R::counts, &E::beyond_bound>, judged, whole_number,
     "steps whose distance is off by more than the contestant declares, or, where it declares nothing, than "
     "1e-6 of the diagonal; triangle, point and normal are held to the same"},
    {"wrong_point", text<&R::counts, &E::wrong_point>, judged, whole_number,
     "steps whose point is off by more than the same"},
    {"wrong_normal", text<&R::counts, &E::wrong_normal>, judged, whole_number,
     "steps whose normal is off by more than the same"},
    {"malformed", text<&R::counts, &E::malformed>, judged, whole_number,
     "answers with NaN, infinity or a negative distance in them"},
    {"cpu_ns_per_query", rounded<6, &R::throughput, &T::cpu_ns_per_query>, timed, finite,
     "processor time of a query, without what other processes took of the core; all of the time where the "
     "contestant waits, for a thread, process or device of its own"},
    {"answers_checksum", hex<&R::checksum>, judged, checksum,
     "checksum of all answers, in hexadecimal: contestants with the same one answered the same bits"},
    {"cells_mean", work_of<&Work::cells>, optional, finite,
     "cells looked at in a step, on average; what a query skipped is not counted"},
    {"spheres_mean", work_of<&Work::spheres>, optional, finite, "spheres looked at in a step, likewise"},
    {"boxes_mean", work_of<&Work::boxes>, optional, finite, "boxes looked at in a step, likewise"},
    {"triangles_mean", work_of<&Work::triangles>, optional, finite,
     "triangles looked at in a step, likewise"},
    {"exact_decisions", text<&R::work, &W::total, &Work::exact_decisions>, optional, whole_number,
     "how often, over all steps, doubles of one word and of two left the answer open and whole numbers "
     "decided"},
    {"decides_exactly", text<&R::accuracy, &Accuracy::decides_exactly>, judged, bit,
     "1: contact is decided for the true distance of the stored doubles, closed, without any tolerance"},
    {"stored_missed", text<&R::rounded_mesh_counts, &E::missed>, optional, whole_number,
     "contacts missed by the scene as the contestant stores it, in single precision: what is left of them is "
     "not due to storing. Empty where it decides by the given doubles"},
    {"stored_false_contacts", text<&R::rounded_mesh_counts, &E::false_contacts>, optional, whole_number,
     "contacts made up, likewise"},
    {"stored_max_distance_error_of_diagonal",
     text<&R::rounded_mesh_counts, &E::max_distance_error_of_diagonal>, optional, length,
     "the largest error of a distance, likewise"},
    {"wrong_side", text<&R::counts, &E::wrong_side>, judged, whole_number,
     "`nearest` with the option `side=on`, closed meshes: steps said to be inside, outside or on the surface "
     "that are not; `undecided` is never wrong"},
    {"prepare_ns_p50", rounded<6, &R::prepare, &L::p50>, optional, finite,
     "with the option `prepare=true`: what was done after an answer for the next one is clocked apart, and "
     "half of these parts took at most this. It is in `ns_per_query` and the work, and not in `ns_p50` to "
     "`ns_max`"},
    {"prepare_ns_p999", p999_in<&R::prepare>, optional, finite,
     "99.9 % of these parts took at most this; empty below 1,000 steps"},
    {"prepare_ns_max", rounded<6, &R::prepare, &L::max>, optional, finite,
     "time of the slowest of these parts"},
    {"ns_undisturbed", rounded<6, &R::throughput, &T::undisturbed, &U::ns>, timed, positive,
     "time of a query where nothing interrupts it, the mean over the whole trajectory: what the table, the "
     "verdict and the plots rank by. The steps are timed in pieces of about 0.5 ms, again and again, a "
     "sample being the shorter of elapsed and processor time; each piece counts with the 15 % quantile of "
     "its samples, and where `steps` are a sample, each phase with its share of the trajectory"},
    {"ns_undisturbed_low", rounded<6, &R::throughput, &T::undisturbed, &U::low>, timed, positive,
     "lower end of the 95 % interval of `ns_undisturbed`, by bootstrap over the repetitions, and over the "
     "blocks where `steps` are a sample. What differs from process to process comes on top: see the control "
     "in `run.json`"},
    {"ns_undisturbed_high", rounded<6, &R::throughput, &T::undisturbed, &U::high>, timed, positive,
     "upper end of this interval"},
    {"disturbed_share", rounded<6, &R::throughput, &T::disturbed_share>, timed, share,
     "the share of the samples of `ns_undisturbed` that took over 1.2 times their processor time"},
    {"decisions_checksum", hex<&R::decisions_checksum>, optional, checksum,
     "checksum of contact or none, and for `nearest` of the triangle: all who claim exactness have the same "
     "one for the same steps. Empty for others, and for those that name any of several triangles equally "
     "near"},
    {"judged", text<&R::counts, &E::judged>, judged, whole_number, "answers that the oracle judged"},
    {"beyond_tolerance", text<&R::counts, &E::beyond_tolerance>, judged, whole_number,
     "steps whose distance is off by more than 1e-6 of the diagonal of the mesh's box, whatever is declared: "
     "0.2 micrometres on an object of 20 cm, where haptic devices resolve 1 to 55"},
    {"rounding", text<&R::counts, &E::rounding>, judged, whole_number,
     "steps whose distance is off by less than that, and by more than arithmetic in double must be: 48 "
     "roundings of the largest coordinate difference"},
    {"cold_l2_ns_p50", rounded<6, &R::cold_l2, &C::p50>, optional, positive,
     "with `--cold`: half of the queries took at most this after as much as twice the second-level cache was "
     "walked over; runs of five steps, those before a run answered unclocked first, the clock's own cost and "
     "misses included"},
    {"cold_l2_ns_p99", p99_of_l2, optional, positive,
     "99 % of these took at most this; empty below 100 samples"},
    {"cold_l2_ns_p999", p999_of_l2, optional, positive,
     "99.9 % of these took at most this; empty below 1,000 samples"},
    {"cold_ns_p50", rounded<6, &R::cold, &C::p50>, optional, positive,
     "with `--cold`: half of the queries took at most this after as much as twice the last-level cache was "
     "walked over"},
    {"cold_ns_p99", p99_of_all, optional, positive,
     "99 % of these took at most this; empty below 100 samples"},
    {"cold_ns_max", rounded<6, &R::cold, &C::max>, optional, positive, "time of the slowest of these"},
    {"cold_l2_samples", text<&R::cold_l2, &C::samples>, optional, kinds::positive_count,
     "how many queries `cold_l2_ns_*` are of: as many as there was time for"},
    {"cold_samples", text<&R::cold, &C::samples>, optional, kinds::positive_count,
     "how many queries `cold_ns_*` are of: as many as there was time for"},
    {"data_lines", rounded<6, &R::lines, &N::data>, optional, positive,
     "with `--cache-lines`: cache lines of data that a query touches, on average, with what it prepares; "
     "valgrind counts them in samples of the steps, without AVX-512, which it does not know"},
    {"code_lines", rounded<6, &R::lines, &N::code>, optional, positive, "cache lines of code, likewise"},
    {"source", [](Row) { return std::string(); }, optional, any_text,
     "in what `touchmark merge` writes: the job's file that the row is from, and the code of the machine "
     "that ran it, as `--machine` takes it"},
    {"unfinished", text<&R::work, &W::brackets, &B::unfinished>, optional, whole_number,
     "with the option `budget`: answers that leave open whether a triangle is nearer than the one named. "
     "They tell a bracket, which holds the true distance; one that does not is `malformed`. Empty: all are "
     "finished"},
    {"bracket_p50", rounded<6, &R::work, &W::brackets, &B::p50>, optional, finite,
     "the median of how far the brackets' ends are apart, over the diagonal of the mesh's box; 0 where "
     "finished"},
    {"bracket_max", rounded<6, &R::work, &W::brackets, &B::max>, optional, finite, "the most of these"},
});

}  // namespace

std::span<const Column<R>> results_columns() { return columns; }

std::string results_csv(const std::string& run_id, const std::vector<R>& rows) {
  return table_of(columns, rows, run_id).csv();
}

}  // namespace touchmark::bench::results
