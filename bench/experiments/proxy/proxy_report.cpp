#include "bench/experiments/proxy/proxy_report.h"

#include <algorithm>
#include <iterator>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/results/run_circumstances.h"
#include "bench/support/grouping.h"
#include "bench/support/table.h"

namespace touchmark::bench::experiments::proxy {
namespace {

/// A share in parts per million, exact zero as a point.
std::string per_million(std::uint64_t count, std::uint64_t ticks) {
  if (count == 0) return ".";
  return fmt::format("{:.0f}", std::max(1.0, 1e6 * static_cast<double>(count) / static_cast<double>(ticks)));
}

Tally sum_of(const std::vector<const Score*>& scores) {
  Tally sum;
  for (const Score* score : scores) {
    const Tally& one = score->tally;
    sum.ticks += one.ticks, sum.crossings += one.crossings, sum.pops += one.pops;
    sum.violations += one.violations, sum.missed_goals += one.missed_goals,
        sum.stopped_short += one.stopped_short, sum.jitters += one.jitters;
    sum.unanswered += one.unanswered, sum.stuck_ticks += one.stuck_ticks, sum.work += one.work;
    sum.unfinished += one.unfinished;
    sum.max_lag = std::max(sum.max_lag, one.max_lag);
    sum.max_shortfall = std::max(sum.max_shortfall, one.max_shortfall);
    sum.max_optimum_error = std::max(sum.max_optimum_error, one.max_optimum_error);
    sum.max_force_jump = std::max(sum.max_force_jump, one.max_force_jump);
    sum.max_energy = std::max(sum.max_energy, one.max_energy);
  }
  return sum;
}

auto by_method(const std::vector<Score>& scores) {
  return support::grouped_by(scores, [](const Score& score) { return score.method.text(); });
}

std::string crossings_of(const Tally& tally) {
  return per_million(tally.crossings, tally.ticks) +
         (tally.pops > 0 ? fmt::format(" ({})", per_million(tally.pops, tally.ticks)) : "");
}

std::string crossings_table(const std::vector<Score>& scores) {
  const auto methods = by_method(scores);
  std::vector<std::string> header{"crossings (pops) per million ticks"};
  for (const auto& [method, of_it] : methods) header.push_back(method);
  support::Table table(header);
  const auto family_of = [](const Score& score) { return score.family + (score.point ? ", point" : ""); };
  for (const auto& [family, of_family] : support::grouped_by(scores, family_of)) {
    std::vector<std::string> line{family};
    for (const auto& [method, of_it] : methods) {
      std::vector<const Score*> both;
      std::copy_if(of_family.begin(), of_family.end(), std::back_inserter(both),
                   [&, name = method](const Score* one) { return one->method.text() == name; });
      line.push_back(both.empty() ? "" : crossings_of(sum_of(both)));
    }
    table.add(line);
  }
  return table.text();
}

std::string sums_table(const std::vector<Score>& scores) {
  support::Table table({"method", "ticks", "crossed", "popped", "too near", "by m", "off optimum m",
                        "goals missed", "stopped short", "jitters", "stuck", "unfinished", "lag m",
                        "no answer", "force jump N", "energy J", "worst p50 ns", "p99.9 ns", "max ns"});
  for (const auto& [method, of_it] : by_method(scores)) {
    const Tally sum = sum_of(of_it);
    std::int64_t median = 0, late = 0, worst = 0;  // of families: the largest
    for (const Score* score : of_it) {
      median = std::max(median, score->tally.times.percentile(0.5));
      late = std::max(late, score->tally.times.percentile(0.999));
      worst = std::max(worst, score->tally.times.max_ns());
    }
    const auto text = [](auto value) { return fmt::format("{}", value); };
    const auto short_text = [](double value) { return fmt::format("{:.3g}", value); };
    table.add({method, text(sum.ticks), text(sum.crossings), text(sum.pops), text(sum.violations),
               short_text(sum.max_shortfall), short_text(sum.max_optimum_error), text(sum.missed_goals),
               text(sum.stopped_short), text(sum.jitters), text(sum.stuck_ticks), text(sum.unfinished),
               short_text(sum.max_lag), text(sum.unanswered), short_text(sum.max_force_jump),
               short_text(sum.max_energy), text(median), text(late), text(worst)});
  }
  return table.text();
}

}  // namespace

std::string proxy_table(const std::vector<Score>& scores) {
  return crossings_table(scores) + "\n" + sums_table(scores);
}

std::string proxy_faults(const std::vector<Score>& scores) {
  std::string text;
  for (const Score& score : scores) {
    if (score.broken())
      text += fmt::format("{} crossed or came too near in {}: {}\n", score.method.text(), score.family,
                          score.first_fault);
  }
  return text;
}

nlohmann::ordered_json coupling_json(const Coupling& coupling) {
  return {{"stiffness_n_per_m", coupling.stiffness},
          {"static_friction", coupling.static_friction},
          {"dynamic_friction", coupling.dynamic_friction},
          {"damping_ns_per_m", coupling.damping},
          {"shading", coupling.shading},
          {"max_work", coupling.max_work}};
}

std::string proxy_json(const results::RunDescription& description, const ProxyRun& run) {
  using Json = nlohmann::ordered_json;
  Json json = results::run_circumstances(description);
  const ProxyRequest& request = run.request();
  json["contestants"] = Json::array();  // methods are told below
  json["proxy"] = {{"ticks", request.ticks}, {"replays", request.replays}, {"detector", request.detector}};
  json["proxy"].update(coupling_json(request.coupling));
  Json methods = Json::array(), families = Json::array();
  for (const MethodSpec& method : request.methods)
    methods.push_back({{"name", method.text()}, {"meaning", method.info->meaning}});
  for (const Family* family : request.families)
    families.push_back({{"name", family->name}, {"meaning", family->meaning}});
  json["proxy"]["methods"] = std::move(methods);
  json["proxy"]["families"] = std::move(families);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace touchmark::bench::experiments::proxy
