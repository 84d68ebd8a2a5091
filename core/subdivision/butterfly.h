/// The butterfly scheme: old vertices stay, a new one on an edge is a weighted mean of its neighbourhood.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "core/probe.h"
#include "core/subdivision/oriented_surface.h"
#include "core/subdivision/subdivision.h"

namespace touchmark {

/// The new positions on `edges`.
///
/// meshlab: Dyn, Gregory, Levin 1990 at every valence: 1/2 at the edge's ends, 1/8 at the two apexes, -1/16
/// at the four outer wings; on a boundary the four-point rule -1/16, 9/16, 9/16, -1/16 along it.
///
/// published: the same where both ends are regular (valence 6; 4 on a boundary). An extraordinary end rules
/// the edge by its own ring, two such ends by the mean of both: inside by Zorin, Schröder, Sweldens 1996
/// ("Interpolating subdivision for meshes with arbitrary topology"), on a boundary by the crease rule of
/// Zorin & Schröder's course notes ("Subdivision for modeling and animation", SIGGRAPH 2000).
///
/// A wing beyond a boundary or a seam is the apex before it, reflected: start + end - apex. Seams split in
/// the middle; a corner counts as regular, and the boundary goes straight on beyond it.
std::vector<Vec3> butterfly_points(const TriangleSurface& surface, std::span<const Vec3> positions,
                                   std::span<const std::uint32_t> edges, SubdivisionForm form);

}  // namespace touchmark
