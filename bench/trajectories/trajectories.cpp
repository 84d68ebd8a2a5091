#include "bench/trajectories/trajectories.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <stdexcept>
#include <utility>

#include "bench/trajectories/trajectory_csv.h"
#include "bench/trajectories/trajectory_shapes.h"

namespace touchmark::bench::trajectories {
namespace {

constexpr std::size_t default_steps = 20'000;

struct Shape {
  const char* name;
  const char* description;
  Positions (*positions)(Motion);
};

constexpr Shape shapes[] = {
    {"slide", "in contact along the surface, 0.0005 diagonal a tick, the heading wanders", &slide},
    {"approach", "in from 0.3 diagonal, press three times, retract, on to another place", &approach},
    {"hover", "free motion 0.02 to 0.3 diagonal from the surface, 0.001 a tick", &hover},
    {"jump", "independent uniform points in 1.2 x the box: no coherence", &jump},
    {"tap", "three quick contacts at each of many random places", &tap},
    {"edge", "in contact along sharp edges; along any edges where none is sharp", &edge},
    {"cross", "straight through thin parts, four radii a tick", &cross},
};

double unit_of_length(const TriangleMesh& mesh, double radius) {
  const double diagonal = mesh.diagonal();
  if (!std::isfinite(diagonal))
    throw std::invalid_argument("the mesh is too large: its box's diagonal overflows");
  if (diagonal > 0) return diagonal;
  return radius > 0 && std::isfinite(radius) ? radius : 1;
}

bool is_path(const std::string& what) {
  std::error_code ignored;
  return what.find('/') != std::string::npos || what.ends_with(".csv") ||
         std::filesystem::exists(what, ignored);
}

std::invalid_argument unknown(const std::string& what) {
  std::string names;
  for (const Shape& shape : shapes) names += std::string(names.empty() ? "" : ", ") + shape.name;
  return std::invalid_argument("unknown trajectory '" + what + "': it is one of " + names +
                               ", or a CSV file");
}

}  // namespace

std::vector<TrajectoryInfo> trajectories() {
  std::vector<TrajectoryInfo> list;
  for (const Shape& shape : shapes) list.push_back({shape.name, shape.description});
  return list;
}

bool is_generated(const std::string& name) {
  return std::any_of(std::begin(shapes), std::end(shapes),
                     [&](const Shape& shape) { return name == shape.name; });
}

Trajectory make_trajectory(const std::string& what, const TriangleMesh& mesh,
                           const TrajectoryOptions& options) {
  if (!(options.radius >= 0)) {
    throw std::invalid_argument("the radius is " + std::to_string(options.radius) +
                                ": it must be at least 0");
  }
  const auto* const shape = std::find_if(std::begin(shapes), std::end(shapes),
                                         [&](const Shape& candidate) { return what == candidate.name; });
  if (shape == std::end(shapes)) {
    if (is_path(what)) return read_trajectory(what, options.steps, options.motion);
    throw unknown(what);
  }
  const double diagonal = unit_of_length(mesh, options.radius);
  const std::size_t steps = options.steps == 0 ? default_steps : options.steps;
  return {shape->name,
          shape->positions({mesh, steps, support::Random(options.seed), diagonal,
                            std::min(options.radius, 0.05 * diagonal)}),
          {},
          {}};
}

}  // namespace touchmark::bench::trajectories
