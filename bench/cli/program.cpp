#include "bench/cli/program.h"

#include <algorithm>
#include <cstdio>
#include <new>
#include <sstream>
#include <string>
#include <string_view>
#include <system_error>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <unistd.h>

#include "bench/results/build_info.h"
#include "bench/support/did_you_mean.h"
#include "bench/support/files/standard_descriptors.h"
#include "bench/support/files/standard_output.h"
#include "bench/support/system/beside_this_program.h"
#include "bench/support/system/system_limit.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::cli {
namespace {

struct CommandText {
  std::string_view group, name, summary;
};

constexpr std::string_view first = "To begin with", answers = "Answers", studies = "Studies",
                           batch = "CI, batches and plug-ins";

// All commands in the order of the help.
constexpr CommandText command_texts[] = {
    {first, "bench", "verify and time contestants on identical trajectories"},
    {first, "choose", "which detector, with which options, for this part on this machine?"},
    {first, "servo", "a paced loop as a device runs it: does a detector hold the rate?"},
    {first, "mesh", "what a mesh is like, and finer ones: info, measure, subdivide"},
    {first, "list", "what can be chosen: contestants, meshes, scenes, trajectories"},
    {answers, "query", "one contestant's answer to every step of a trajectory, as CSV"},
    {answers, "verify", "check contestants' answers against the exact oracle"},
    {answers, "audit", "does an engine keep to a mesh's shape, or take it for its convex hull?"},
    {answers, "stress", "hard questions of many kinds, every answer against the exact oracle"},
    {answers, "proxy", "which haptic proxy crosses the surface? every way is replayed by the exact oracle"},
    {studies, "scale", "how build, memory and query time grow with the mesh"},
    {studies, "update", "what it costs that the mesh changes its shape, against building anew"},
    {studies, "many", "many points asked at once: a scan, or a pointshell each tick"},
    {studies, "tune", "the subdivision level and clustering that hold a rate at the least geometric error"},
    {studies, "paper", "a paper's experiment, beside the numbers it prints"},
    {batch, "gate", "fail when a detector has become slower, against a reference measured in the same run"},
    {batch, "plan", "write down a sweep: every mesh, trajectory, query and parameter with every detector"},
    {batch, "run", "run one shard of a planned sweep"},
    {batch, "merge", "make one results CSV of the jobs of a sweep"},
    {batch, "validate", "check recorded results: CSV files, run.json, steps.bin and visited.json"},
    {batch, "new-plugin", "write an example of a contestant of your own"},
};

struct OptionGroup {
  std::string_view name, options;  ///< Options are listed between spaces.
};

constexpr OptionGroup option_groups[] = {
    {"Mesh and motion",
     " --mesh --normalize --scene --poses --package --unit --trajectory --columns --motion-scale --rate "
     "--drape --steps --seed "},
    {"Query", " --query --radius --reach "},
    {"Detectors", " --detector --plugin --frontier --timeout --worker-output "},
    {"Output", " --out --reproduce --steps-out --csv --json --markdown --junit --manifest --trace --wide "}};

/// Groups the options in the help of a command, and of its subcommands, if there are at least twelve.
void group_options(CLI::App& command) {
  for (CLI::App* part : command.get_subcommands(nullptr)) group_options(*part);
  const std::vector<CLI::Option*> options = command.get_options();
  if (options.size() < 12) return;
  for (CLI::Option* option : options) {
    if (option->get_positional()) continue;
    const auto group = std::ranges::find_if(option_groups, [&](const OptionGroup& one) {
      return one.options.find(" --" + option->get_lnames().front() + " ") != std::string_view::npos;
    });
    if (group != std::end(option_groups)) option->group(std::string(group->name));
  }
}

/// Adds the commands that are here, and the others by name alone.
void add_commands(CLI::App& program, ProgramContext& context) {
  for (const CommandText& text : command_texts) {
    const auto here = std::ranges::find(context.parts.commands, text.name, &Command::name);
    if (here != context.parts.commands.end()) {
      here->add(program, context);
      group_options(*program.get_subcommand(std::string(text.name)));
    } else if (context.argc > 1 && text.name == context.argv[1]) {
      continue_in_extra_program(context);
    } else {
      add_command(program, text.name);
    }
  }
}

/// One line whatever the library or a file put into it.
std::string one_line(std::string text) {
  while (!text.empty() && text.back() == '\n') text.pop_back();
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

int fail(int status, std::string_view what) {
  // A line that cannot be written is given up: there is nobody to tell.
  const std::string line = fmt::format("touchmark: {}\n", one_line(std::string(what)));
  std::fwrite(line.data(), 1, line.size(), stderr);
  return status;
}

std::string complaint_about_command(const CLI::App& program) {
  std::vector<std::string> names;
  for (const CLI::App* command : program.get_subcommands(nullptr)) names.push_back(command->get_name());
  const std::vector<std::string> words = program.remaining();
  return fmt::format("unknown command \"{}\"; the nearest names: {}", words.front(),
                     support::near_names(words.front(), names));
}

/// A command that takes a mesh alone says so of a scene, not only that it knows no such argument.
std::string complaint_about_arguments(const std::string& error, const ProgramContext& context) {
  for (const std::string_view of_scenes : {"--scene", "--poses", "--package"})
    if (error.find(of_scenes) != std::string::npos && error.find("not expected") != std::string::npos &&
        context.argc > 1)
      return fmt::format(
          "{} takes a mesh alone: {} is of query, verify, bench, servo, gate and choose (touchmark --help)",
          context.argv[1], of_scenes);
  return fmt::format("{} (touchmark --help)", error);
}

int parse_and_run(CLI::App& program, ProgramContext& context) {
  try {
    program.parse(context.argc, context.argv);
  } catch (const CLI::Success& asked) {  // for help or the version
    std::ostringstream text;
    program.exit(asked, text, text);
    support::StandardOutput().write(text.str());
    return support::exit_done;
  } catch (const CLI::ParseError& error) {
    return fail(support::exit_bad_input, complaint_about_arguments(one_line(error.what()), context));
  }
  if (program.get_subcommands().empty() && program.remaining().empty()) {
    std::fputs(
        "touchmark finds out which collision detector can serve a haptic loop on your mesh. Begin with one "
        "of\n"
        "  touchmark bench --mesh part.stl    compares detectors: answers, times, memory\n"
        "  touchmark choose --mesh part.stl   recommends one, and prints its code\n"
        "  touchmark servo --mesh part.stl    tests a paced loop at 1 kHz\n"
        "  touchmark mesh info part.stl       measures a mesh\n"
        "  touchmark list                     names detectors, meshes and trajectories\n"
        "touchmark --help names all commands.\n",
        stderr);
    return support::exit_bad_input;
  }
  if (program.get_subcommands().empty())
    return fail(support::exit_bad_input, complaint_about_command(program));
  return context.status;
}

}  // namespace

std::span<const Command> main_commands() {
  static constexpr Command commands[] = {{"bench", add_bench},   {"list", add_list},
                                         {"mesh", add_mesh},     {"query", add_query},
                                         {"verify", add_verify}, {"new-plugin", add_new_plugin}};
  return commands;
}

CLI::App* add_command(CLI::App& program, std::string_view name) {
  const auto text = std::ranges::find(command_texts, name, &CommandText::name);
  return program.add_subcommand(std::string(name), std::string(text->summary))
      ->group(std::string(text->group));
}

void continue_in_extra_program(const ProgramContext& context) {
  const std::string path = support::beside_this_program("touchmark-extra");
  execv(path.c_str(), context.argv);
  throw std::invalid_argument(
      "this is a command of touchmark-extra, which is not built; scripts/build-program touchmark-extra "
      "builds it");
}

int run_program(int argc, char** argv, const contestants::Roster& roster, const ProgramParts& parts) {
  try {
    support::reserve_standard_descriptors();
  } catch (const support::ResourceError& error) {
    return fail(support::exit_resources, error.what());
  }
  support::survive_limits();
  ProgramContext context{roster, argc, argv, parts};
  CLI::App program("Which collision detector can serve a haptic loop.", "touchmark");
  program.set_version_flag("--version", std::string("touchmark ") + results::build_info().version);
  program.require_subcommand(0, 1);
  program.footer("Example: touchmark bench --mesh bunny --trajectory slide --out results/today\n");

  try {
    add_commands(program, context);
    program.allow_extras();  // after the commands, which must not inherit it
    support::StandardOutput out;
    const int status = parse_and_run(program, context);
    out.finish();
    return status;
  } catch (const std::invalid_argument& error) {
    return fail(support::exit_bad_input, error.what());
  } catch (const MeshError& error) {
    return fail(support::exit_bad_input, error.what());
  } catch (const support::ResourceError& error) {
    return fail(support::exit_resources, error.what());
  } catch (const std::bad_alloc&) {
    return fail(support::exit_resources, "out of memory" + support::memory_limit());
  } catch (const std::system_error& error) {
    return fail(support::exit_resources, error.what() + support::limit_behind(error.code().value()));
  }
}

}  // namespace touchmark::bench::cli
