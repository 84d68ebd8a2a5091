/// What is true of one triangle of a body, or of a round body, whose surface is so far from its axis. All
/// exact: bounds decide where they can, whole numbers where they cannot.
#pragma once

#include "bench/oracle/triangle.h"
#include "core/probe.h"

namespace touchmark::bench::oracle {

/// Is the surface within the radius, which is at least 0, of the point?
bool is_within(const Vec3& point, const PlacedTriangle& triangle, double radius);
/// Is it within the radius of a point of the segment?
bool is_within(const Vec3& from, const Vec3& to, const PlacedTriangle& triangle, double radius);
/// Returns true if it is nearer than the radius to a point of the segment.
bool is_nearer(const Vec3& from, const Vec3& to, const PlacedTriangle& triangle, double radius);
/// Is it within the radius of the point at that fraction of the path, not rounded?
bool is_within_on_path(const Sweep& sweep, double fraction, const PlacedTriangle& triangle, double radius);
/// Reference::touches_before, for this one.
bool is_touched_before(const Sweep& sweep, double fraction, const PlacedTriangle& triangle);
/// Reference::surely_crosses, for this one.
bool is_surely_crossed(const Vec3& from, const Vec3& to, const PlacedTriangle& triangle, double margin);

}  // namespace touchmark::bench::oracle
