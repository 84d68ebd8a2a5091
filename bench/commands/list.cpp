/// `touchmark list`: what can be chosen: contestants, scenes, trajectories.
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/program.h"
#include "bench/query_name.h"
#include "bench/scenes.h"
#include "bench/trajectories.h"

namespace touchmark::bench {
namespace {

void print_option(const OptionInfo& option) {
  const std::string values = option.kind == OptionKind::choice
                                 ? fmt::format("{}", fmt::join(option.choices, "|"))
                             : option.kind == OptionKind::length ? "LENGTH"
                                                                 : "NUMBER";
  fmt::print("      {}={}  (default {})  {}\n", option.key, values, option.default_value, option.summary);
}

void print_contestant(const ContestantInfo& contestant) {
  std::vector<std::string_view> queries;
  for (const Query query : contestant.queries) queries.push_back(name_of(query));
  fmt::print("  {}{}\n", contestant.name, contestant.built() ? "" : "  (not built)");
  fmt::print("      {}\n", contestant.summary);
  if (!contestant.built()) return;
  fmt::print("      answers {}; {}\n", fmt::join(queries, ", "), contestant.accuracy);
  for (const OptionInfo& option : contestant.options) print_option(option);
}

void list(const Roster& roster) {
  fmt::print("contestants: --detector NAME[:key=value,...]\n");
  for (const ContestantInfo& contestant : roster.contestants()) print_contestant(contestant);
  fmt::print("\nscenes: --mesh NAME[@scale=S][@offset=O][@normalize], or a mesh file\n");
  for (const SceneInfo& scene : scenes()) {
    fmt::print("  {:<28}{}{}\n", scene.name, scene.description, scene.available ? "" : "  (not installed)");
  }
  fmt::print(
      "\ntrajectories: --trajectory NAME, or a CSV file with columns x,y,z and perhaps time_s, radius\n");
  for (const TrajectoryInfo& trajectory : trajectories()) {
    fmt::print("  {:<28}{}\n", trajectory.name, trajectory.description);
  }
}

}  // namespace

void add_list(CLI::App& program, ProgramContext& context) {
  CLI::App* command = program.add_subcommand("list", "what can be chosen: contestants, scenes, trajectories");
  command->footer("Example: touchmark list\n");
  command->final_callback([&context] { list(context.roster); });
}

}  // namespace touchmark::bench
