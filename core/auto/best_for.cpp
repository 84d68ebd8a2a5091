#include "core/auto/best_for.h"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

#include "core/auto/built_form.h"
#include "core/auto/overlap.h"

namespace touchmark {
namespace {

/// What the structures were seen to take for a triangle, at most, on meshes of more than 10,000.
constexpr double sphere_cluster_bytes = 340, least_grid_bytes = 200;
constexpr double infinity = std::numeric_limits<double>::infinity();

void expect_not_negative(const char* what, double value) {
  if (value >= 0) return;
  throw std::invalid_argument("auto: " + std::string(what) + " is " + std::to_string(value) +
                              ", not 0 or more");
}

void check(const Wish& wish) {
  expect_not_negative("reach", wish.reach.value_or(0));
  expect_not_negative("speed", wish.speed.value_or(0));
  expect_not_negative("max_bytes", wish.max_bytes);
  expect_not_negative("trial_ms", wish.trial_ms);
}

/// Nothing where it would have to be larger than it may.
std::optional<FormOptions> options_of(Form form, double bytes_per_triangle) {
  switch (form) {
    case Form::sphere_cluster:
      if (bytes_per_triangle < sphere_cluster_bytes) return std::nullopt;
      return SphereCluster::Options();
    case Form::grid_group: {
      if (bytes_per_triangle < least_grid_bytes) return std::nullopt;
      GridGroup::Options options;
      options.bytes_per_triangle = std::min(options.bytes_per_triangle, bytes_per_triangle);
      return options;
    }
    case Form::aabb_tree:
      break;
  }
  return AabbTree::Options();
}

/// Less is known: on cylinders and gears, whose fans of needles hold 1.4 % of the triangles in every place,
/// and on all that overlaps less, the sphere-cluster is ahead.
constexpr double overlap_worth_a_trial = 0.02;

}  // namespace

std::string_view name_of(Form form) noexcept {
  switch (form) {
    case Form::sphere_cluster:
      return "sphere-cluster";
    case Form::grid_group:
      return "grid-group";
    case Form::aabb_tree:
      break;
  }
  return "aabb-tree";
}

BuiltForm build_form(const TriangleMesh& mesh, const FormOptions& options) {
  if (const auto* spheres = std::get_if<SphereCluster::Options>(&options))
    return SphereCluster::build(mesh, *spheres);
  if (const auto* grid = std::get_if<GridGroup::Options>(&options)) return GridGroup::build(mesh, *grid);
  return AabbTree::build(mesh, *std::get_if<AabbTree::Options>(&options));
}

ChosenForm choose_form(const TriangleMesh& mesh, const Wish& wish) {
  check(wish);
  ChosenForm chosen{{AabbTree::Options(), overlap_of(mesh), false}};
  FormOptions& options = chosen.choice.options;
  if (wish.form) {
    options = options_of(*wish.form, infinity).value();
    return chosen;
  }
  const double bytes_per_triangle = wish.max_bytes / static_cast<double>(mesh.size());
  const std::optional<FormOptions> spheres = options_of(Form::sphere_cluster, bytes_per_triangle),
                                   grid = options_of(Form::grid_group, bytes_per_triangle);
  if (spheres) options = *spheres;
  if (!spheres || !grid || chosen.choice.overlap < overlap_worth_a_trial) return chosen;
  chosen.built = faster_of(mesh, *spheres, *grid, wish);
  chosen.choice.tried = chosen.built.has_value();
  if (chosen.built && std::holds_alternative<GridGroup>(*chosen.built)) options = *grid;
  return chosen;
}

Choice best_for(const TriangleMesh& mesh, const Wish& wish) { return choose_form(mesh, wish).choice; }

}  // namespace touchmark
