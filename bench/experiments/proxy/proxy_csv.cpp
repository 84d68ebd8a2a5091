#include "bench/experiments/proxy/proxy_csv.h"

#include <array>
#include <string_view>

#include <fmt/format.h>

namespace touchmark::bench::experiments::proxy {
namespace {

using S = const Score&;

std::string per_tick(std::uint64_t count, std::uint64_t ticks) {
  return ticks > 0 ? fmt::format("{:.6g}", static_cast<double>(count) / static_cast<double>(ticks)) : "";
}

template <int thousandths>
std::string percentile(S score) {
  return fmt::format("{}", score.tally.times.percentile(thousandths / 1000.0));
}

template <int thousandths>
std::string bare_percentile(S score) {
  const measurement::LatencyHistogram& times = score.tally.bare_times;
  return times.count() > 0 ? fmt::format("{}", times.percentile(thousandths / 1000.0)) : "";
}

constexpr results::Kind ball_or_point{[](std::string_view text) { return text == "ball" || text == "point"; },
                                      "one of ball, point"};

using T = Tally;
using enum results::Presence;
using namespace results::kinds;
using results::text;

// The order is the contract.
constexpr auto columns = std::to_array<results::Column<Score>>({
    {"schema", [](S) { return std::to_string(proxy_schema); }, always, one, "1."},
    {"run_id", nullptr, always, any_text, "As in run.json."},
    {"method", [](S score) { return std::string(score.method.info->name); }, always, any_text, "The algorithm."},
    {"options", [](S score) { return score.method.options; }, optional, any_text, "As they were typed."},
    {"detector", text<&Score::detector>, optional, any_text, "Which of ours answers a method that claims never to cross."},
    {"family", text<&Score::family>, always, any_text, "As `touchmark proxy --help` lists them, or the mesh."},
    {"probe", [](S score) { return std::string(score.point ? "point" : "ball"); }, always, ball_or_point,
     "`ball`: the courses of this family with a radius; `point`: those without."},
    {"courses", text<&Score::courses>, always, positive_count, "Meshes with a motion each."},
    {"ticks", text<&Score::tally, &T::ticks>, always, whole_number, "Steps of the servo loop."},
    {"pieces", text<&Score::tally, &T::pieces>, always, whole_number, "Straight pieces of the proxy's way."},
    {"crossings", text<&Score::tally, &T::crossings>, always, whole_number,
     "Ticks whose way has a point in common with a triangle, sides and corners included; exact."},
    {"pops", text<&Score::tally, &T::pops>, always, whole_number,
     "Ticks that come out at the other side, beyond a billionth of the diagonal: what a hand feels as falling through."},
    {"violations", text<&Score::tally, &T::violations>, always, whole_number,
     "Ticks whose way comes nearer to the surface than the radius; exact."},
    {"max_shortfall_m", text<&Score::tally, &T::max_shortfall>, always, finite, "By how much, at the end of a tick."},
    {"missed_goals", text<&Score::tally, &T::missed_goals>, always, whole_number,
     "Ticks that end off their goal though the straight way to it was free; exact."},
    {"contact_ticks", text<&Score::tally, &T::contact_ticks>, always, whole_number, "Ticks that say they are in contact."},
    {"stuck_ticks", text<&Score::tally, &T::stuck_ticks>, always, whole_number,
     "Ticks that say they started inside or are squeezed."},
    {"unanswered", text<&Score::tally, &T::unanswered>, always, whole_number, "Ticks without an answer."},
    {"rest_ticks", text<&Score::tally, &T::rest_ticks>, always, whole_number, "Ticks whose goal has rested for more than ten."},
    {"jitters", text<&Score::tally, &T::jitters>, always, whole_number, "Of these, ticks at which a bit of the proxy changed."},
    {"optimum_ticks", text<&Score::tally, &T::optimum_ticks>, always, whole_number,
     "Ticks whose constrained optimum is unique and known."},
    {"max_optimum_error_m",
     [](S score) { return score.tally.optimum_ticks > 0 ? text<&Score::tally, &T::max_optimum_error>(score) : std::string(); },
     optional, finite, "The proxy's largest distance from that optimum."},
    {"mean_optimum_error_m",
     [](S score) {
       const Tally& tally = score.tally;
       return tally.optimum_ticks > 0
                  ? fmt::format("{:.6g}", tally.optimum_errors / static_cast<double>(tally.optimum_ticks))
                  : std::string();
     },
     optional, finite, "Its mean distance from that optimum."},
    {"max_force_jump_n", text<&Score::tally, &T::max_force_jump>, always, finite,
     "By how much a tick's change of force exceeded stiffness times the goal's motion, in N."},
    {"max_energy_j", text<&Score::tally, &T::max_energy>, always, finite,
     "The most energy that the device got over one closed turn of the goal, in J."},
    {"work_per_tick", [](S score) { return per_tick(score.tally.work, score.tally.ticks); }, optional, finite,
     "Triangles, boxes and whatever else was looked at."},
    {"p50_ns", percentile<500>, always, whole_number, "A whole tick's time, the least of its replays; percentiles by nearest rank."},
    {"p999_ns", percentile<999>, always, whole_number, ""},
    {"max_ns", [](S score) { return fmt::format("{}", score.tally.times.max_ns()); }, always, whole_number, ""},
    {"query_p50_ns", bare_percentile<500>, optional, whole_number,
     "The bare `nearest` of the same detector, without a limit of reach, at the same goals between the ticks."},
    {"query_p999_ns", bare_percentile<999>, optional, whole_number, ""},
    {"stopped_short", text<&Score::tally, &T::stopped_short>, always, whole_number,
     "Ticks that end off their goal though straight on towards it a thousandth of the radius, or for a point a millionth of the diagonal, was free, and more than 2^-32 of the coordinates; exact."},
    {"unfinished", text<&Score::tally, &T::unfinished>, always, whole_number,
     "Ticks that their limit of work ended; their ends are not judged."},
    {"max_lag", text<&Score::tally, &T::max_lag>, always, finite,
     "The proxy's largest distance from where it would be without that limit, in m; 0 without one."},
    {"preempted", text<&Score::tally, &T::preempted>, always, whole_number,
     "Ticks in each replay of which others took the core: their times hold that."},
});

}  // namespace

std::span<const results::Column<Score>> proxy_columns() { return columns; }

std::string proxy_csv(const std::string& run_id, const std::vector<Score>& scores) {
  return results::table_of(columns, scores, run_id).csv();
}

}  // namespace touchmark::bench::experiments::proxy
