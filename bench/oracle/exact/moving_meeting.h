/// Whether and when a triangle whose corners go straight meets a point that does: rational arithmetic and
/// Sturm chains.
#pragma once

#include <optional>

#include "bench/oracle/triangle.h"
#include "core/probe.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::oracle {

/// Two numbers with the first meeting between them, nearer to one another than 2^-60.
struct MeetingTime {
  double low, high;
};
/// Corners go from `start` to `end` and the point from `from` to `to`, all at an even pace from 0 to 1.
std::optional<MeetingTime> first_meeting(const Triangle& start, const Triangle& end, const Vec3& from,
                                         const Vec3& to);

/// Returns true if such a point meets a triangle of a mesh whose vertices go straight as well.
bool any_meets(const TriangleMesh& before, const TriangleMesh& after, const Vec3& from, const Vec3& to);

}  // namespace touchmark::bench::oracle
