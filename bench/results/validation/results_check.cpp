#include "bench/results/validation/results_check.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <nlohmann/json_fwd.hpp>

#include "bench/measurement/result_row.h"
#include "bench/results/results_csv.h"
#include "bench/results/validation/results_check.h"
#include "bench/results/validation/row_check.h"
#include "bench/support/files/csv_dialect.h"
#include "bench/support/numbers.h"

namespace touchmark::bench::results::validation {
namespace {

using Json = nlohmann::json;

std::string contestant_of(const CsvTable& table, const CsvRecord& row) {
  const std::string options = table.field(row, "options");
  return table.field(row, "detector") + (options.empty() ? "" : ":" + options);
}

/// One text for all of them; no name holds the byte between.
std::string key_of(const std::vector<std::string>& parts) {
  return fmt::format("{}", fmt::join(parts, "\x1f"));
}

std::string what(const CsvTable& table, const CsvRecord& row) {
  return key_of({contestant_of(table, row), table.field(row, "mesh"), table.field(row, "trajectory"),
                 table.field(row, "query"), table.field(row, "radius"), table.field(row, "reach")});
}

std::vector<std::string> texts(const Json& list) {
  std::vector<std::string> result;
  if (!list.is_array()) return result;
  for (const Json& one : list)
    if (one.is_string()) result.push_back(one.get<std::string>());
  return result;
}

/// A member, or null; also of what is no object.
Json member(const Json& json, const char* name) {
  return json.is_object() ? json.value(name, Json()) : Json();
}

std::vector<std::string> names_of(const Json& list) {
  std::vector<std::string> names;
  if (!list.is_array()) return names;
  for (const Json& one : list) {
    const Json name = member(one, "name");
    if (name.is_string()) names.push_back(name.get<std::string>());
  }
  return names;
}

/// How often each contestant is named: once, unless the command line named it again.
std::map<std::string, std::size_t> times_asked(const Json& run) {
  std::map<std::string, std::size_t> times;
  const Json list = member(run, "contestants");
  if (!list.is_array()) return times;
  for (const Json& one : list) {
    const Json name = member(one, "name"), options = member(one, "written_options");
    if (!name.is_string() || !options.is_string()) continue;
    const auto written = options.get<std::string>();
    ++times[name.get<std::string>() + (written.empty() ? "" : ":" + written)];
  }
  return times;
}

/// Returns the contestant of a row as it was asked for: without what it chose for itself, which stands last.
std::string asked_as(const CsvTable& table, const CsvRecord& row,
                     const std::map<std::string, std::size_t>& asked) {
  const std::string contestant = contestant_of(table, row);
  if (asked.contains(contestant)) return contestant;
  std::size_t chosen = contestant.rfind(":chose=");
  if (chosen == std::string::npos) chosen = contestant.rfind(",chose=");
  return contestant.substr(0, chosen);
}

void check_twice(const CsvTable& table, const Json* run, Faults& faults) {
  std::map<std::string, std::size_t> seen;
  const std::map<std::string, std::size_t> asked = run != nullptr ? times_asked(*run) : decltype(seen){};
  for (const CsvRecord& row : table.records) {
    const std::string key = run != nullptr ? what(table, row) : key_of(row.fields);
    const auto times = asked.find(asked_as(table, row, asked));
    if (++seen[key] <= (times == asked.end() ? 1 : times->second)) continue;
    faults.push_back({table.path, row.line, "detector", contestant_of(table, row), "has this row twice"});
  }
}

bool is_left_out(const Json& asked, const std::string& trajectory, const std::string& contestant) {
  const Json list = member(asked, "left_out");
  return list.is_array() && std::ranges::any_of(list, [&](const Json& one) {
           return member(one, "trajectory") == trajectory && member(one, "contestant") == contestant;
         });
}

void check_missing(const CsvTable& table, const Json& run, Faults& faults) {
  const Json asked = member(run, "asked");
  if (!asked.is_object() || member(run, "finished") != true) return;
  const std::map<std::string, std::size_t> named = times_asked(run);
  std::map<std::string, std::size_t> found;
  for (const CsvRecord& row : table.records)
    ++found[key_of({asked_as(table, row, named), table.field(row, "mesh"), table.field(row, "trajectory"),
                    table.field(row, "query")})];
  std::vector<std::string> meshes = names_of(member(run, "meshes"));
  if (meshes.empty()) meshes = names_of(Json::array({member(run, "mesh")}));
  for (const std::string& mesh : meshes) {
    for (const std::string& trajectory : texts(member(asked, "trajectories"))) {
      for (const std::string& query : texts(member(asked, "queries"))) {
        for (const std::string& contestant : texts(member(asked, "contestants"))) {
          if (is_left_out(asked, trajectory, contestant)) continue;
          std::size_t& rows = found[key_of({contestant, mesh, trajectory, query})];
          if (rows > 0) {
            --rows;
            continue;
          }
          const std::string subject = fmt::format("{} on {}, {}", contestant, mesh, trajectory);
          faults.push_back(
              {table.path, 1, "rows", subject, "is missing, and run.json says it was asked for"});
        }
      }
    }
  }
}

/// Contact within a contestant's own accuracy of the threshold may be decided either way.
bool has_decided(const CsvTable& table, const CsvRecord& row) {
  return table.field(row, "guarantee") == "exact" && table.field(row, "status") == "ok" &&
         table.field(row, "unresolved") == "0" && !table.field(row, "decisions_checksum").empty();
}

/// No row twice, by what it is about where `run` is known, else as a whole; and, where `run` names what was
/// asked for and is finished, none missing. `run` may be null.
void check_rows_asked(const CsvTable& table, const Json* run, Faults& faults) {
  check_twice(table, run, faults);
  if (run != nullptr) check_missing(table, *run, faults);
}

/// The steps of a sample are the same where their number is.
/// Whoever claims exactness, on the same steps of the same trajectory, decides alike.
void check_exact_peers(const CsvTable& table, Faults& faults) {
  std::map<std::string, const CsvRecord*> first;
  for (const CsvRecord& row : table.records) {
    if (!has_decided(table, row)) continue;
    const std::string key =
        key_of({table.field(row, "run_id"), table.field(row, "mesh"), table.field(row, "trajectory"),
                table.field(row, "query"), table.field(row, "radius"), table.field(row, "reach"),
                table.field(row, "steps")});
    const CsvRecord& peer = *first.try_emplace(key, &row).first->second;
    if (table.field(peer, "decisions_checksum") == table.field(row, "decisions_checksum")) continue;
    faults.push_back({table.path, row.line, "decisions_checksum", table.field(row, "decisions_checksum"),
                      fmt::format("is not that of {}, line {}, which claims exactness as well",
                                  contestant_of(table, peer), peer.line)});
  }
}

// Times are written with six digits, so that two of them may disagree in the last.
constexpr double rounding = 1e-5;

/// Lists of columns, with blanks between them. No number is above that of the next column of its list.
constexpr const char* ascending =
    "missed<steps false_contacts<steps wrong_triangle<steps unresolved<steps judged<steps missed<judged "
    "false_contacts<judged beyond_tolerance<judged rounding<judged ns_per_query_min<ns_per_query "
    "ns_p50<ns_p90<ns_p99<ns_p999<ns_max ns_p99<ns_max "
    "ns_undisturbed_low<ns_undisturbed<ns_undisturbed_high longest_miss_run_1khz<deadline_misses_1khz "
    "longest_miss_run_4khz<deadline_misses_4khz longest_miss_run_10khz<deadline_misses_10khz "
    "deadline_misses_1khz<deadline_misses_4khz<deadline_misses_10khz<steps build_ms<first_answer_ms "
    "work_mean<work_max cells_mean<work_mean spheres_mean<work_mean boxes_mean<work_mean "
    "triangles_mean<work_mean prepare_ns_p50<prepare_ns_p999<prepare_ns_max "
    "cold_l2_ns_p50<cold_l2_ns_p99<cold_l2_ns_p999 cold_ns_p50<cold_ns_p99<cold_ns_max "
    "cold_ns_p50<cold_ns_max";

class ResultsRowCheck : RowCheck {
 public:
  /// `timed`: some row of the file has times.
  ResultsRowCheck(const RowCheck& row, bool timed, const nlohmann::json* run)
      : RowCheck(row), timed_(timed), run_(run) {}

  void check() const {
    check_columns();
    check_order();
    check_rate();
    check_mean();
    check_p999();
    check_exactness();
    if (run_ != nullptr) check_against_run();
  }

 private:
  void check_columns() const {
    check_fields(results_columns(), timed_);
    for (const char* const column : {"judged", "steps"})
      if (is_ok() && field(column) == "0") fault(column, "must be above 0 where the status is ok");
  }

  void check_order() const {
    for (const std::string& list : support::split_fields(ascending, ' ')) {
      const std::vector<std::string> columns = support::split_fields(list, '<');
      for (std::size_t i = 1; i < columns.size(); ++i) {
        const std::string &low = columns[i - 1], &high = columns[i];
        const std::optional<double> less = number(low), more = number(high);
        if (less && more && *less > *more * (1 + rounding))
          fault(low, fmt::format("is above {} {}", high, field(high)));
      }
    }
  }

  void check_rate() const {
    const std::optional<double> ns = number("ns_per_query");
    const std::optional<double> rate = number("update_rate_hz");
    if (ns && rate && std::abs(*ns * *rate / 1e9 - 1) > 2 * rounding)
      fault("update_rate_hz", fmt::format("is not 1e9 / ns_per_query {}", field("ns_per_query")));
  }

  /// No mean is above the maximum. The mean is of other passes than the maximum, so that where all steps take
  /// equally long it may be a little. The elapsed mean holds what interrupted its passes, which the row tells
  /// by a share that was disturbed or by less processor time.
  void check_mean() const {
    constexpr double between_passes = 1.25;
    const std::optional<double> most = number("ns_max");
    const std::optional<double> disturbed = number("disturbed_share"), elapsed = number("ns_per_query"),
                                processor = number("cpu_ns_per_query");
    const bool took_longer = elapsed && processor && *elapsed > between_passes * *processor;
    for (const char* const column : {"ns_per_query", "ns_undisturbed"}) {
      const std::optional<double> mean = number(column);
      const bool interrupted =
          column == std::string_view("ns_per_query") && ((disturbed && *disturbed > 0) || took_longer);
      if (mean && most && !interrupted && *mean > between_passes * *most)
        fault(column, fmt::format("is above ns_max {}", field("ns_max")));
    }
  }

  /// From so many steps on there is a 99.9 %; of fewer it was told only before `ns_undisturbed` was.
  void check_p999() const {
    const std::optional<std::uint64_t> steps = support::parse_count(field("steps"));
    if (!steps || !is_ok()) return;
    const bool enough = *steps >= measurement::steps_for_p999;
    if (enough && timed_ && field("ns_p999").empty())
      fault("ns_p999", "must not be empty from 1,000 steps on");
    if (!enough && !field("ns_undisturbed").empty() && !field("ns_p999").empty())
      fault("ns_p999", "must be empty below 1,000 steps");
  }

  /// Whoever claims exactness and errs is no result to quote.
  void check_exactness() const {
    if (field("guarantee") != "exact" || !is_ok()) return;
    for (const char* const column : {"missed", "false_contacts", "wrong_triangle"}) {
      const std::optional<std::uint64_t> wrong = support::parse_count(field(column));
      if (wrong && *wrong > 0) fault(column, "must be 0 where the guarantee is exact");
    }
  }

  /// A run.json that is not as it should be has faults of its own, so what is not there is not compared.
  void check_against_run() const {
    const auto expect = [&](const char* column, const nlohmann::json& value) {
      if (!value.is_string() && !value.is_number()) return;
      const std::string text = value.is_string() ? value.get<std::string>() : value.dump();
      if (field(column) != text) fault(column, fmt::format("is not run.json's {}", text));
    };
    expect("run_id", run_->value("run_id", nlohmann::json()));
    const nlohmann::json queries = run_->value("queries", nlohmann::json());  // where it is of several
    if (!queries.is_array()) {
      expect("query", run_->value("query", nlohmann::json()));
    } else if (std::ranges::find(queries, Json(field("query"))) == queries.end()) {
      fault("query", "is not among run.json's queries");
    }
    const nlohmann::json meshes = run_->value("meshes", nlohmann::json());
    nlohmann::json mesh = run_->value("mesh", nlohmann::json());
    if (meshes.is_array()) {
      check_listed("mesh", meshes, "meshes");
      mesh = nullptr;
      for (const nlohmann::json& one : meshes)
        if (one.is_object() && one.value("name", nlohmann::json()) == field("mesh")) mesh = one;
    }
    if (mesh.is_object()) {
      expect("mesh", mesh.value("name", nlohmann::json()));
      expect("triangles", mesh.value("triangles", nlohmann::json()));
    }
    check_listed("trajectory", run_->value("trajectories", nlohmann::json()), "trajectories");
    check_listed("detector", run_->value("contestants", nlohmann::json()), "contestants");
  }

  void check_listed(const char* column, const nlohmann::json& list, const char* what) const {
    if (!list.is_array()) return;
    const bool listed = std::ranges::any_of(list, [&](const nlohmann::json& entry) {
      return entry.is_object() && entry.contains("name") && entry["name"] == field(column);
    });
    if (!listed) fault(column, fmt::format("is not among run.json's {}", what));
  }

  bool timed_;
  const nlohmann::json* run_;
};

}  // namespace

void check_results(const CsvTable& table, const nlohmann::json* run, Faults& faults) {
  const bool timed = run != nullptr || std::ranges::any_of(table.records, [&](const auto& row) {
                       return is_ok(table, row) && !table.field(row, "ns_per_query").empty();
                     });
  const auto check = [&](const RowCheck& row) { ResultsRowCheck(row, timed, run).check(); };
  if (!check_rows(table, results_columns(), columns_of_the_contract, faults, check)) return;
  check_rows_asked(table, run, faults);
  check_exact_peers(table, faults);
}

}  // namespace touchmark::bench::results::validation
