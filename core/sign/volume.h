/// The sign of the volume that a closed mesh encloses: exact for the stored doubles.
#pragma once

#include "core/triangle_mesh.h"

namespace touchmark::sign {

/// 1 where its faces look outwards on the whole, -1 where they look inwards, 0 where it encloses nothing or
/// as much either way. Doubles decide where their rounding cannot matter; else whole numbers do, at about a
/// microsecond a triangle. The mesh is closed and its coordinates are finite.
int volume_sign(const TriangleMesh& mesh) noexcept;

}  // namespace touchmark::sign
