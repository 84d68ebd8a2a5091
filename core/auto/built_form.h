/// A detector that was chosen, and how a choice comes about.
#pragma once

#include <optional>
#include <variant>

#include "core/aabb_tree/aabb_tree.h"
#include "core/auto/best_for.h"
#include "core/grid_group/grid_group.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "core/triangle_mesh.h"

namespace touchmark {

/// In the order of Form.
using BuiltForm = std::variant<SphereCluster, GridGroup, AabbTree>;

BuiltForm build_form(const TriangleMesh& mesh, const FormOptions& options);

/// What was chosen, and the detector where a trial has built it.
struct ChosenForm {
  Choice choice;
  std::optional<BuiltForm> built = std::nullopt;
};

/// As best_for, and throws what that throws.
ChosenForm choose_form(const TriangleMesh& mesh, const Wish& wish);

/// Builds both and asks them the same questions along the surface. Returns the faster one: the sphere-cluster
/// where the other is less than a tenth faster, and nothing where wish.trial_ms is too short for both.
std::optional<BuiltForm> faster_of(const TriangleMesh& mesh, const FormOptions& spheres,
                                   const FormOptions& grid, const Wish& wish);

}  // namespace touchmark
