/// Facets of bodies that are no triangles. Lengths are those of the scene.
#pragma once

#include "bench/scenes/body_scene.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::scenes {

/// A closed surface of triangles on a sphere or a capsule, within a hundredth of the radius.
TriangleMesh facets_of(const RoundShape& shape);

}  // namespace touchmark::bench::scenes
