/// `touchmark list`: what can be chosen: contestants, scenes, trajectories.
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/plugin_option.h"
#include "bench/cli/program.h"
#include "bench/contestants/roster.h"
#include "bench/meshes/meshes.h"
#include "bench/scenes/generated_bodies.h"
#include "bench/support/files/standard_output.h"
#include "bench/trajectories/trajectories.h"
#include "bench/workload/query_name.h"

namespace touchmark::bench::cli {
namespace {

std::string description_of(const contestants::OptionInfo& option) {
  const std::string values = option.kind == contestants::OptionKind::choice
                                 ? fmt::format("{}", fmt::join(option.choices, "|"))
                             : option.kind == contestants::OptionKind::length ? "LENGTH"
                                                                              : "NUMBER";
  return fmt::format("      {}={}  (default {})  {}\n", option.key, values, option.default_value,
                     option.summary);
}

std::string description_of(const contestants::ContestantInfo& contestant) {
  std::vector<std::string_view> queries;
  for (const workload::Query query : contestant.queries) queries.push_back(workload::name_of(query));
  std::string text = fmt::format("  {}{}\n      {}\n", contestant.name,
                                 contestant.built() ? "" : "  (not built)", contestant.summary);
  if (!contestant.built()) return text;
  text += fmt::format("      answers {}; {}{}\n", fmt::join(queries, ", "), contestant.accuracy,
                      contestant.build_scene ? "; takes scenes of bodies" : "");
  for (const contestants::OptionInfo& option : contestant.options) text += description_of(option);
  for (const contestants::FormerName& former : contestant.former_names)
    text += fmt::format("  {}  (a former name: {}; {} have no effect)\n", former.name, contestant.name,
                        fmt::join(former.dead_options, ", "));
  return text;
}

std::string list(const contestants::Roster& roster) {
  std::string text = "contestants: --detector NAME[:key=value,...]\n";
  for (const contestants::ContestantInfo& contestant : roster.contestants())
    text += description_of(contestant);
  text += "\nscenes: --mesh NAME[@scale=S][@offset=O][@normalize], or a mesh file\n";
  for (const meshes::NamedMesh& named : meshes::named_meshes())
    text += fmt::format("  {:<28}{}{}\n", named.name, named.description,
                        named.available ? "" : "  (not installed)");
  text +=
      "\nscenes of bodies: --scene NAME[:motion=M], a .json or .urdf file, or any file with a node tree\n";
  for (const scenes::BodySceneInfo& scene : scenes::body_scenes())
    text += fmt::format("  {:<28}{}\n", scene.name, scene.description);
  for (const scenes::BodySceneInfo& motion : scenes::body_motions())
    text += fmt::format("  {:<28}{}\n", ":motion=" + motion.name, motion.description);
  text +=
      "\ntrajectories: --trajectory NAME, or a motion file: CSV with columns x,y,z and perhaps time_s, "
      "radius\n";
  for (const trajectories::TrajectoryInfo& trajectory : trajectories::trajectories()) {
    const std::string name =
        trajectory.name + (trajectory.own_percent > 0 ? "[:speed=S%]" : trajectory.words);
    text += name.size() < 28 ? fmt::format("  {:<28}{}\n", name, trajectory.description)
                             : fmt::format("  {}\n  {:<28}{}\n", name, "", trajectory.description);
  }
  return text;
}

}  // namespace

void add_list(CLI::App& program, ProgramContext& context) {
  CLI::App* command = add_command(program, "list");
  add_plugins(*command, context, nullptr);
  command->footer("Example: touchmark list\n");
  command->final_callback([&context] { support::StandardOutput().write(list(context.roster)); });
}

}  // namespace touchmark::bench::cli
