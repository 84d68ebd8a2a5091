/// Which of our detectors suits a mesh and what is going to be asked of it.
#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <variant>

#include "core/aabb_tree/aabb_tree.h"
#include "core/grid_group/grid_group.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "core/triangle_mesh.h"

namespace touchmark {

/// The detectors that are chosen from, in the order of FormOptions.
enum class Form : std::uint8_t { sphere_cluster, grid_group, aabb_tree };

/// Returns its name as contestants have it: "sphere-cluster".
std::string_view name_of(Form form) noexcept;

/// What is going to be asked, as far as it is known, and what may be spent on it.
struct Wish {
  enum class Query : std::uint8_t { any, touches, nearest, sweep };

  Query query = Query::any;
  std::optional<double> reach = std::nullopt;  ///< how far is looked, mesh units; may be infinite
  std::optional<double> speed = std::nullopt;  ///< by how far the point moves a tick, mesh units
  double max_bytes = std::numeric_limits<double>::infinity();  ///< what the structure may take once built
  /// How long it may be tried out which is faster, building included; 0: not at all. What a trial chooses may
  /// differ from run to run; answers do not.
  double trial_ms = 0;
  std::optional<Form> form = std::nullopt;  ///< this one, whatever the mesh
};

/// What a detector's `build` is told.
using FormOptions = std::variant<SphereCluster::Options, GridGroup::Options, AabbTree::Options>;

/// What was chosen, and by what.
struct Choice {
  FormOptions options;
  double overlap = 0;  ///< the mesh's, as overlap_of tells
  bool tried = false;  ///< true: by a trial

  Form form() const noexcept { return static_cast<Form>(options.index()); }
};

/// Returns what suits the mesh within the wish's memory: the sphere-cluster, which was ahead on every kind of
/// mesh measured, or the tree of boxes where that takes too much. Where large triangles overlap so much that
/// lists of places may pay, and the wish leaves the time to build both, it tries the grid-group, too.
/// Throws std::invalid_argument for a reach, a speed, a limit or a time that is negative or not a number.
Choice best_for(const TriangleMesh& mesh, const Wish& wish = {});

}  // namespace touchmark
