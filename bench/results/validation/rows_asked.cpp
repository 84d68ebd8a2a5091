#include "bench/results/validation/rows_asked.h"

#include <algorithm>
#include <map>
#include <string>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

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

}  // namespace

void check_rows_asked(const CsvTable& table, const Json* run, Faults& faults) {
  check_twice(table, run, faults);
  if (run != nullptr) check_missing(table, *run, faults);
}

/// The steps of a sample are the same where their number is.
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

}  // namespace touchmark::bench::results::validation
