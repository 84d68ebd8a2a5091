/// Words of the command line choose the published form of a detector, as `lookup=scan` does. Its class lacks
/// some options of the fast form.
#pragma once

#include "core/grid_group/grid_group.h"
#include "core/sphere_cluster/sphere_cluster.h"

namespace touchmark::named {

// Each throws std::invalid_argument for options of the fast form that make no sense for the published one, or
// that no form takes.
void expect_published(const GridGroup::Options& options);
void expect_published(const SphereCluster::Options& options);

}  // namespace touchmark::named
