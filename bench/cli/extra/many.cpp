/// `touchmark many`: many points asked at once, against Embree asked for the same points in the same order.
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/extra/extra_commands.h"
#include "bench/cli/options.h"
#include "bench/cli/plugin_option.h"
#include "bench/cli/run_frame.h"
#include "bench/contestants/roster.h"
#include "bench/experiments/many/many_run.h"
#include "bench/meshes/meshes.h"
#include "bench/results/system_info.h"
#include "bench/support/checked.h"
#include "bench/support/files/standard_output.h"
#include "core/search/threads/parallel.h"

namespace touchmark::bench::cli {

namespace many = experiments::many;

namespace {

struct ManyCommandOptions {
  std::string mesh, reach = "0.5%", points, shell_points, ticks, rounds, seed = "1", out;
  std::vector<std::string> detectors, kinds, threads, orders;
  bool normalize = false, quick = false;
};

struct ManySettings {
  std::vector<contestants::ContestantSpec> contestants;
  std::vector<many::Kind> kinds;
  std::vector<ManyOptions> options;
  many::WorkloadSizes sizes;
  std::size_t rounds = 0;
  std::uint64_t seed = 0;
};

/// Without --detector our fast exact ones, the reference, and Embree where it is built in.
std::vector<contestants::ContestantSpec> checked_contestants(const std::vector<std::string>& names,
                                                             const contestants::Roster& roster) {
  std::vector<contestants::ContestantSpec> specs = roster.parse_all(names);
  if (!specs.empty()) return specs;
  for (const contestants::ContestantInfo& info : roster.contestants())
    if (info.built() && (info.name == "sphere-cluster" || info.name == "grid-group" ||
                         info.name == "aabb-tree" || info.name == "embree"))
      specs.push_back(roster.parse(info.name));
  return specs;
}

ManySettings checked(const ManyCommandOptions& options, const contestants::Roster& roster) {
  constexpr std::size_t most = 100'000'000;
  const bool quick = options.quick;
  ManySettings settings;
  settings.contestants = checked_contestants(options.detectors, roster);
  for (const std::string& name :
       or_else(options.kinds, {"coherent", "incoherent", "pointshell", "pointshell-close"})) {
    const std::optional<many::Kind> kind = many::kind_named(name);
    if (!kind)
      throw support::bad_value("--kind", name, "one of coherent, incoherent, pointshell, pointshell-close");
    settings.kinds.push_back(*kind);
  }
  for (const std::string& threads : or_else(options.threads, {"1"})) {
    for (const std::string& name : or_else(options.orders, {"as-given", "automatic"})) {
      const std::optional<AskOrder> order = many::order_named(name);
      if (!order) throw support::bad_value("--order", name, "one of as-given, automatic, curve");
      settings.options.push_back(
          {static_cast<unsigned>(support::count_or(1, "--threads", threads, 1, max_threads)), *order});
    }
  }
  settings.sizes = {support::count_or(quick ? 10'000 : 100'000, "--points", options.points, 1, most),
                    support::count_or(1'000, "--shell-points", options.shell_points, 1, most),
                    support::count_or(quick ? 20 : 200, "--ticks", options.ticks, 1, 1'000'000)};
  settings.rounds = support::count_or(quick ? 3 : 11, "--rounds", options.rounds, 1, 1'000);
  settings.seed = support::checked_seed(options.seed);
  return settings;
}

int run_many(const ProgramContext& context, const ManyCommandOptions& options) {
  const ManySettings settings = checked(options, context.roster);
  const support::Length reach_text = support::checked_length("--reach", options.reach);
  const std::string name = options.mesh.empty() ? meshes::default_mesh() : options.mesh;
  RunFrame frame(context, options.out);
  frame.progress.show(fmt::format("{}: building", name));
  const TriangleMesh mesh = meshes::load_mesh(name, options.normalize);
  const double reach = reach_text.in_mesh_units(mesh);
  many::ManyRun run(context.roster, settings.contestants, results::without_directories(name), mesh);
  std::vector<many::ManyRow> rows;
  const bool finished = frame.finishes([&] {
    for (const many::Kind kind : settings.kinds) {
      frame.progress.show(fmt::format("{}, {}: making the points", name, many::name_of(kind)));
      run.take(many::make_workload(kind, mesh, reach, settings.sizes, settings.seed));
      for (const ManyOptions& how : settings.options) {
        const std::vector<many::ManyRow> more =
            run.run(how, settings.rounds, settings.seed, [&](const std::string& contestant) {
              frame.progress.show(fmt::format("{}, {}: {}", name, many::name_of(kind), contestant));
            });
        rows.insert(rows.end(), more.begin(), more.end());
      }
    }
  });
  support::StandardOutput().write(many::many_table(rows));
  if (frame.folder) frame.folder->write_file("many.csv", many::many_csv(rows));
  int status = finished ? support::exit_done : interrupted(rows.size());
  for (const many::ManyRow& row : rows) {
    if (row.differing == 0) continue;
    if (status == support::exit_done) status = support::exit_check_failed;
    fmt::print(stderr, "touchmark: {}, {}: {} answers differ from those of aabb-tree\n", row.contestant(),
               row.kind, row.differing);
  }
  return status;
}

void add_sizes(CLI::App& command, ManyCommandOptions& options) {
  add_value(command, "--points", options.points, "N", "of a call, coherent or not; default: 100000");
  add_value(command, "--shell-points", options.shell_points, "N", "of a pointshell; default: 1000");
  add_value(command, "--ticks", options.ticks, "N", "calls of a pointshell; default: 200");
  add_value(command, "--rounds", options.rounds, "N", "that are timed; default: 11");
}

}  // namespace

void add_many(CLI::App& program, ProgramContext& context) {
  const auto options = std::make_shared<ManyCommandOptions>();
  CLI::App* command = add_command(program, "many");
  add_value(*command, "--mesh", options->mesh, "MESH", "a mesh by name (touchmark list) or a file");
  command->add_flag("--normalize", options->normalize, "scale to box diagonal 1 about the origin");
  add_list(*command, "--detector", options->detectors, "D",
           "a contestant that answers nearest (touchmark list); repeatable; default: our fast ones, "
           "aabb-tree and embree");
  add_plugins(*command, context, &options->detectors);
  add_list(*command, "--kind", options->kinds, "KIND",
           "coherent, incoherent, pointshell or pointshell-close; repeatable; default: all");
  add_list(*command, "--order", options->orders, "ORDER",
           "as-given, automatic or curve; repeatable; default: the first two");
  add_list(*command, "--threads", options->threads, "N", "repeatable; default: 1");
  add_value(*command, "--reach", options->reach, "LENGTH", "mesh units or % of the box diagonal");
  add_sizes(*command, *options);
  add_value(*command, "--seed", options->seed, "N", "of the points and of the order of measuring");
  add_value(*command, "--out", options->out, "DIR", "folder for many.csv");
  command->add_flag("--quick", options->quick, "fewer points, ticks and rounds");
  command->footer(
      "coherent: a slide along the surface. incoherent: random places within reach. pointshell: points of a\n"
      "body that turns and comes down on the mesh. pointshell-close: all within reach, shaken. All "
      "contestants\n"
      "are asked by nearest_many for the same points in the same order, in turns, in this process: one that\n"
      "crashes ends the command. Exit status 1 if answers differ from those of aabb-tree asked one by one.\n"
      "Example: touchmark many --mesh bunny --threads 1 --threads 2 --out out/many\n");
  command->final_callback([options, &context] { context.status = run_many(context, *options); });
}

}  // namespace touchmark::bench::cli
