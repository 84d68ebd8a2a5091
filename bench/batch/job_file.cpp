#include "bench/batch/job_file.h"

#include <stdexcept>

#include <fmt/format.h>

#include "bench/results/results_csv.h"
#include "bench/results/validation/json_schema.h"
#include "bench/results/validation/located_json.h"
#include "bench/results/validation/run_check.h"

namespace touchmark::bench::batch {

namespace validation = results::validation;

namespace {

constexpr int job_schema = 1;

nlohmann::json form_of_jobs() {
  const std::vector<std::string> names = results::names_of(results::results_columns());
  nlohmann::json columns = nlohmann::json::object();
  for (const std::string& name : names) columns[name] = {{"type", "string"}};
  return {{"type", "object"},
          {"required", {"schema", "id", "machine", "run", "row"}},
          {"properties",
           {{"schema", {{"const", job_schema}}},
            {"id", {{"type", "string"}, {"pattern", "^[0-9a-f]{16}$"}}},
            {"machine", {{"type", "string"}, {"pattern", "^[0-9a-f]{16}$"}}},
            {"run", nlohmann::json::parse(validation::run_schema)},
            {"row", {{"type", "object"}, {"required", names}, {"properties", columns}}}}}};
}

}  // namespace

std::string JobResult::json() const {
  nlohmann::ordered_json row = nlohmann::ordered_json::object();
  for (std::size_t i = 0; i < fields.size(); ++i)
    row[std::string(results::results_columns()[i].name)] = fields[i];
  const nlohmann::ordered_json job{
      {"schema", job_schema}, {"id", id}, {"machine", machine}, {"row", row}, {"run", run}};
  return job.dump(1, ' ', false, nlohmann::json::error_handler_t::replace) + '\n';
}

std::filesystem::path job_path(const std::filesystem::path& folder, const std::string& id) {
  return folder / (id + ".json");
}

JobResult read_job(const std::string& path) {
  static const validation::JsonSchema form(form_of_jobs());
  validation::Faults faults;
  const std::optional<validation::LocatedJson> document = validation::read_located_json(path, faults);
  if (document) form.check(path, *document, faults);
  if (!faults.empty())
    throw std::invalid_argument(validation::line_of(faults.front()) + " (not a finished job)");
  const nlohmann::json& job = document->value;
  JobResult result{job.at("id"), job.at("machine"), job.at("run"), {}};
  for (const auto& column : results::results_columns())
    result.fields.push_back(job.at("row").at(std::string(column.name)));
  return result;
}

bool is_finished(const std::filesystem::path& folder, const std::string& id) {
  std::error_code ignored;
  const std::filesystem::path path = job_path(folder, id);
  if (!std::filesystem::exists(path, ignored)) return false;
  try {
    return read_job(path).id == id;
  } catch (const std::invalid_argument&) {
    return false;
  }
}

}  // namespace touchmark::bench::batch
