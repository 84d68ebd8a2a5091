#include "bench/repeat_command.h"

#include <algorithm>
#include <string_view>

#include <fmt/format.h>

#include "bench/query_name.h"

namespace touchmark::bench {

std::string quoted(const std::string& word) {
  constexpr std::string_view harmless =
      "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_./:,=+@%";
  if (!word.empty() && word.find_first_not_of(harmless) == std::string::npos) return word;
  std::string text = "'";
  for (const char character : word) text += character == '\'' ? "'\\''" : std::string(1, character);
  return text + '\'';
}

std::string repeat_command(const Selectors& selectors, const std::string& mesh,
                           const std::vector<std::string>& trajectories, const Workload& workload,
                           const ResultRow& row) {
  const auto found = std::find(workload.trajectories.begin(), workload.trajectories.end(), row.trajectory);
  if (found == workload.trajectories.end()) return "";
  const auto course = static_cast<std::size_t>(found - workload.trajectories.begin());
  std::string command =
      fmt::format("touchmark query --mesh {}{} --trajectory {} --detector {} --query {} --radius {}",
                  quoted(mesh), selectors.normalize ? " --normalize" : "", quoted(trajectories[course]),
                  quoted(row.contestant()), name_of(row.query), quoted(selectors.radius));
  const auto add = [&](const char* option, const std::string& value) {
    if (!value.empty()) command += fmt::format(" {} {}", option, quoted(value));
  };
  add("--reach", selectors.reach);
  add("--columns", selectors.motion.columns);
  add("--motion-scale", selectors.motion.scale);
  add("--rate", selectors.motion.rate);
  return command +
         fmt::format(" --steps {} --seed {} --step ", workload.courses[course].size(), selectors.seed);
}

}  // namespace touchmark::bench
