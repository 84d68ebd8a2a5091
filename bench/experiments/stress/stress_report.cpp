#include "bench/experiments/stress/stress_report.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/results/run_circumstances.h"
#include "bench/results/verification_report.h"
#include "bench/support/table.h"
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

template <class Value>
std::size_t column_of(std::vector<Value>& list, const Value& value) {
  const auto found = std::find(list.begin(), list.end(), value);
  if (found != list.end()) return static_cast<std::size_t>(found - list.begin());
  list.push_back(value);
  return list.size() - 1;
}

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

std::string stress_table(const std::vector<Score>& scores) {
  std::vector<std::string> contestants;
  std::vector<const Family*> shown;
  std::map<std::pair<std::size_t, std::size_t>, Cell> cells;
  std::map<std::size_t, bool> broken;
  std::map<std::size_t, std::uint64_t> judged;
  for (const Score& score : scores) {
    const std::size_t row = column_of(contestants, score.contestant);
    cells[{row, column_of(shown, score.family)}].add(score);
    broken[row] = broken[row] || score.broken;
    judged[row] += score.counts.judged;
  }
  std::vector<std::string> header{"contestant"};
  for (std::size_t column = 0; column < shown.size(); ++column) header.push_back(letter(column));
  header.emplace_back("verdict");
  support::Table table(header);
  for (std::size_t row = 0; row < contestants.size(); ++row) {
    std::vector<std::string> line{contestants[row]};
    for (std::size_t column = 0; column < shown.size(); ++column) {
      const auto cell = cells.find({row, column});
      line.push_back(cell == cells.end() ? "" : cell->second.text());
    }
    line.emplace_back(results::verdict_on(broken[row], judged[row]));
    table.add(line);
  }
  std::string text = table.text() + '\n';
  for (std::size_t column = 0; column < shown.size(); ++column)
    text += fmt::format("{}  {}: {}\n", letter(column), shown[column]->name, shown[column]->meaning);
  text +=
      "N missed, made up or malformed, ~N otherwise off by more than declared, or, where nothing is "
      "declared, than " +
      fmt::format("{:g}", oracle::physical_tolerance) +
      " of the diagonal, . none, R refused, - unsupported, C crashed, T timeout\n";
  return text + sums(scores);
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
