#include "bench/cli/repeat_command.h"

#include <algorithm>

#include <fmt/format.h>

#include "bench/support/shell_word.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::cli {

std::string repeat_command(const contestants::Selectors& selectors, const std::string& mesh,
                           const std::vector<std::string>& trajectories, const workload::Workload& workload,
                           const measurement::ResultRow& row) {
  const auto found = std::ranges::find(workload.trajectories, row.trajectory);
  if (found == workload.trajectories.end()) return "";
  const auto trace = static_cast<std::size_t>(found - workload.trajectories.begin());
  const std::string where =
      selectors.scene.empty()
          ? fmt::format("--mesh {}{}", support::quoted(mesh), selectors.normalize ? " --normalize" : "")
          : fmt::format("--scene {}", support::quoted(selectors.scene));
  std::string command = fmt::format("touchmark query {} --trajectory {} {} --query {} --radius {}", where,
                                    support::quoted(trajectories[trace]), row.as_typed(),
                                    workload::name_of(row.query), support::quoted(selectors.radius));
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) command += fmt::format(" {} {}", option, support::quoted(value));
  };
  add("--poses", selectors.poses);
  for (const std::string& package : selectors.packages) add("--package", package);
  add("--reach", selectors.reach);
  add("--columns", selectors.motion.columns);
  add("--motion-scale", selectors.motion.scale);
  add("--rate", selectors.motion.rate);
  add("--drape", selectors.motion.drape);
  if (!selectors.motion.drape.empty() || row.trajectory.starts_with("hand")) add("--unit", selectors.unit);
  return command +
         fmt::format(" --steps {} --seed {} --step ", workload.traces[trace].size(), selectors.seed);
}

}  // namespace touchmark::bench::cli
