#include "bench/experiments/stress/stress_csv.h"

#include <algorithm>
#include <array>
#include <string_view>

#include <fmt/format.h>

#include "bench/workload/query_name.h"

namespace touchmark::bench::experiments::stress {
namespace {

template <auto Member>
std::string counted(const Score& score) {
  return fmt::format("{}", score.counts.*Member);
}
template <auto Member>
std::string plain(const Score& score) {
  return fmt::format("{}", score.*Member);
}
template <auto Member>
std::string error(const Score& score) {
  return score.counts.judged > 0 ? fmt::format("{}", score.counts.*Member) : "";
}

constexpr results::Kind standing{
    [](std::string_view text) {
      constexpr std::array standings{"ok",    "unsupported", "refused", "inexact",
                                     "wrong", "timeout",     "crashed"};
      return std::find(standings.begin(), standings.end(), text) != standings.end();
    },
    "one of ok, unsupported, refused, inexact, wrong, timeout, crashed"};

using E = oracle::ErrorCounts;
using S = const Score&;

using enum results::Presence;
using namespace results::kinds;

// The order is the contract.
constexpr auto columns = std::to_array<results::Column<Score>>({
    {"schema", [](S) { return std::to_string(stress_schema); }, always, one},
    {"run_id", nullptr, always},
    {"detector", plain<&Score::detector>, always},
    {"options", plain<&Score::options>},
    {"family", [](S score) { return std::string(score.family->name); }, always},
    {"query", [](S score) { return std::string(name_of(score.query)); }, always, query},
    {"guarantee", plain<&Score::guarantee>, optional, guarantee},
    {"adversarial", [](S score) { return fmt::format("{:d}", score.family->adversarial); }, always, bit},
    {"meshes", plain<&Score::meshes>, always, whole_number},
    {"probes", counted<&E::judged>, always, whole_number},
    {"missed", counted<&E::missed>, always, whole_number},
    {"false_contacts", counted<&E::false_contacts>, always, whole_number},
    {"wrong_triangle", counted<&E::wrong_triangle>, always, whole_number},
    {"beyond_bound", counted<&E::beyond_bound>, always, whole_number},
    {"wrong_point", counted<&E::wrong_point>, always, whole_number},
    {"wrong_normal", counted<&E::wrong_normal>, always, whole_number},
    {"malformed", counted<&E::malformed>, always, whole_number},
    {"unresolved", counted<&E::unresolved>, always, whole_number},
    {"max_distance_error", error<&E::max_distance_error>, optional, length},
    {"max_distance_error_of_diagonal", error<&E::max_distance_error_of_diagonal>, optional, length},
    {"max_distance_error_ulp", error<&E::max_distance_error_ulp>, optional, length},
    {"status", [](S score) { return std::string(name_of(score.standing())); }, always, standing},
    {"crashes", plain<&Score::crashes>, always, whole_number},
    {"timeouts", plain<&Score::timeouts>, always, whole_number},
    {"refusals", plain<&Score::refusals>, always, whole_number},
    {"ns_per_query",
     [](S score) {
       const std::optional<double> ns = score.ns_per_query();
       return ns ? fmt::format("{:.6g}", *ns) : std::string();
     },
     optional, positive},
    // Appended to schema 1.
    {"beyond_tolerance", counted<&E::beyond_tolerance>, always, whole_number},
    {"rounding", counted<&E::rounding>, always, whole_number},
    {"wrong_side", counted<&E::wrong_side>, always, whole_number},
});

}  // namespace

std::span<const results::Column<Score>> stress_columns() { return columns; }

std::string stress_csv(const std::string& run_id, const std::vector<Score>& scores) {
  return results::table_of(columns, scores, run_id).csv();
}

}  // namespace touchmark::bench::experiments::stress
