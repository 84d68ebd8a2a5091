/// The name under which the library chose a detector by itself; until 0.4.
#pragma once

#include "core/sphere_cluster/sphere_cluster.h"

namespace touchmark {

/// SphereCluster, which was faster on every kind of mesh that was measured. `touchmark choose` measures on
/// your own. This header goes in 0.4: write SphereCluster.
using AutoDetector = SphereCluster;

}  // namespace touchmark
