#include "bench/batch/manifest.h"

#include <array>
#include <stdexcept>
#include <utility>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/meshes/meshes.h"
#include "bench/results/system_info.h"
#include "bench/results/validation/json_schema.h"
#include "bench/results/validation/located_json.h"
#include "bench/support/files/text_file.h"
#include "bench/support/numbers.h"
#include "bench/trajectories/trajectories.h"
#include "bench/workload/content_hash.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::batch {

namespace validation = results::validation;

namespace {

using Json = nlohmann::ordered_json;

constexpr const char* manifest_form = R"({
  "type": "object", "required": ["schema", "version", "effort", "scenes"],
  "properties": {
    "schema": {"const": 1},
    "version": {"type": "string"},
    "effort": {"enum": ["full", "quick", "accuracy"]},
    "plugins": {"type": "array", "items": {
      "type": "object", "required": ["file", "fnv1a"],
      "properties": {"file": {"type": "string", "minLength": 1},
                     "fnv1a": {"type": "string", "pattern": "^[0-9a-f]{16}$"}}}},
    "scenes": {"type": "array", "minItems": 1, "items": {
      "type": "object",
      "required": ["mesh", "normalize", "mesh_fnv1a", "trajectory", "course_fnv1a", "steps", "seed", "radius", "reach",
                   "query", "jobs"],
      "properties": {
        "mesh": {"type": "string", "minLength": 1},
        "normalize": {"type": "boolean"},
        "mesh_fnv1a": {"type": "string", "pattern": "^[0-9a-f]{16}$"},
        "trajectory": {"type": "string", "minLength": 1},
        "course_fnv1a": {"type": "string", "pattern": "^[0-9a-f]{16}$"},
        "steps": {"type": "integer", "minimum": 1},
        "seed": {"type": "integer", "minimum": 0},
        "radius": {"type": "string", "minLength": 1},
        "reach": {"type": "string"},
        "columns": {"type": "string"},
        "motion_scale": {"type": "string"},
        "rate": {"type": "string"},
        "query": {"enum": ["touches", "nearest", "sweep"]},
        "jobs": {"type": "array", "minItems": 1, "items": {
          "type": "object", "required": ["id", "detector"],
          "properties": {"id": {"type": "string", "pattern": "^[0-9a-f]{16}$"},
                         "detector": {"type": "string", "minLength": 1}}}}
      }}}
  }})";

std::uint64_t hash_in(const nlohmann::json& json) {
  return support::parse_hex(json.get<std::string>()).value();
}

/// The keys of a motion's options, which are there where they were given.
template <class Motion>
auto motion_texts(Motion& motion) {
  return std::array{std::pair{"columns", &motion.columns}, std::pair{"motion_scale", &motion.scale},
                    std::pair{"rate", &motion.rate}};
}

Json json_of(const BatchMesh& planned) {
  Json jobs = Json::array();
  for (const BatchJob& job : planned.jobs) jobs.push_back({{"id", job.id}, {"detector", job.detector}});
  Json json{{"mesh", planned.mesh},
            {"normalize", planned.normalize},
            {"mesh_fnv1a", support::hex(planned.mesh_hash)},
            {"trajectory", planned.trajectory},
            {"course_fnv1a", support::hex(planned.trace_hash)},
            {"steps", planned.steps},
            {"seed", planned.seed},
            {"radius", planned.radius},
            {"reach", planned.reach},
            {"query", workload::name_of(planned.query)},
            {"jobs", jobs}};
  for (const auto& [key, value] : motion_texts(planned.motion))
    if (!value->empty()) json[key] = *value;
  return json;
}

BatchMesh batch_mesh_of(const nlohmann::json& json) {
  BatchMesh planned;
  planned.mesh = json.at("mesh");
  planned.normalize = json.at("normalize");
  planned.mesh_hash = hash_in(json.at("mesh_fnv1a"));
  planned.trajectory = json.at("trajectory");
  planned.trace_hash = hash_in(json.at("course_fnv1a"));
  planned.steps = json.at("steps");
  planned.seed = json.at("seed");
  planned.radius = json.at("radius");
  planned.reach = json.at("reach");
  planned.query = workload::query_named(json.at("query").get<std::string>()).value();
  for (const auto& [key, value] : motion_texts(planned.motion)) *value = json.value(key, "");
  for (const nlohmann::json& job : json.at("jobs"))
    planned.jobs.push_back({job.at("id"), job.at("detector")});
  return planned;
}

}  // namespace

std::string Manifest::json() const {
  Json all = Json::array();
  for (const BatchMesh& planned : meshes) all.push_back(json_of(planned));
  Json json{{"schema", manifest_schema}, {"version", version}, {"effort", effort}};
  for (const BatchPlugin& plugin : plugins)
    json["plugins"].push_back({{"file", plugin.file}, {"fnv1a", support::hex(plugin.hash)}});
  json["scenes"] = all;
  return json.dump(1, ' ', false, Json::error_handler_t::replace) + '\n';
}

Manifest Manifest::read(const std::string& path) {
  static const validation::JsonSchema form(nlohmann::json::parse(manifest_form));
  validation::Faults faults;
  const std::optional<validation::LocatedJson> document = validation::read_located_json(path, faults);
  if (document) form.check(path, *document, faults);
  if (!faults.empty()) throw std::invalid_argument(validation::line_of(faults.front()));
  Manifest manifest{document->value.at("version"), document->value.at("effort"), {}, {}};
  for (const nlohmann::json& plugin : document->value.value("plugins", nlohmann::json::array()))
    manifest.plugins.push_back({plugin.at("file"), hash_in(plugin.at("fnv1a"))});
  for (const nlohmann::json& planned : document->value.at("scenes"))
    manifest.meshes.push_back(batch_mesh_of(planned));
  return manifest;
}

std::size_t Manifest::jobs() const noexcept {
  std::size_t count = 0;
  for (const BatchMesh& planned : meshes) count += planned.jobs.size();
  return count;
}

BatchPlugin plugin_of(const std::string& file) {
  workload::ContentHash hash;
  hash.add(support::read_text_file(file));
  return {file, hash.value()};
}

std::string identity_of(const contestants::ContestantSpec& contestant) {
  if (contestant.plugin.empty()) return contestant.text();
  return contestant.text() + "@" + support::hex(plugin_of(contestant.plugin).hash);
}

std::string job_id(const BatchMesh& planned, const std::string& detector, const std::string& effort,
                   const std::string& version) {
  workload::ContentHash hash;
  for (const std::uint64_t number : {planned.mesh_hash, planned.trace_hash, planned.seed})
    hash.add(support::hex(number));
  for (const std::string& text : {std::string(workload::name_of(planned.query)), detector, effort, version})
    hash.add(text);
  return support::hex(hash.value());
}

measurement::Effort effort_named(const std::string& name) {
  if (name == "full") return {};
  if (name == "quick") return measurement::quick_effort;
  if (name == "accuracy") return measurement::accuracy_effort;
  throw std::invalid_argument(fmt::format("effort \"{}\" is not one of full, quick, accuracy", name));
}

workload::Workload workload_of(const BatchMesh& planned, const contestants::Roster& roster) {
  contestants::Selectors selectors;
  selectors.radius = planned.radius;
  selectors.reach = planned.reach;
  selectors.seed = std::to_string(planned.seed);
  selectors.steps = std::to_string(planned.steps);
  if (!trajectories::is_generated(planned.trajectory)) selectors.motion = planned.motion;
  return workload::make_workload(results::without_directories(planned.mesh),
                                 meshes::load_mesh(planned.mesh, planned.normalize),
                                 contestants::check(selectors, roster), {planned.trajectory}, planned.steps);
}

}  // namespace touchmark::bench::batch
