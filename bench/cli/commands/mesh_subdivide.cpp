/// `touchmark mesh subdivide`: a finer mesh into a file.
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdio>
#include <limits>
#include <memory>
#include <optional>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "bench/cli/commands/mesh_commands.h"
#include "bench/cli/options.h"
#include "bench/contestants/selectors.h"
#include "bench/meshes/mesh_writer.h"
#include "bench/meshes/meshes.h"
#include "bench/support/files/standard_output.h"
#include "bench/support/numbers.h"
#include "bench/support/system/available_memory.h"
#include "core/subdivision/mesh_measures.h"
#include "core/subdivision/subdivision.h"

namespace touchmark::bench::cli {
namespace {

const std::vector<std::string> method_names = {"butterfly", "catmull-clark", "catmull-clark-linear",
                                               "mid-point", "loop",          "ls3"};

struct SubdivideOptions {
  std::string mesh;
  bool normalize = false;
  std::string method;
  std::string levels;
  std::string threshold = "0";
  std::string form;
  std::string output;
};

/// The words checked, but for the threshold, which may need the mesh.
struct Request {
  SubdivisionOptions subdivision;
  support::Length threshold;
};

Request check(const SubdivideOptions& options) {
  Request request;
  request.subdivision.method = subdivision_method(options.method).value();
  const std::optional<std::uint64_t> levels = support::parse_count(options.levels);
  if (!levels || *levels > static_cast<std::uint64_t>(std::numeric_limits<int>::max()))
    throw std::invalid_argument(fmt::format("--levels {}: a whole number, 0 or more", options.levels));
  request.subdivision.levels = static_cast<int>(*levels);
  const std::optional<support::Length> threshold = support::parse_length(options.threshold);
  if (!threshold)
    throw std::invalid_argument(fmt::format(
        "--threshold {}: a length of 0 or more in mesh units, or a percentage of the box diagonal (1%)",
        options.threshold));
  request.threshold = *threshold;
  // Only the paper's tool knows a threshold, so one is taken to ask for that tool's way.
  const bool as_the_tool = options.form.empty() ? threshold->value > 0 : options.form == "meshlab";
  request.subdivision.form = as_the_tool ? SubdivisionForm::meshlab : SubdivisionForm::published;
  meshes::mesh_format_of(options.output);
  return request;
}

std::string summary(const SubdivideOptions& options, const SubdivisionOptions& subdivision,
                    const TriangleMesh& coarse, const TriangleMesh& fine) {
  std::string text;
  const auto line = [&text](const char* what, const auto& value) {
    text += fmt::format("{}: {}\n", what, value);
  };
  line("method", options.method);
  line("form", subdivision.form == SubdivisionForm::meshlab ? "meshlab" : "published");
  line("levels", subdivision.levels);
  line("threshold", subdivision.threshold);
  line("input_triangles", coarse.size());
  line("triangles", fine.size());
  line("vertices", fine.vertices().size());
  line("output", options.output);
  return text;
}

void warn_of_seams(const SubdivideOptions& options, const TriangleMesh& coarse) {
  const std::size_t seams = edge_statistics(coarse).seams;
  if (seams == 0) return;
  fmt::print(stderr,
             "touchmark: {} of the edges of {} have more than two triangles or different orientations: they "
             "split in the middle and their ends stay\n",
             seams, options.mesh);
}

/// What a triangle takes while it is made: 50 million take about 4 GB.
constexpr double bytes_a_triangle = 86;

/// Limits the result to memory. The size is known beforehand where every edge splits; elsewhere it may come
/// to what there is room for. Too many for a mesh are refused by subdivide itself.
void keep_within_memory(SubdivisionOptions& options, std::size_t triangles) {
  const bool by_faces = options.method == SubdivisionMethod::catmull_clark ||
                        options.method == SubdivisionMethod::catmull_clark_linear;
  if (by_faces || options.threshold == 0) {
    const double fine = static_cast<double>(triangles) * std::pow(4.0, options.levels) * (by_faces ? 1.5 : 1);
    if (fine <= static_cast<double>(options.max_triangles))
      support::require_memory(fmt::format("{:.0f} triangles after level {}", fine, options.levels),
                              bytes_a_triangle * fine);
    return;
  }
  const std::optional<std::uint64_t> available = support::available_memory();
  if (!available) return;
  const double most = static_cast<double>(*available) / bytes_a_triangle;
  if (most < static_cast<double>(options.max_triangles))
    options.max_triangles = static_cast<std::size_t>(most);
}

void subdivide_into_file(const SubdivideOptions& options) {
  Request request = check(options);
  const TriangleMesh coarse = meshes::load_mesh(options.mesh, options.normalize);
  request.subdivision.threshold = request.threshold.in_mesh_units(coarse);
  keep_within_memory(request.subdivision, coarse.size());
  warn_of_seams(options, coarse);
  const TriangleMesh fine = subdivide(coarse, request.subdivision);
  meshes::write_mesh(fine, options.output);
  support::StandardOutput().write(summary(options, request.subdivision, coarse, fine));
}

}  // namespace

void add_mesh_subdivide(CLI::App& mesh_command) {
  const auto options = std::make_shared<SubdivideOptions>();
  CLI::App* command = mesh_command.add_subcommand("subdivide", "a finer mesh, written to a file");
  add_mesh_options(*command, options->mesh, options->normalize);
  add_value(*command, "--method", options->method, "METHOD", fmt::format("{}", fmt::join(method_names, "|")))
      ->check(CLI::IsMember(method_names))
      ->required();
  add_value(*command, "--levels", options->levels, "N", "how many times")->required();
  add_value(*command, "--threshold", options->threshold, "LENGTH",
            "only longer edges split, the same length at every level: mesh units, or percent of the input "
            "mesh's box diagonal; 0: all split. Catmull-Clark always splits all");
  add_value(*command, "--form", options->form, "FORM",
            "published: each scheme as in its paper, in double. meshlab: as the tool of Choi & Sung does it, "
            "in float; plain butterfly. The default is meshlab with a threshold, else published")
      ->check(CLI::IsMember({"published", "meshlab"}));
  add_value(*command, "--output", options->output, "FILE", "a .ply, .obj, .off or .stl file")->required();
  command->footer(
      "Example: touchmark mesh subdivide --mesh bunny --method ls3 --levels 2 --threshold 1% --output "
      "fine.ply\n");
  command->final_callback([options] { subdivide_into_file(*options); });
}

}  // namespace touchmark::bench::cli
