/// `touchmark validate`: are recorded results what they should be?
#include <algorithm>
#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/extra/extra_commands.h"
#include "bench/cli/options.h"
#include "bench/experiments/audit/audit_row.h"
#include "bench/experiments/choose/choose_csv.h"
#include "bench/experiments/many/many_row.h"
#include "bench/experiments/proxy/proxy_check.h"
#include "bench/experiments/scaling/body_row.h"
#include "bench/experiments/servo/servo_check.h"
#include "bench/experiments/stress/stress_csv.h"
#include "bench/experiments/suite/suite_check.h"
#include "bench/results/validation/located_json.h"
#include "bench/results/validation/results_check.h"
#include "bench/results/validation/run_check.h"
#include "bench/results/validation/steps_check.h"
#include "bench/results/validation/visits_check.h"
#include "bench/support/files/standard_output.h"

namespace touchmark::bench::cli {

namespace choose = experiments::choose;
namespace many = experiments::many;
namespace proxy = experiments::proxy;
namespace servo = experiments::servo;
namespace stress = experiments::stress;
namespace suite = experiments::suite;
namespace validation = results::validation;

namespace {

namespace fs = std::filesystem;

bool is_visits(const fs::path& path) { return path.filename() == "visited.json"; }

bool is_run_json(const fs::path& path) { return path.extension() == ".json" && !is_visits(path); }

bool is_steps(const fs::path& path) { return path.extension() == ".bin"; }

/// The CSV files, run.json, steps.bin and visited.json files anywhere below, in the order of their names.
std::vector<std::string> files_below(const std::string& folder) {
  std::vector<std::string> files;
  try {
    for (const fs::directory_entry& entry : fs::recursive_directory_iterator(folder)) {
      const fs::path& path = entry.path();
      if (entry.is_regular_file() && (path.extension() == ".csv" || path.filename() == "run.json" ||
                                      path.filename() == "steps.bin" || is_visits(path)))
        files.push_back(path.string());
    }
  } catch (const fs::filesystem_error& error) {
    throw std::invalid_argument(fmt::format("{}: {}", folder, error.code().message()));
  }
  if (files.empty())
    throw std::invalid_argument(fmt::format("{}: no CSV file and no run.json in it", folder));
  std::ranges::sort(files);
  return files;
}

std::vector<std::string> files_of(const std::vector<std::string>& paths) {
  std::vector<std::string> files;
  for (const std::string& path : paths) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (!fs::exists(status)) throw std::invalid_argument(fmt::format("{}: no such file or folder", path));
    if (!fs::is_directory(status)) {
      files.push_back(path);
    } else {
      const std::vector<std::string> below = files_below(path);
      files.insert(files.end(), below.begin(), below.end());
    }
  }
  return files;
}

std::string check_json(const std::string& path, validation::Faults& faults) {
  const std::optional<validation::LocatedJson> run = validation::read_located_json(path, faults);
  if (run) validation::check_run(path, *run, faults);
  return "run";
}

/// The run.json beside a table; its own faults are reported where it is checked itself.
std::optional<validation::LocatedJson> run_next_to(const fs::path& path) {
  const fs::path run_path = path.parent_path() / "run.json";
  if (!fs::exists(run_path)) return std::nullopt;
  validation::Faults reported_elsewhere;
  std::optional<validation::LocatedJson> run = validation::read_located_json(run_path, reported_elsewhere);
  return run && run->value.is_object() ? std::move(run) : std::nullopt;
}

void check_servo_csv(const validation::CsvTable& table, const nlohmann::json* run,
                     validation::Faults& faults) {
  const fs::path beside = fs::path(table.path).parent_path() / "servo_histogram.csv";
  std::optional<validation::CsvTable> histogram;
  validation::Faults reported_elsewhere;
  if (fs::exists(beside)) histogram = validation::read_csv_table(beside.string(), reported_elsewhere);
  servo::check_servo(table, histogram ? &*histogram : nullptr, run, faults);
}

struct KnownTable {
  std::string_view name;  ///< The file's, without .csv.
  void (*check)(const validation::CsvTable& table, const nlohmann::json* run, validation::Faults& faults);
};
constexpr std::array<KnownTable, 8> known_tables{
    {{"stress", stress::check_stress},
     {"servo", check_servo_csv},
     {"choose", choose::check_choose},
     {"suite", suite::check_suite},
     {"bodies",
      [](const auto& table, auto*, auto& faults) { experiments::scaling::check_bodies(table, faults); }},
     {"audit",
      [](const auto& table, auto*, auto& faults) { experiments::audit::check_audit(table, faults); }},
     {"many", [](const auto& table, auto*, auto& faults) { many::check_many(table, faults); }},
     {"proxy", proxy::check_proxy}}};

std::string check_csv(const std::string& path, validation::Faults& faults) {
  const validation::CsvTable table = validation::read_csv_table(path, faults);
  validation::check_form(table, faults);
  const std::string file = fs::path(path).filename().string();
  const auto* const known = std::ranges::find_if(
      known_tables, [&](const KnownTable& one) { return file == fmt::format("{}.csv", one.name); });
  const bool is_known = known != known_tables.end();
  const bool results =
      !is_known && (file == "results.csv" || table.has("run_id") || table.has("answers_checksum"));
  const bool has_run = is_known || file == "results.csv";
  const std::optional<validation::LocatedJson> run = has_run ? run_next_to(path) : std::nullopt;
  const nlohmann::json* run_json = run ? &run->value : nullptr;
  if (is_known) known->check(table, run_json, faults);
  if (results) validation::check_results(table, run_json, faults);
  return fmt::format("{}, {} rows",
                     is_known  ? known->name
                     : results ? "results"
                               : "another table, checked for its form only",
                     table.records.size());
}

/// The results.csv beside a file; its own faults are reported where it is checked itself.
std::optional<validation::CsvTable> results_next_to(const fs::path& path) {
  const fs::path beside = path.parent_path() / "results.csv";
  if (!fs::exists(beside)) return std::nullopt;
  validation::Faults reported_elsewhere;
  return validation::read_csv_table(beside.string(), reported_elsewhere);
}

std::string check_binary(const std::string& path, validation::Faults& faults) {
  const std::optional<validation::CsvTable> results = results_next_to(path);
  return validation::check_steps(path, results ? &*results : nullptr, faults);
}

std::string check_visited(const std::string& path, validation::Faults& faults) {
  const std::optional<validation::LocatedJson> visits = validation::read_located_json(path, faults);
  if (!visits) return "visited";
  const std::optional<validation::CsvTable> results = results_next_to(path);
  return validation::check_visits(path, *visits, results ? &*results : nullptr, faults);
}

std::string check_file(const std::string& path, validation::Faults& faults) {
  if (is_run_json(path)) return check_json(path, faults);
  if (is_visits(path)) return check_visited(path, faults);
  if (is_steps(path)) return check_binary(path, faults);
  return check_csv(path, faults);
}

int validate(const std::vector<std::string>& paths) {
  support::StandardOutput out;
  std::size_t total = 0;
  const std::vector<std::string> files = files_of(paths);
  for (const std::string& path : files) {
    validation::Faults faults;
    const std::string kind = check_file(path, faults);
    for (const validation::Fault& fault : faults) out.write(validation::line_of(fault) + "\n");
    if (faults.empty()) out.write(fmt::format("{}: fine ({})\n", path, kind));
    total += faults.size();
  }
  if (total > 0) out.write(fmt::format("{} faults in {} files\n", total, files.size()));
  out.finish();
  return total > 0 ? support::exit_check_failed : support::exit_done;
}

}  // namespace

void add_validate(CLI::App& program, ProgramContext& context) {
  const auto paths = std::make_shared<std::vector<std::string>>();
  CLI::App* command = add_command(program, "validate");
  add_value(*command, "path", *paths, "FILE|DIR",
            "results.csv, stress.csv, servo.csv, choose.csv, suite.csv, proxy.csv, many.csv, bodies.csv, "
            "audit.csv, run.json, steps.bin, visited.json, or folders that hold some; other CSV files are "
            "checked for their form")
      ->required();
  command->footer(
      "Prints a line for each fault: file, line, column, value, and what is wrong. Exit status 1 if there is "
      "any.\nExample: touchmark validate results/*/*\n");
  command->final_callback([paths, &context] { context.status = validate(*paths); });
}

}  // namespace touchmark::bench::cli
