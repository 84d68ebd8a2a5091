/// The points that an engine is asked at: those near its surface, in its cavities, inside and beyond, with
/// the truth of each.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>
#include <vector>

#include "bench/oracle/reference.h"
#include "core/probe.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::experiments::audit {

/// The first that fits counts.
enum class Place : std::uint8_t {
  inside,    ///< the inside of a closed mesh
  cavities,  ///< inside the convex hull by more than the tolerance, and clear of the mesh
  near,      ///< within twice the radius of the surface
  beyond     ///< everything else
};
inline constexpr std::size_t places = 4;

std::string_view name_of(Place place) noexcept;

/// Lengths in mesh units.
struct AuditLengths {
  double radius = 0, tolerance = 0;
};

struct AuditPoint {
  Vec3 center;
  Place place;
  double hull_depth = 0;  ///< within the convex hull; below 0 outside of it
  oracle::GroundTruth truth = {};

  /// Whether it touches is beyond doubt: the surface is clear of the probe, or well within it.
  bool clear(const AuditLengths& lengths) const { return truth.high > lengths.radius + lengths.tolerance; }
  bool deep(const AuditLengths& lengths) const { return truth.high < lengths.radius - lengths.tolerance; }
};

/// At most `wanted` points, the places in turns: fewer where a body has no cavities, or no inside. The same
/// for the same seed.
std::vector<AuditPoint> audit_points(const TriangleMesh& mesh, const AuditLengths& lengths,
                                     std::size_t wanted, std::uint64_t seed);

}  // namespace touchmark::bench::experiments::audit
