#include "bench/workers/worker_protocol.h"

#include <bit>
#include <vector>

#include <nlohmann/json.hpp>

namespace touchmark::bench {
namespace {

// JSON has no infinity, so doubles that may be infinite travel as their bits.
std::uint64_t bits(double value) { return std::bit_cast<std::uint64_t>(value); }
double from_bits(const nlohmann::json& json) { return std::bit_cast<double>(json.get<std::uint64_t>()); }

nlohmann::json work_json(const Work& work) {
  return {{"cells", work.cells},
          {"spheres", work.spheres},
          {"boxes", work.boxes},
          {"triangles", work.triangles},
          {"exact_decisions", work.exact_decisions}};
}

Work work_from(const nlohmann::json& json) {
  Work work;
  json.at("cells").get_to(work.cells);
  json.at("spheres").get_to(work.spheres);
  json.at("boxes").get_to(work.boxes);
  json.at("triangles").get_to(work.triangles);
  json.at("exact_decisions").get_to(work.exact_decisions);
  return work;
}

}  // namespace

void to_json(nlohmann::json& json, const Task& task) {
  std::vector<std::size_t> windows;
  for (const Window& window : task.windows) windows.insert(windows.end(), {window.begin, window.end});
  json = {{"course", task.course},
          {"query", static_cast<std::uint32_t>(task.query)},
          {"steps", task.steps},
          {"windows", windows}};
}

void from_json(const nlohmann::json& json, Task& task) {
  json.at("course").get_to(task.course);
  task.query = static_cast<Query>(json.at("query").get<std::uint32_t>());
  json.at("steps").get_to(task.steps);
  const auto windows = json.at("windows").get<std::vector<std::size_t>>();
  task.windows.clear();
  for (std::size_t i = 0; i + 1 < windows.size(); i += 2)
    task.windows.push_back({windows[i], windows[i + 1]});
}

void to_json(nlohmann::json& json, const Opened& opened) {
  json = {{"clock_cost_ns", opened.clock_cost_ns},
          {"ns_per_tick", opened.ns_per_tick},
          {"flushed_to_zero", opened.flushed_to_zero}};
}

void from_json(const nlohmann::json& json, Opened& opened) {
  json.at("clock_cost_ns").get_to(opened.clock_cost_ns);
  json.at("ns_per_tick").get_to(opened.ns_per_tick);
  json.at("flushed_to_zero").get_to(opened.flushed_to_zero);
}

void to_json(nlohmann::json& json, const Built& built) {
  std::vector<std::uint32_t> queries;
  for (const Query query : built.queries) queries.push_back(static_cast<std::uint32_t>(query));
  json = {{"refused", built.refused},
          {"build_ms", built.build_ms},
          {"bytes", built.bytes},
          {"heap_bytes", built.heap_bytes},
          {"guarantee", static_cast<int>(built.accuracy.guarantee)},
          {"relative", bits(built.accuracy.relative)},
          {"absolute", bits(built.accuracy.absolute)},
          {"decides_exactly", built.accuracy.decides_exactly},
          {"names_exactly", built.accuracy.names_exactly},
          {"queries", queries},
          {"prepares", built.prepares},
          {"makes_later", built.builds_lazily}};
}

void from_json(const nlohmann::json& json, Built& built) {
  json.at("refused").get_to(built.refused);
  json.at("build_ms").get_to(built.build_ms);
  json.at("bytes").get_to(built.bytes);
  json.at("heap_bytes").get_to(built.heap_bytes);
  built.accuracy = {static_cast<Guarantee>(json.at("guarantee").get<int>()), from_bits(json.at("relative")),
                    from_bits(json.at("absolute")), json.at("decides_exactly").get<bool>(),
                    json.at("names_exactly").get<bool>()};
  built.queries.clear();
  for (const nlohmann::json& query : json.at("queries")) {
    built.queries.push_back(static_cast<Query>(query.get<std::uint32_t>()));
  }
  json.at("prepares").get_to(built.prepares);
  json.at("makes_later").get_to(built.builds_lazily);
}

void to_json(nlohmann::json& json, const Answered& answered) {
  json = {{"checksum", answered.checksum}, {"work", work_json(answered.work)}};
}

void from_json(const nlohmann::json& json, Answered& answered) {
  json.at("checksum").get_to(answered.checksum);
  answered.work = work_from(json.at("work"));
}

void to_json(nlohmann::json& json, const Timed& timed) {
  json = {{"ns_per_query", timed.ns_per_query}, {"cpu_ns_per_query", timed.cpu_ns_per_query},
          {"checksum", timed.checksum},         {"steady", timed.steady},
          {"work", work_json(timed.work)},      {"samples", timed.samples},
          {"interrupted", timed.interrupted}};
}

void from_json(const nlohmann::json& json, Timed& timed) {
  json.at("ns_per_query").get_to(timed.ns_per_query);
  json.at("cpu_ns_per_query").get_to(timed.cpu_ns_per_query);
  json.at("checksum").get_to(timed.checksum);
  json.at("steady").get_to(timed.steady);
  timed.work = work_from(json.at("work"));
  json.at("samples").get_to(timed.samples);
  json.at("interrupted").get_to(timed.interrupted);
}

void to_json(nlohmann::json& json, const Updated& updated) {
  json = {{"supported", updated.supported}, {"refused", updated.refused},
          {"rounds", updated.rounds},       {"build_ms", updated.build_ms},
          {"update_ms", updated.update_ms}, {"update_over_build", updated.update_over_build}};
}

void from_json(const nlohmann::json& json, Updated& updated) {
  json.at("supported").get_to(updated.supported);
  json.at("refused").get_to(updated.refused);
  json.at("rounds").get_to(updated.rounds);
  json.at("build_ms").get_to(updated.build_ms);
  json.at("update_ms").get_to(updated.update_ms);
  json.at("update_over_build").get_to(updated.update_over_build);
}

}  // namespace touchmark::bench
