/// Probe centers at which detectors disagree first.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include "core/triangle_mesh.h"

namespace touchmark::bench::experiments::stress {

/// Returns centers on vertices, edges and faces and just off them, on the borders of cells, at the box's
/// corners, at the middle of a ball, and from far to very far. `count` centres at least; the same for the
/// same mesh and seed.
std::vector<Vec3> corner_case_centers(const TriangleMesh& mesh, std::size_t count, std::uint64_t seed);

}  // namespace touchmark::bench::experiments::stress
