#include "bench/cli/extra/choose_options.h"

#include <chrono>
#include <optional>
#include <ratio>
#include <stdexcept>
#include <utility>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/options.h"
#include "bench/cli/program.h"
#include "bench/cli/selector_options.h"
#include "bench/support/checked.h"
#include "bench/support/numbers.h"

namespace touchmark::bench::cli {
namespace {

constexpr double max_rate_hz = 100'000;

/// 10% or 0.1.
double checked_share(const std::string& text) {
  const double share = support::parse_share(text);
  if (!(share > 0) || share > 1)
    throw support::bad_value("--share", text, "a part of a tick: above 0 and at most 100%, or 1");
  return share;
}

/// 50MB, 800KB, 2GB or bytes; by thousands, as tables write them.
std::optional<double> checked_memory(const std::string& given) {
  if (given.empty()) return std::nullopt;
  std::string text = given;
  double unit = 1;
  for (const auto& [suffix, bytes] : {std::pair{"KB", 1e3}, std::pair{"MB", 1e6}, std::pair{"GB", 1e9}}) {
    if (!text.ends_with(suffix)) continue;
    text.resize(text.size() - 2);
    unit = bytes;
    break;
  }
  const std::optional<double> value = support::parse_number(text);
  if (!value || !(*value > 0) || *value * unit > 1e15)
    throw support::bad_value("--memory", given, "a size above 0: bytes, or as 800KB, 50MB or 2GB");
  return *value * unit;
}

}  // namespace

experiments::choose::Limits checked_limits(const ChooseOptions& options) {
  return {
      support::checked_number("--rate", options.selectors.motion.rate, support::Zero::refused, max_rate_hz),
      checked_share(options.share), checked_memory(options.memory)};
}

contestants::Selectors checked_selectors(const ChooseOptions& options) {
  contestants::Selectors selectors = options.selectors;
  if (!options.proxy) return selectors;
  if (selectors.query != contestants::Selectors().query && selectors.query != "sweep")
    throw std::invalid_argument(fmt::format(
        "--proxy compares sweeps, not --query {}: leave out --query, or --proxy", selectors.query));
  selectors.query = "sweep";
  return selectors;
}

support::Deadline::duration checked_minutes(const ChooseOptions& options) {
  constexpr double most = 1e6;
  const std::optional<double> minutes = support::parse_number(options.minutes);
  if (!minutes || !(*minutes > 0) || *minutes > most)
    throw support::bad_value("--minutes", options.minutes,
                             fmt::format("a number above 0 and at most {:.0f}", most));
  return std::chrono::duration_cast<support::Deadline::duration>(
      std::chrono::duration<double, std::ratio<60>>(*minutes));
}

void add_choose_options(CLI::App& command, ProgramContext& context, ChooseOptions& options) {
  options.selectors.motion.rate = "1000";
  add_selectors(command, context, options.selectors);
  add_scene_selectors(command, options.selectors);
  add_unit(command, options.selectors.unit);
  command.get_option("--rate")
      ->description("of the servo loop; motion goes by time, so motion files with times are resampled to it")
      ->capture_default_str();
  command.get_option("--trajectory")
      ->description(
          "as --motion, a name (touchmark list), or fast-slide, ten times as fast as slide and not over a "
          "scene of bodies; repeatable; default: hand, approach, hover and cross");
  command.get_option("--detector")
      ->description("a candidate as NAME[:key=value,...]; repeatable; default: ours and the exact rivals");
  add_list(command, "--motion", options.motions, "CSV", "how your hand moves: a motion file; repeatable");
  add_value(command, "--share", options.share, "P%", "the part of a tick that a query may take");
  add_value(command, "--memory", options.memory, "SIZE",
            "what a detector may take, as 50MB; default: any amount");
  add_value(command, "--minutes", options.minutes, "M",
            "how long to measure: what was measured by then is compared, and status 4 says that nothing was");
  add_value(command, "--out", options.out, "DIR",
            "folder for choose.csv, choose.cpp, results.csv and run.json");
  command.add_flag(
      "--proxy", options.proxy,
      "compare detectors that keep to a bound of work by their sweeps, and print a class that steps a proxy");
  command.add_flag("--quick", options.quick, "fewer steps, and fewer queries with emptied caches");
  add_worker_selectors(command, options.workers);
}

}  // namespace touchmark::bench::cli
