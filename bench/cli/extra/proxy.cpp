/// `touchmark proxy`: which proxy crosses a surface, and how often? Every way is replayed by the exact
/// oracle.
#include <algorithm>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/extra/coupling_options.h"
#include "bench/cli/extra/extra_commands.h"
#include "bench/cli/options.h"
#include "bench/cli/run_frame.h"
#include "bench/contestants/roster.h"
#include "bench/experiments/proxy/proxy_csv.h"
#include "bench/experiments/proxy/proxy_report.h"
#include "bench/experiments/proxy/proxy_run.h"
#include "bench/experiments/proxy/proxy_trace.h"
#include "bench/experiments/proxy/stab.h"
#include "bench/meshes/meshes.h"
#include "bench/support/checked.h"
#include "bench/support/files/atomic_file.h"
#include "bench/support/files/standard_output.h"
#include "bench/support/length.h"
#include "bench/trajectories/trajectories.h"

namespace touchmark::bench::cli {

namespace proxy = experiments::proxy;

namespace {

constexpr std::uint64_t max_ticks = 1'000'000'000'000;

struct ProxyOptions {
  std::vector<std::string> methods, families;
  std::string ticks, replays = "3", seed = "1", detector = "sphere-cluster";
  std::string mesh, trajectory, radius = "0.5%", trace, out;
  CouplingSelectors coupling;
};

proxy::ProxyRequest request_of(const ProxyOptions& options, const contestants::Roster& roster) {
  proxy::ProxyRequest request;
  for (const std::string& name : options.families) request.families.push_back(&proxy::family_named(name));
  if (request.families.empty() && options.mesh.empty()) {
    for (const proxy::Family& family : proxy::families()) request.families.push_back(&family);
  }
  for (const std::string& name : options.methods) request.methods.push_back(proxies::method_named(name));
  if (request.methods.empty()) request.methods = proxies::all_methods(roster);
  request.ticks =
      support::checked_count("--ticks", options.ticks.empty() ? "100000" : options.ticks, 1, max_ticks);
  request.replays = support::checked_count("--replays", options.replays, 1, 1000);
  request.seed = support::checked_count("--seed", options.seed, 0, UINT32_MAX);
  request.detector = roster.parse_all({options.detector}).front().text();
  request.coupling = checked_coupling(options.coupling);
  if (options.mesh.empty() != options.trajectory.empty())
    throw std::invalid_argument("--mesh and --trajectory go together");
  if (!options.trace.empty() && (options.mesh.empty() || options.methods.size() != 1))
    throw std::invalid_argument("--trace needs one --method, a --mesh and a --trajectory");
  if (!options.mesh.empty() && !options.families.empty())
    throw std::invalid_argument("--family and --mesh exclude one another");
  return request;
}

/// The user's own mesh and motion.
proxy::Course course_of(const ProxyOptions& options, std::uint64_t seed) {
  TriangleMesh mesh = meshes::load_mesh(options.mesh, false);
  const support::Length length = support::checked_length("--radius", options.radius);
  trajectories::TrajectoryOptions motion;
  if (!options.ticks.empty()) motion.steps = support::checked_count("--ticks", options.ticks, 1, max_ticks);
  motion.seed = seed;
  motion.radius = length.in_mesh_units(mesh);
  trajectories::Trajectory trajectory = trajectories::make_trajectory(options.trajectory, mesh, motion);
  const std::vector<Vec3>& goals = trajectory.positions;
  const Vec3 start = proxies::free_start(proxies::WayOracle(mesh), goals, motion.radius);
  return {trajectory.name, std::move(mesh), motion.radius, 0, start, std::move(trajectory.positions)};
}

class ProxyCommand {
 public:
  ProxyCommand(const ProgramContext& context, const ProxyOptions& options)
      : options_(options),
        roster_(context.roster),
        run_(context.roster, request_of(options, context.roster)),
        frame_(context, options.out) {
    frame_.description.seed = run_.request().seed;
    frame_.description.effort = {0, 0, 0, 0};
  }

  int run();

 private:
  void run_own_course();
  void report();

  const ProxyOptions& options_;
  const contestants::Roster& roster_;
  proxy::ProxyRun run_;
  RunFrame frame_;
};

void ProxyCommand::run_own_course() {
  const proxy::Course course = course_of(options_, run_.request().seed);
  proxy::ProxyTrace trace;
  std::optional<support::AtomicFile> file;
  proxy::Seen seen;
  if (!options_.trace.empty()) {
    file.emplace(options_.trace);
    seen = [&](std::size_t tick, const proxy::Step& step, std::int64_t ns) {
      trace.add(tick, course.goals[tick], step, ns);
    };
  }
  run_.run_course_of(
      options_.mesh, course, [&](const std::string& what) { frame_.progress.show(what); }, seen);
  if (!file) return;
  file->write(trace.text());
  file->commit();
}

void ProxyCommand::report() {
  const std::string faults = proxy::proxy_faults(run_.scores());
  support::StandardOutput().write(proxy::proxy_table(run_.scores()) + (faults.empty() ? "" : "\n" + faults));
  if (!frame_.folder) return;
  frame_.folder->write_file("proxy.csv", proxy::proxy_csv(frame_.description.run_id, run_.scores()));
  if (options_.mesh.empty()) {
    const proxy::ProxyRequest& request = run_.request();
    frame_.folder->write_file("stab.csv",
                              proxy::stab_csv(roster_, request.methods, request.coupling, request.detector));
  }
  frame_.folder->write_file("run.json", proxy::proxy_json(frame_.description, run_));
}

int ProxyCommand::run() {
  const bool finished = frame_.finishes([this] {
    if (options_.mesh.empty())
      run_.run([&](const std::string& what) { frame_.progress.show(what); });
    else
      run_own_course();
  });
  report();
  if (!finished) return interrupted(run_.scores().size());
  const bool broken =
      std::ranges::any_of(run_.scores(), [](const proxy::Score& score) { return score.broken(); });
  return broken ? support::exit_check_failed : support::exit_done;
}

std::string lists() {
  std::string list = "Methods:\n";
  for (const proxies::MethodInfo& method : proxies::methods()) {
    list += fmt::format("  {:<20}{}\n", method.name, method.meaning);
    for (const proxies::MethodOption& option : method.options)
      list += fmt::format("    {}={}: {}\n", option.key, option.default_value, option.meaning);
  }
  list += "Families:\n";
  for (const proxy::Family& family : proxy::families())
    list += fmt::format("  {:<20}{}\n", family.name, family.meaning);
  return list;
}

}  // namespace

void add_proxy(CLI::App& program, ProgramContext& context) {
  const auto options = std::make_shared<ProxyOptions>();
  CLI::App* command = add_command(program, "proxy");
  add_list(*command, "--method", options->methods, "M",
           "one of those below, as NAME[:key=value,...]; repeatable; default: all");
  add_list(*command, "--family", options->families, "F", "one of those below; repeatable; default: all");
  add_value(*command, "--ticks", options->ticks, "N",
            "of all families together, about; default: 100000; with --mesh at most so many");
  add_value(*command, "--replays", options->replays, "N",
            "how often each way is run: a tick's time is the least of these; 1 where only crossings matter");
  add_value(*command, "--seed", options->seed, "N", "of all meshes and motions");
  add_value(*command, "--detector", options->detector, "D",
            "which of ours answers methods that claim never to cross");
  add_value(*command, "--mesh", options->mesh, "MESH",
            "instead of families: a mesh by name or a file, with --trajectory");
  add_value(*command, "--trajectory", options->trajectory, "T",
            "a name (touchmark list) or a motion file: the goals; the proxy starts at the first that is "
            "free, or where none is free outward from the first");
  add_value(*command, "--radius", options->radius, "LENGTH",
            "the ball's, with --mesh; mesh units or % of the box diagonal");
  add_value(*command, "--trace", options->trace, "FILE",
            "with --mesh and one method: file for the way, one row a straight piece");
  add_coupling(*command, options->coupling);
  add_value(*command, "--out", options->out, "DIR",
            "folder for proxy.csv, stab.csv and run.json; scripts/plot draws them");
  command->footer(
      lists() +
      "Exit status 1 if a method that claims never to cross crossed, or came nearer than the radius.\n"
      "Example: touchmark proxy --method god-object --method virtual-proxy --family cracks --ticks 20000 "
      "--out results/today\n");
  command->final_callback([options, &context] { context.status = ProxyCommand(context, *options).run(); });
}

}  // namespace touchmark::bench::cli
