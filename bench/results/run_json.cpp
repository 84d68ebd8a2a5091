#include "bench/results/run_json.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <unistd.h>

#include "bench/contestants/tick_clock.h"
#include "bench/measurement/piece_times.h"
#include "bench/results/build_info.h"
#include "bench/results/results_csv.h"
#include "bench/results/run_circumstances.h"
#include "bench/support/numbers.h"
#include "bench/support/system/cpu_quota.h"
#include "bench/workload/content_hash.h"
#include "bench/workload/query_name.h"
#include "core/simd/dispatch.h"

namespace touchmark::bench::results {
namespace {

using Json = nlohmann::ordered_json;

/// JSON has no infinity.
Json number(double value) { return std::isfinite(value) ? Json(value) : Json(fmt::format("{}", value)); }

Json libraries() {
  Json json = Json::object();
  for (const LibraryVersion& library : library_versions()) json[library.name] = library.version;
  return json;
}

const char* name_of(Simd simd) {
  switch (simd) {
    case Simd::avx512:
      return "avx512";
    case Simd::avx2:
      return "avx2";
    default:
      return "portable";
  }
}

Json mesh_json(const workload::Workload& workload) {
  Json json = {{"name", workload.mesh_name},
               {"vertices", workload.mesh.vertices().size()},
               {"triangles", workload.triangles()},
               {"diagonal", workload.mesh.diagonal()},
               {"fnv1a", support::hex(workload::hash_of(workload.mesh))}};
  if (workload.scene) json["bodies"] = workload.scene->bodies.size();
  return json;
}

/// A file's own times, and speeds where the unit is known.
void add_motion(Json& json, const workload::Pace& motion, const std::optional<support::LengthUnit>& unit) {
  if (motion.recorded) {
    json["rows"] = motion.recorded->rows;
    json["duration_s"] = motion.recorded->duration_s;
    if (const auto rate = motion.recorded->rate_hz()) json["rate_hz"] = number(*rate);
    if (motion.recorded->resampled_hz) json["resampled_hz"] = *motion.recorded->resampled_hz;
  }
  if (unit) {
    json["mean_speed_m_per_s"] = number(motion.mean_speed * unit->metres);
    json["max_speed_m_per_s"] = number(motion.max_speed * unit->metres);
  }
}

Json trajectories_json(const workload::Workload& workload) {
  Json json = Json::array();
  for (std::size_t i = 0; i < workload.trajectories.size(); ++i) {
    json.push_back({{"name", workload.trajectories[i]}, {"steps", workload.traces[i].size()}});
    if (i < workload.motions.size()) add_motion(json.back(), workload.motions[i], workload.unit);
  }
  return json;
}

Json contestants_json(const std::deque<workers::ContestantProcess>& contestants) {
  Json json = Json::array();
  for (const workers::ContestantProcess& contestant : contestants)
    json.push_back(contestant_json(contestant.spec(), contestant.opened().flushed_to_zero));
  return json;
}

Json clock_json(const std::deque<workers::ContestantProcess>& contestants) {
  workers::Opened typical;
  for (const workers::ContestantProcess& contestant : contestants)
    if (contestant.opened().clock_cost_ns > 0) typical = contestant.opened();
  return {{"name", contestants::TickClock::name},
          {"cost_ns", typical.clock_cost_ns},
          {"ns_per_tick", typical.ns_per_tick},
          {"note", "each step's latency includes one reading of the clock"}};
}

Json asked_json(const RunDescription& run, const workload::Workload& workload,
                const std::deque<workers::ContestantProcess>& contestants) {
  Json json{{"contestants", Json::array()},
            {"trajectories", workload.trajectories},
            {"queries", {workload::name_of(run.query)}},
            {"left_out", Json::array()}};
  for (const workers::ContestantProcess& contestant : contestants)
    json["contestants"].push_back(contestant.spec().text());
  for (const auto& [trajectory, contestant] : run.left_out)
    json["left_out"].push_back({{"trajectory", trajectory}, {"contestant", contestant}});
  return json;
}

Json steadiness_json(const std::vector<measurement::Steadiness>& all) {
  Json json = Json::array();
  for (const measurement::Steadiness& one : all) {
    Json entry{{"mesh", one.mesh},
               {"trajectory", one.trajectory},
               {"query", workload::name_of(one.query)},
               {"disturbed_share", one.disturbed_share},
               {"conclusive", one.conclusive()}};
    if (one.control)
      entry["control"] = {{"contestant", one.control->contestant},
                          {"ratio", one.control->ratio},
                          {"ratio_low", one.control->low},
                          {"ratio_high", one.control->high}};
    json.push_back(std::move(entry));
  }
  return json;
}

Json effort_json(const measurement::Effort& effort) {
  return {{"repetitions", effort.repetitions},
          {"repetition_ms", effort.repetition_ns / 1e6},
          {"pass_budget_ms", effort.pass_budget_ns / 1e6},
          {"latency_passes", effort.latency_passes},
          {"latency_note", "percentiles are of each step's median over the passes"},
          {"cold_samples", effort.cold_passes > 0 ? effort.cold_samples : 0},
          {"cold_l2_samples", effort.cold_passes > 0 ? effort.cold_l2_samples : 0},
          {"cold_budget_ms", effort.cold_passes > 0 ? effort.cold_budget_ns / 1e6 : 0},
          {"undisturbed_quantile", measurement::PieceTimes::quantile}};
}

}  // namespace

Json contestant_json(const contestants::ContestantSpec& spec, bool flushed_to_zero) {
  return {{"name", spec.name},
          {"written_options", spec.options},
          {"options", spec.values.all()},
          {"flushed_to_zero", flushed_to_zero}};
}

Json run_circumstances(const RunDescription& run) {
  const BuildInfo& build = build_info();
  std::vector<std::string> arguments = run.arguments;
  std::transform(arguments.begin(), arguments.end(), arguments.begin(), without_directories);
  Json json{{"schema", results_schema},
            {"run_id", run.run_id},
            {"date", run.system.date},
            {"finished", run.finished},
            {"version", build.version},
            {"commit", build.commit},
            {"compiler", build.compiler},
            {"flags", build.flags},
            {"build_type", build.build_type},
            {"native", build.native},
            {"cpu", run.system.cpu_model},
            {"simd", name_of(widest_simd())},
            {"cores", run.system.cores},
            {"governor", run.system.governor},
            {"load_average", run.system.load_average},
            {"workers_core", run.core ? Json(*run.core) : Json("any")},
            {"flushed_to_zero", run.flushed_to_zero},
            {"libraries", libraries()},
            {"seed", run.seed},
            {"command_line", arguments}};
  if (const auto quota = support::cpu_quota())
    json["cpu_quota"] = {
        {"cores", quota->cores()}, {"quota_us", quota->quota_us}, {"period_us", quota->period_us}};
  return json;
}

RunDescription begun_run(int argc, const char* const* argv) {
  RunDescription run;
  run.system = system_info();
  run.run_id = new_run_id(run.system);
  run.arguments = {argv + 1, argv + argc};
  return run;
}

std::string run_json(const RunDescription& run, const workload::Workload& workload,
                     const std::deque<workers::ContestantProcess>& contestants) {
  Json json = run_circumstances(run);
  json["mesh"] = mesh_json(workload);
  if (workload.unit) json["unit"] = workload.unit->name;
  json["query"] = workload::name_of(run.query);
  json["radius"] = number(workload.radius);
  json["reach"] = workload.reach ? number(*workload.reach) : Json("radius");
  json["trajectories"] = trajectories_json(workload);
  json["clock"] = clock_json(contestants);
  json["effort"] = effort_json(run.effort);
  json["contestants"] = contestants_json(contestants);
  json["asked"] = asked_json(run, workload, contestants);
  json["steadiness"] = steadiness_json(run.steadiness);
  return json.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string joined_run_json(const std::vector<std::string>& runs, bool finished) {
  Json joined = Json::parse(runs.front());
  Json meshes = Json::array(), steadiness = Json::array();
  for (const std::string& text : runs) {
    const Json run = Json::parse(text);
    Json mesh = run.at("mesh");
    mesh["radius"] = run.at("radius");
    mesh["reach"] = run.at("reach");
    meshes.push_back(std::move(mesh));
    for (const Json& steady : run.at("steadiness")) steadiness.push_back(steady);
  }
  joined["finished"] = finished;
  joined["meshes"] = std::move(meshes);
  joined["steadiness"] = std::move(steadiness);
  return joined.dump(2, ' ', false, Json::error_handler_t::replace) + '\n';
}

std::string new_run_id(const SystemInfo& system) {
  std::string id;
  std::copy_if(system.date.begin(), system.date.end(), std::back_inserter(id),
               [](char c) { return c != '-' && c != ':'; });
  return fmt::format("{}-{:04x}", id, static_cast<unsigned>(getpid()) & 0xffffU);
}

}  // namespace touchmark::bench::results
