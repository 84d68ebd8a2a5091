/// Which triangles have nothing else near them: where the side of the nearest point is the side of the probe.
///
/// A face is clear when its corners are not sharper than `sharpest` (as a sine), every other face that it
/// shares a vertex with leaves that vertex or edge at an angle not less, and all other faces are farther away
/// than `clearance` times the mesh's extent. Decided in double: what these margins leave out is far more than
/// rounding could. Intersecting, doubled, folded and touching faces and slivers are not clear.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/aabb.h"
#include "core/sign/pseudonormals.h"
#include "core/sign/triangle_tree.h"

namespace touchmark::sign {

inline constexpr double sharpest = 0x1p-10;   // a twentieth of a degree
inline constexpr double clearance = 0x1p-36;  // distances err by less for probes within 500 extents

/// Returns by face whether it is clear. `face_of` gives the face of a triangle in the tree, or no_face.
std::vector<bool> clear_faces(const Pseudonormals& normals, const TriangleTree& tree,
                              std::span<const std::uint32_t> face_of, const Aabb& bounds);

}  // namespace touchmark::sign
