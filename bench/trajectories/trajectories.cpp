#include "bench/trajectories/trajectories.h"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <optional>
#include <stdexcept>
#include <string_view>
#include <utility>

#include "bench/support/length.h"
#include "bench/trajectories/drape.h"
#include "bench/trajectories/trajectory_csv.h"
#include "bench/trajectories/trajectory_shapes.h"

namespace touchmark::bench::trajectories {
namespace {

constexpr std::size_t default_steps = 20'000;
constexpr double object_size_m = 0.2;  // across its box, where no unit says another
constexpr double min_speed_percent = 1e-4, max_speed_percent = 50;

struct Shape {
  const char* name;
  const char* description;
  Positions (*positions)(Motion);
  double own_speed = 0;    ///< in diagonals a tick; 0: it takes no ":speed=S%"
  const char* words = "";  ///< that it reads itself, as lists show them
};

constexpr Shape shapes[] = {
    {"slide", "in contact along the surface, 0.05 % of the diagonal a tick, the heading wanders", &slide,
     slide_speed},
    {"approach", "in from 0.3 diagonal, press three times, retract, on to another place", &approach,
     slide_speed},
    {"hover", "free motion 0.02 to 0.3 diagonal from the surface, 0.1 % a tick", &hover, hover_speed},
    {"jump", "independent uniform points in 1.2 x the box: no coherence", &jump},
    {"tap", "three quick contacts at each of many random places", &tap},
    {"edge", "in contact along sharp edges; along any edges where none is sharp", &edge, slide_speed},
    {"cross", "straight through thin parts, four radii a tick", &cross},
    {"hand", "as recorded hands move an object of 20 cm: strokes, pauses, tremor and the sensor's noise",
     &hand, 0, hand_words},
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

/// Returns the shape of "slide" or "slide:speed=0.4%", or null.
const Shape* shape_of(const std::string& what) {
  const auto* const shape = std::find_if(std::begin(shapes), std::end(shapes), [&](const Shape& candidate) {
    return what.substr(0, what.find(':')) == candidate.name;
  });
  return shape == std::end(shapes) ? nullptr : shape;
}

/// Returns diagonals a tick, or nothing where there is no option.
std::optional<double> speed_in(const std::string& what, const Shape& shape) {
  const std::size_t colon = what.find(':');
  if (colon == std::string::npos || *shape.words != '\0') return std::nullopt;
  constexpr std::string_view key = "speed=";
  const std::string_view option = std::string_view(what).substr(colon + 1);
  if (shape.own_speed == 0 || !option.starts_with(key))
    throw std::invalid_argument("trajectory '" + what + "': " + shape.name +
                                (shape.own_speed > 0 ? " takes speed=S% only" : " takes no option"));
  const std::optional<support::Length> speed = support::parse_length(option.substr(key.size()));
  if (!speed || !speed->percent || !(speed->value >= min_speed_percent) ||
      !(speed->value <= max_speed_percent))
    throw std::invalid_argument(
        "trajectory '" + what +
        "': its speed is not a percentage of the diagonal a tick from 0.0001% to 50%");
  return speed->value / 100;
}

}  // namespace

std::vector<TrajectoryInfo> trajectories() {
  std::vector<TrajectoryInfo> list;
  for (const Shape& shape : shapes)
    list.push_back({shape.name, shape.description, 100 * shape.own_speed, shape.words});
  return list;
}

bool is_generated(const std::string& name) { return shape_of(name) != nullptr; }

Trajectory make_trajectory(const std::string& what, const TriangleMesh& mesh,
                           const TrajectoryOptions& options) {
  if (!(options.radius >= 0))
    throw std::invalid_argument("the radius is " + std::to_string(options.radius) +
                                ": it must be at least 0");
  const Shape* const shape = shape_of(what);
  if (shape == nullptr && !is_path(what)) throw unknown(what);
  if (shape == nullptr && !options.motion.drape) return read_trajectory(what, options.steps, options.motion);
  const double diagonal = unit_of_length(mesh, options.radius),
               radius = std::min(options.radius, 0.05 * diagonal);
  const double metre = options.unit ? 1 / options.unit->metres : diagonal / object_size_m;
  if (shape == nullptr) {
    MotionOptions motion = options.motion;
    motion.scale = motion.scale.value_or(metre);
    return draped(read_trajectory(what, options.steps, motion), *motion.drape,
                  {mesh, 1, support::Random(options.seed), diagonal, radius});
  }
  const std::size_t steps = options.steps == 0 ? default_steps : options.steps;
  return {what, shape->positions({mesh, steps, support::Random(options.seed), diagonal, radius,
                                  speed_in(what, *shape), what, metre})};
}

}  // namespace touchmark::bench::trajectories
