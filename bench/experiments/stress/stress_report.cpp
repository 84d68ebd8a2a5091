#include "bench/experiments/stress/stress_report.h"

#include <algorithm>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/results/run_circumstances.h"
#include "bench/results/verification_report.h"
#include "bench/support/grouping.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::experiments::stress {
namespace {

/// One contestant's scores of one family, whatever the query.
struct Cell {
  Standing standing = Standing::clean;
  oracle::ErrorCounts counts;

  void add(const Score& score) {
    standing = std::max(standing, score.standing());
    counts += score.counts;
  }
  std::string text() const {
    switch (standing) {
      case Standing::clean:
        return ".";
      case Standing::unsupported:
        return counts.judged > 0 ? "." : "-";
      case Standing::refused:
        return "R";
      case Standing::inexact:
        return fmt::format("~{}", counts.wrong_triangle + measurement::answers_off(counts));
      case Standing::wrong:
        return fmt::format("{}", counts.missed + counts.false_contacts + counts.malformed);
      case Standing::timeout:
        return "T";
      case Standing::crashed:
        return "C";
    }
    return "";
  }
};

std::string letter(std::size_t column) {
  return std::string(1, static_cast<char>(column < 26 ? 'a' + column : 'A' + (column - 26)));
}

std::string sums(const std::vector<Score>& scores) {
  std::uint64_t answers = 0, adversarial = 0;
  for (const Score& score : scores) {
    answers += score.counts.judged;
    if (score.family->adversarial) adversarial += score.counts.judged;
  }
  return fmt::format("{} answers judged exactly, {} of them at the edge of contact\n", answers, adversarial);
}

}  // namespace

support::Table stress_table(const std::vector<Score>& scores) {
  const auto shown = support::grouped_by(scores, [](const Score& score) { return score.family; });
  std::vector<std::string> header{"contestant"};
  for (std::size_t column = 0; column < shown.size(); ++column) header.push_back(letter(column));
  header.emplace_back("verdict");
  support::Table table(header);
  for (const auto& [contestant, of_it] :
       support::grouped_by(scores, [](const Score& score) { return score.contestant; })) {
    std::vector<std::string> line{contestant};
    bool broken = false;
    std::uint64_t judged = 0;
    for (const auto& [family, _] : shown) {
      std::optional<Cell> cell;
      for (const Score* score : of_it) {
        if (score->family != family) continue;
        if (!cell) cell.emplace();
        cell->add(*score);
        broken = broken || score->broken;
        judged += score->counts.judged;
      }
      line.push_back(cell ? cell->text() : "");
    }
    line.emplace_back(results::verdict_on(broken, judged));
    table.add(line);
  }
  return table;
}

std::string stress_legend(const std::vector<Score>& scores) {
  const auto shown = support::grouped_by(scores, [](const Score& score) { return score.family; });
  std::string text = "\n";
  for (std::size_t column = 0; column < shown.size(); ++column)
    text +=
        fmt::format("{}  {}: {}\n", letter(column), shown[column].first->name, shown[column].first->meaning);
  text +=
      "N missed, made up or malformed, ~N otherwise off by more than declared, or, where nothing is "
      "declared, than " +
      fmt::format("{:g}", oracle::physical_tolerance) +
      " of the diagonal, . none, R refused, - unsupported, C crashed, T timeout\n";
  return text + sums(scores);
}

std::vector<results::TestCase> cases_of(const std::vector<Score>& scores) {
  std::vector<results::TestCase> cases;
  for (const Score& score : scores) {
    results::TestCase& one = cases.emplace_back();
    one.group = score.contestant;
    one.name = fmt::format("{}/{}", score.family->name, workload::name_of(score.query));
    one.seconds = score.busy_s;
    if (score.broken) {
      one.outcome = results::Outcome::failed;
      one.message = fmt::format("{}: of {} answers {}", name_of(score.standing()), score.counts.judged,
                                ground_truth::charges_of(score.counts));
    } else if (score.counts.judged == 0) {
      one.outcome = results::Outcome::skipped;
      one.message = name_of(score.standing());
    }
  }
  return cases;
}

std::string stress_json(const results::RunDescription& description, const StressRun& run) {
  using Json = nlohmann::ordered_json;
  Json json = results::run_circumstances(description);
  const StressRequest& request = run.request();
  json["queries"] = Json::array();
  for (const workload::Query query : request.queries) json["queries"].push_back(name_of(query));
  json["probes"] = request.probes;
  json["families"] = Json::array();
  for (const Family* family : request.families) {
    const FamilyCount count = run.count_of(*family);
    json["families"].push_back({{"name", family->name},
                                {"meaning", family->meaning},
                                {"adversarial", family->adversarial},
                                {"rounds", count.rounds},
                                {"probes", count.probes}});
  }
  json["contestants"] = Json::array();
  for (std::size_t i = 0; i < request.contestants.size(); ++i)
    json["contestants"].push_back(results::contestant_json(request.contestants[i], run.flushed_to_zero(i)));
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

}  // namespace touchmark::bench::experiments::stress
