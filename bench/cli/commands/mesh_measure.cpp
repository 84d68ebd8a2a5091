/// `touchmark mesh measure`: what Choi & Sung 2017 measure on a mesh.
#include <cmath>
#include <cstddef>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "bench/cli/commands/mesh_commands.h"
#include "bench/cli/options.h"
#include "bench/contestants/selectors.h"
#include "bench/meshes/meshes.h"
#include "bench/support/files/standard_output.h"
#include "bench/support/numbers.h"
#include "bench/support/split.h"
#include "core/sphere_cluster/published/triangle_spheres.h"
#include "core/subdivision/mesh_measures.h"

namespace touchmark::bench::cli {
namespace {

struct MeasureOptions {
  std::string mesh;
  bool normalize = false;
  std::string center = "0,0,0";
  bool json = false;
};

/// "x,y,z".
Vec3 parse_center(const std::string& text) {
  Vec3 center = Vec3::Zero();
  const std::vector<std::string_view> parts = support::split(text, ',');
  for (std::size_t axis = 0; axis < 3; ++axis) {
    const std::optional<double> number =
        parts.size() == 3 ? support::parse_number(parts[axis]) : std::nullopt;
    if (!number || !std::isfinite(*number))
      throw std::invalid_argument(fmt::format("--center {}: three numbers, as 0,0.5,-1", text));
    center[static_cast<Eigen::Index>(axis)] = *number;
  }
  return center;
}

/// One sphere a triangle, as without clustering.
std::optional<double> tightness_of(const TriangleMesh& mesh) {
  std::vector<Vec3> centers;
  std::vector<double> radii;
  for (const Sphere& sphere : triangle_spheres(mesh)) {
    centers.push_back(sphere.center);
    radii.push_back(sphere.radius);
  }
  return tightness(centers, radii, centers);
}

nlohmann::ordered_json measures_of(const TriangleMesh& mesh, const Vec3& center) {
  const EdgeStatistics edges = edge_statistics(mesh);
  nlohmann::ordered_json measures;
  measures["triangles"] = mesh.size();
  measures["area"] = area(mesh);
  measures["mean_triangle_area"] = mean_triangle_area(mesh);
  measures["signed_volume"] = signed_volume(mesh);
  measures["absolute_volume"] = absolute_volume(mesh, center);
  measures["spheres"] = mesh.size();
  measures["tightness"] = tightness_of(mesh).value();  // every centroid is the centre of its own sphere
  measures["edges"] = edges.edges;
  measures["boundary_edges"] = edges.boundary;
  measures["seam_edges"] = edges.seams;
  measures["closed"] = edges.closed();
  measures["shortest_edge"] = edges.shortest;
  measures["mean_edge"] = edges.mean;
  measures["longest_edge"] = edges.longest;
  return measures;
}

}  // namespace

void add_mesh_measure(CLI::App& mesh_command) {
  const auto options = std::make_shared<MeasureOptions>();
  CLI::App* command =
      mesh_command.add_subcommand("measure", "area, volume and tightness as Choi & Sung 2017 define them");
  add_mesh_options(*command, options->mesh, options->normalize);
  add_value(*command, "--center", options->center, "X,Y,Z",
            "tip of the tetrahedra whose absolute volumes are added up");
  command->add_flag("--json", options->json, "as JSON");
  command->footer("Example: touchmark mesh measure bunny\n");
  command->final_callback([options] {
    const Vec3 center = parse_center(options->center);
    nlohmann::ordered_json measures =
        measures_of(meshes::load_mesh(options->mesh, options->normalize), center);
    support::StandardOutput().write(options->json ? measures.dump(2) + "\n" : lines_of(measures));
  });
}

}  // namespace touchmark::bench::cli
