#include "bench/cli/extra/servo_options.h"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <optional>
#include <stdexcept>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <sched.h>

#include "bench/cli/options.h"
#include "bench/cli/program.h"
#include "bench/cli/selector_options.h"
#include "bench/experiments/servo/load.h"
#include "bench/experiments/servo/servo_csv.h"
#include "bench/proxies/methods.h"
#include "bench/results/system_info.h"
#include "bench/support/checked.h"
#include "bench/support/numbers.h"
#include "core/detector.h"

namespace touchmark::bench::cli {

namespace servo = experiments::servo;

namespace {

constexpr double max_servo_rate_hz = 100'000;
constexpr double max_s = 1e6;

/// Returns the load of this name; without a name that on memory, where another core can carry it.
servo::Load checked_load(const std::string& text, int core) {
  const bool is_alone = servo::other_cores(core).empty();
  if (text.empty()) return is_alone ? servo::Load::none : servo::Load::memory;
  const std::optional<servo::Load> load = servo::load_named(text);
  if (!load) throw support::bad_value("--load", text, "one of none, memory, cpu");
  if (*load != servo::Load::none && is_alone)
    throw std::invalid_argument(
        fmt::format("--load {}: there is no other core that this program may use", text));
  return *load;
}

/// Workers have our proxy; those of the suite, which notes what it compares, are not made for a loop.
void check_method(const std::string& method) {
  if (method.empty() || proxies::method_named(method).text() == servo::own_proxy) return;
  throw std::invalid_argument(fmt::format(
      "--method \"{}\": servo steps {} alone; touchmark proxy compares all", method, servo::own_proxy));
}

void add_proxy_options(CLI::App& command, ServoOptions& options) {
  CLI::Option* stepped = command.add_flag(
      "--proxy", options.proxy,
      "a tick is the whole step of a proxy (touchmark proxy) that follows the trajectory, and not a query");
  for (const char* other : {"--query", "--reach"}) stepped->excludes(command.get_option(other));
  add_value(command, "--method", options.method, "M",
            "with --proxy: certified, the only one that servo steps")
      ->needs(stepped);
  add_coupling(command, options.coupling);
  add_value(command, "--max-work", options.max_work, "N",
            "what a step of a proxy looks at, at most, 64 for each exact decision; 0: no bound");
  for (const char* name : {"--stiffness", "--friction", "--damping", "--shading", "--max-work"})
    command.get_option(name)->needs(stepped);
  command.get_option("--shading")->excludes(command.get_option("--scene"));
}

}  // namespace

int checked_core(const ServoOptions& options) {
  const std::string& text = options.cpu;
  if (text.empty()) return results::core_for_workers().value_or(sched_getcpu());
  const std::optional<std::uint64_t> core = support::parse_count(text);
  cpu_set_t allowed;
  if (!core || *core >= CPU_SETSIZE || sched_getaffinity(0, sizeof allowed, &allowed) != 0 ||
      !CPU_ISSET(static_cast<std::size_t>(*core), &allowed))
    throw std::invalid_argument(fmt::format("--cpu \"{}\" is no core that this program may use", text));
  return static_cast<int>(*core);
}

servo::ServoSettings checked_settings(const ServoOptions& options, int core) {
  servo::ServoSettings settings;
  settings.rate_hz = support::checked_number("--rate", options.selectors.motion.rate, support::Zero::refused,
                                             max_servo_rate_hz);
  const double seconds = support::checked_number("--seconds", options.seconds, support::Zero::refused, max_s);
  settings.evicts = options.evict;
  settings.ticks =
      static_cast<std::uint64_t>(std::max(std::round(seconds * settings.rate_hz / settings.slowdown()), 1.0));
  settings.work_us = support::checked_number("--work", options.work_us, support::Zero::allowed, 1e6);
  settings.load = checked_load(options.load, core);
  if (options.proxy) {
    check_method(options.method);
    settings.proxy = checked_coupling(options.coupling);
    settings.proxy->tick_s = 1 / settings.rate_hz;
    settings.proxy->max_work =
        support::checked_count("--max-work", options.max_work, 0, LimitedWork::unlimited);
  }
  return settings;
}

std::string checked_trajectory(const ServoOptions& options) {
  const std::vector<std::string>& names = options.selectors.trajectories;
  if (names.size() > 1)
    throw std::invalid_argument(
        fmt::format("--trajectory \"{}\" is one too many: servo takes one", names[1]));
  return names.empty() ? "hand" : names.front();
}

void add_servo_options(CLI::App& command, ProgramContext& context, ServoOptions& options) {
  options.selectors.motion.rate = "1000";
  options.selectors.detectors = {"sphere-cluster"};
  add_selectors(command, context, options.selectors);
  add_scene_selectors(command, options.selectors);
  command.get_option("--detector")->capture_default_str();
  command.get_option("--trajectory")
      ->description(
          "a name (touchmark list), as hand:tap, or a motion file, CSV with columns x,y,z; default: hand");
  command.get_option("--rate")
      ->description("of the loop; motion goes by time, so motion files with times are resampled to it")
      ->capture_default_str();
  command.get_option("--steps")->description(
      "of the trajectory, which is followed to and fro; default: a tick each, at most 20000");
  add_value(command, "--seconds", options.seconds, "S",
            "of each detector's ticks; its idle loop takes as long again");
  add_value(command, "--load", options.load, "LOAD",
            "what the other cores do meanwhile: none, memory or cpu; default: memory, or none where there is "
            "no other core");
  command.add_flag("--evict", options.evict,
                   "empty all caches before each tick, out of its time; a tick comes every 20 periods then");
  add_value(command, "--work", options.work_us, "US", "other work a tick on the same core, after the answer");
  add_proxy_options(command, options);
  add_value(command, "--cpu", options.cpu, "N", "the core of the loop; default: the last");
  add_unit(command, options.selectors.unit);
  add_value(command, "--out", options.out, "DIR",
            "folder for servo.csv and run.json; scripts/plot draws them");
  add_worker_selectors(command, options.workers);
}

}  // namespace touchmark::bench::cli
