/// `touchmark audit`: how an engine's answers around each mesh of a file differ from the exact ones.
#include <algorithm>
#include <filesystem>
#include <map>
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
#include "bench/cli/selector_options.h"
#include "bench/cli/worker_options.h"
#include "bench/contestants/selectors.h"
#include "bench/experiments/audit/audit_run.h"
#include "bench/meshes/mesh_writer.h"
#include "bench/meshes/meshes.h"
#include "bench/results/system_info.h"
#include "bench/scenes/scene_source.h"
#include "bench/support/checked.h"
#include "bench/support/files/standard_output.h"

namespace touchmark::bench::cli {

namespace audit = experiments::audit;

namespace {

struct AuditOptions {
  std::string file, tolerance = "0.1%", radius = "0.5%", points = "1000", seconds = "3", unit, seed = "1",
                    out;
  std::vector<std::string> detectors, packages;
  WorkerSelectors workers;
};

std::string ending_of(const std::string& file) {
  std::string ending = std::filesystem::path(file).extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending;
}

/// Formats that hold one mesh are read as --mesh reads them, with its modifiers; all others as a scene.
scenes::BodyScene scene_in(const AuditOptions& options) {
  const std::string& file = options.file;
  const std::string ending = ending_of(file.substr(0, file.find('@')));
  if (!meshes::is_named(file) && ending != ".ply" && ending != ".obj" && ending != ".off" && ending != ".stl")
    return scenes::load_body_scene(file, "", options.packages).scene;
  const std::string name = results::without_directories(file);
  return {name, {std::make_shared<const TriangleMesh>(meshes::load_mesh(file, false))}, {{name, 0, {}}}};
}

/// The unit of a robot, and of glTF, is the metre.
std::optional<double> mm_a_unit(const AuditOptions& options) {
  const std::string ending = ending_of(options.file);
  const bool metres = ending == ".urdf" || ending == ".gltf" || ending == ".glb";
  const std::optional<support::LengthUnit> unit =
      contestants::checked_unit(options.unit.empty() && metres ? "m" : options.unit);
  return unit ? std::optional(1000 * unit->metres) : std::nullopt;
}

class AuditCommand {
 public:
  AuditCommand(const ProgramContext& context, const AuditOptions& options)
      : context_(context),
        options_(options),
        specs_(context.roster.parse_all(options.detectors)),
        radius_(support::checked_length("--radius", options.radius)),
        tolerance_(support::checked_length("--tolerance", options.tolerance)),
        limits_{support::checked_count("--points", options.points, 128, 1'000'000),
                support::checked_positive("--seconds", options.seconds), support::checked_seed(options.seed)},
        workers_(worker_options(options.workers)),
        mm_a_unit_(mm_a_unit(options)),
        frame_(context, options.out) {
    if (specs_.empty())
      throw std::invalid_argument("whom to audit? Name a --plugin FILE, or a --detector of touchmark list");
    if (!(tolerance_.value > 0))
      throw support::bad_value("--tolerance", options.tolerance, "above 0: a length, or % of each diagonal");
    workers_.calibrate_clock = false;
  }

  int run() {
    frame_.progress.show(options_.file);
    const scenes::BodyScene scene = scene_in(options_);
    std::map<std::size_t, std::vector<const scenes::Body*>> users;  // of each shape
    for (const scenes::Body& body : scene.bodies) users[body.shape].push_back(&body);
    frame_.finishes([&] {
      for (const auto& [shape, bodies] : users)
        take({bodies.front()->name, bodies.size()}, *scene.shapes[shape],
             fmt::format("{} of {}", rows_.size() / specs_.size() + 1, users.size()));
    });
    return report();
  }

 private:
  void take(audit::AuditBody body, const TriangleMesh& mesh, const std::string& which) {
    body.triangles = mesh.size();
    body.diagonal = mesh.diagonal();
    body.mm_a_unit = mm_a_unit_;
    if (!(body.diagonal > 0)) throw std::invalid_argument(fmt::format("{}: the mesh is a point", body.name));
    const auto say = [&](const std::string& what) {
      frame_.progress.show(fmt::format("{} ({}): {}", body.name, which, what));
    };
    say("asking the oracle");
    audit::AuditRow about;
    about.file = results::without_directories(options_.file);
    about.body = body;
    about.lengths = {radius_.in_mesh_units(mesh), tolerance_.in_mesh_units(mesh)};
    audit::BodyAudit asked(about, mesh, limits_, workers_);
    if (frame_.folder) {
      const std::filesystem::path folder = std::filesystem::path(options_.out) / "bodies";
      std::filesystem::create_directories(folder);
      meshes::write_mesh(mesh, folder / fmt::format("{}.off", rows_.size() / specs_.size() + 1));
    }
    for (const contestants::ContestantSpec& spec : specs_) {
      rows_.push_back(asked.ask(spec, context_.roster, say));
      if (frame_.folder) asked.append_points(rows_.back(), points_);
    }
  }

  int report() {
    support::StandardOutput().write(audit::audit_table(rows_) + audit::audit_findings(rows_));
    if (frame_.folder) {
      frame_.folder->write_file("audit.csv", audit::audit_csv(rows_));
      frame_.folder->write_file("audit_points.csv", points_);
    }
    if (!frame_.description.finished) return interrupted(rows_.size());
    const auto is = [&](const auto& holds) { return std::ranges::any_of(rows_, holds); };
    if (is([](const audit::AuditRow& row) { return row.status != "ok" && !row.declined(); }))
      return support::exit_check_failed;
    return is([](const audit::AuditRow& row) { return row.status == "ok"; }) ? support::exit_done
                                                                             : support::exit_inconclusive;
  }

  const ProgramContext& context_;
  const AuditOptions& options_;
  std::vector<contestants::ContestantSpec> specs_;
  support::Length radius_, tolerance_;
  audit::AuditLimits limits_;
  workers::WorkerOptions workers_;
  std::optional<double> mm_a_unit_;
  RunFrame frame_;
  std::vector<audit::AuditRow> rows_;
  std::string points_ = audit::audit_points_header();
};

}  // namespace

void add_audit(CLI::App& program, ProgramContext& context) {
  const auto options = std::make_shared<AuditOptions>();
  CLI::App* command = add_command(program, "audit");
  add_value(*command, "file", options->file, "FILE",
            "a mesh by name or file, a scene (.json, or a file with a node tree) or a robot (.urdf)")
      ->required();
  add_list(*command, "--detector", options->detectors, "D",
           "whom to audit, as NAME[:key=value,...] (touchmark list); repeatable");
  add_plugins(*command, context, &options->detectors);
  add_value(*command, "--tolerance", options->tolerance, "LENGTH",
            "beyond which an answer is wrong, in mesh units or % of each body's diagonal");
  add_value(*command, "--radius", options->radius, "LENGTH", "the probe's, likewise");
  add_value(*command, "--points", options->points, "N", "where to ask about each body");
  add_value(*command, "--seconds", options->seconds, "S",
            "for a body: who is slow is asked fewer points, 128 at least");
  add_unit(*command, options->unit);
  add_list(*command, "--package", options->packages, "NAME=DIR",
           "of a .urdf: where package://NAME is; repeatable");
  add_value(*command, "--seed", options->seed, "N", "of the points");
  add_value(*command, "--out", options->out, "DIR",
            "folder for audit.csv, audit_points.csv and bodies/; scripts/plot DIR draws them");
  add_worker_selectors(*command, options->workers);
  command->footer(
      "Asks near each body's surface, in its cavities, inside and beyond, and compares with exact answers. "
      "An engine\nthat fills a closed body is taken for one of solids, where all that is inside is contact. "
      "Exit status 1 if an\nanswer is off by more than the tolerance or an engine fails; 4 if it refuses "
      "every body.\n"
      "Example: touchmark audit robot.urdf --plugin mine.py --out out/audit\n"
      "         touchmark audit part.stl --unit mm --detector bullet --tolerance 0.05\n");
  command->final_callback([options, &context] { context.status = AuditCommand(context, *options).run(); });
}

}  // namespace touchmark::bench::cli
