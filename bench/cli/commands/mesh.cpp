/// `touchmark mesh`: what a mesh is like, and finer ones.
#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/cli/commands/mesh_commands.h"
#include "bench/cli/options.h"
#include "bench/cli/program.h"
#include "bench/cli/selector_options.h"
#include "bench/meshes/mesh_report.h"
#include "bench/meshes/meshes.h"
#include "bench/support/files/standard_output.h"
#include "bench/support/names.h"
#include "bench/support/system/available_memory.h"

namespace touchmark::bench::cli {
namespace {

struct InfoOptions {
  std::string mesh;
  bool normalize = false;
  bool json = false;
  std::string unit;
};

/// What report_on takes for a triangle.
constexpr double bytes_reported_on = 400;

constexpr std::array<support::Name<SideFinder::Method>, 4> methods{
    {{SideFinder::Method::pseudonormals, "pseudonormals"},
     {SideFinder::Method::crossings, "crossings"},
     {SideFinder::Method::winding_number, "winding_number"},
     {SideFinder::Method::none, "none"}}};

std::string_view name_of(SideFinder::Method method) { return support::name_in(methods, method); }

struct Metric {
  const char* what;
  double value;
};

/// Sizes in metres, square metres and cubic metres.
std::vector<Metric> metrics_of(const meshes::MeshReport& report, const support::LengthUnit& unit) {
  const double m = unit.metres;
  const Vec3 size = report.bounds.max - report.bounds.min;
  std::vector<Metric> metrics{{"size_x_m", size.x() * m},
                              {"size_y_m", size.y() * m},
                              {"size_z_m", size.z() * m},
                              {"diagonal_m", report.diagonal * m},
                              {"area_m2", report.area * m * m}};
  if (report.volume) metrics.push_back({"volume_m3", *report.volume * m * m * m});
  metrics.push_back({"shortest_edge_m", report.shortest_edge * m});
  metrics.push_back({"mean_edge_m", report.mean_edge * m});
  metrics.push_back({"longest_edge_m", report.longest_edge * m});
  return metrics;
}

nlohmann::ordered_json members_of(const meshes::MeshReport& report,
                                  const std::optional<support::LengthUnit>& unit) {
  const auto triple = [](const Vec3& v) { return nlohmann::ordered_json{v.x(), v.y(), v.z()}; };
  nlohmann::ordered_json json;
  json["triangles"] = report.triangles;
  json["faces"] = report.faces;
  json["vertices"] = report.vertices;
  json["positions"] = report.positions;
  json["bounds_min"] = triple(report.bounds.min);
  json["bounds_max"] = triple(report.bounds.max);
  json["diagonal"] = report.diagonal;
  json["degenerate_triangles"] = report.degenerate;
  json["edges"] = report.edges;
  json["boundary_edges"] = report.boundary_edges;
  json["non_manifold_edges"] = report.non_manifold_edges;
  json["euler_characteristic"] = report.euler_characteristic;
  json["closed"] = report.closed;
  json["oriented"] = report.oriented;
  json["area"] = report.area;
  json["volume"] = report.volume ? nlohmann::ordered_json(*report.volume) : nlohmann::ordered_json();
  json["shortest_edge"] = report.shortest_edge;
  json["mean_edge"] = report.mean_edge;
  json["longest_edge"] = report.longest_edge;
  json["worst_aspect_ratio"] = report.worst_aspect_ratio;
  json["sides_by"] = name_of(report.sides.method);
  json["simple_triangles"] = report.sides.simple_triangles;
  json["open_edges"] = report.sides.open_edges;
  json["contrary_edges"] = report.sides.contrary_edges;
  json["inside_out"] = report.sides.inside_out;
  if (unit) {
    json["unit"] = unit->name;
    for (const Metric& metric : metrics_of(report, *unit)) json[metric.what] = metric.value;
  }
  return json;
}

void add_info(CLI::App& mesh_command) {
  const auto options = std::make_shared<InfoOptions>();
  CLI::App* command = mesh_command.add_subcommand("info", "size, connections, measures; one line each");
  add_mesh_options(*command, options->mesh, options->normalize);
  command->add_flag("--json", options->json, "as JSON");
  add_unit(*command, options->unit);
  command->footer(
      "Example: touchmark mesh info bunny@normalize\n"
      "         touchmark mesh info part.stl --unit mm\n");
  command->final_callback([options] {
    const std::optional<support::LengthUnit> unit = contestants::checked_unit(options->unit);
    const meshes::ImportedMesh file = meshes::load_with_frame(options->mesh, options->normalize);
    support::require_memory(fmt::format("edges and sides of {} triangles", file.mesh.size()),
                            bytes_reported_on * static_cast<double>(file.mesh.size()));
    nlohmann::ordered_json members = members_of(meshes::report_on(file.mesh), unit);
    if (!file.axes.empty()) members["axes"] = file.axes;
    if (!file.unit.empty() && !unit) members["unit"] = file.unit;
    if (!file.remark.empty()) members["remark"] = file.remark;
    nlohmann::ordered_json named{{"mesh", options->mesh}};
    named.update(members);
    support::StandardOutput().write(
        options->json ? named.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n"
                      : lines_of(members));
  });
}

}  // namespace

std::string lines_of(const nlohmann::ordered_json& members) {
  std::string text;
  const auto line = [&](const std::string& name, const auto& value) {
    text += fmt::format("{}: {}\n", name, value);
  };
  for (const auto& [name, value] : members.items()) {
    if (value.is_boolean())
      line(name, value.get<bool>() ? "yes" : "no");
    else if (value.is_number_integer())
      line(name, value.get<std::int64_t>());
    else if (value.is_number())
      line(name, value.get<double>());
    else if (value.is_array())
      line(name, fmt::format("{}", fmt::join(value.get<std::vector<double>>(), " ")));
    else if (value.is_string())
      line(name, value.get<std::string>());
  }
  return text;
}

void add_mesh_options(CLI::App& command, std::string& mesh, bool& normalize) {
  add_value(command, "--mesh,mesh", mesh, "MESH", "a mesh by name (touchmark list) or a file")->required();
  command.add_flag("--normalize", normalize, "scale to box diagonal 1 about the origin first");
}

void add_mesh(CLI::App& program, ProgramContext&) {
  CLI::App* command = add_command(program, "mesh");
  command->require_subcommand(1);
  command->footer("Example: touchmark mesh info bunny\n");
  add_info(*command);
  add_mesh_measure(*command);
  add_mesh_subdivide(*command);
}

}  // namespace touchmark::bench::cli
