#include "bench/cli/repeat_command.h"

#include <algorithm>

#include <fmt/format.h>

#include "bench/support/shell_word.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench {

std::string repeat_command(const Selectors& selectors, const std::string& mesh,
                           const std::vector<std::string>& trajectories, const Workload& workload,
                           const ResultRow& row) {
  const auto found = std::find(workload.trajectories.begin(), workload.trajectories.end(), row.trajectory);
  if (found == workload.trajectories.end()) return "";
  const auto trace = static_cast<std::size_t>(found - workload.trajectories.begin());
  std::string command =
      fmt::format("touchmark query --mesh {}{} --trajectory {} --detector {} --query {} --radius {}",
                  quoted(mesh), selectors.normalize ? " --normalize" : "", quoted(trajectories[trace]),
                  quoted(row.contestant()), name_of(row.query), quoted(selectors.radius));
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) command += fmt::format(" {} {}", option, quoted(value));
  };
  add("--reach", selectors.reach);
  add("--columns", selectors.motion.columns);
  add("--motion-scale", selectors.motion.scale);
  add("--rate", selectors.motion.rate);
  return command +
         fmt::format(" --steps {} --seed {} --step ", workload.traces[trace].size(), selectors.seed);
}

}  // namespace touchmark::bench
