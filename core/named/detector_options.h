/// The options of our detectors, each once. The command line, C, Python and `touchmark list` read them here.
#pragma once

#include <vector>

#include "core/aabb_tree/aabb_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/grid_group/grid_group.h"
#include "core/grid_group/published/published_grid_group.h"
#include "core/named/option.h"
#include "core/sphere_cluster/published/published_sphere_cluster.h"
#include "core/sphere_cluster/sphere_cluster.h"

namespace touchmark::named {

/// What the options of `grid-group` choose: one of two classes, and its options.
struct GridGroupForm {
  bool is_published = false;
  GridGroup::Options fast;
  PublishedGridGroup::Options published;  ///< Its cell is that of `fast`.

  /// Throws std::invalid_argument for options of the fast form that make no sense for the published one, or
  /// that no form takes.
  PublishedGridGroup::Options published_options() const;
};

/// What the options of `sphere-cluster` choose: one of two classes, and its options.
struct SphereClusterForm {
  bool scans = false;
  SphereCluster::Options fast;
  PublishedSphereCluster::Options published;  ///< Its clustering distance is that of `fast`.

  bool is_published() const noexcept { return scans || !published.precise; }
  /// Throws what GridGroupForm::published_options does.
  PublishedSphereCluster::Options published_options() const;
};

// Each returns the options in the order of `touchmark list`. They set members of the argument, which must
// outlive them. Every detector also takes `side`, see Signed.
std::vector<Option> options_of(BruteForce::Options& options);
std::vector<Option> options_of(AabbTree::Options& options);
std::vector<Option> options_of(GridGroupForm& form);
std::vector<Option> options_of(SphereClusterForm& form);
Option side_option(bool& side);
/// Sets how many threads build it.
Option threads_option(unsigned& threads);

}  // namespace touchmark::named
