#include "bench/experiments/audit/audit_points.h"

#include <algorithm>
#include <array>

#include "bench/experiments/audit/convex_hull.h"
#include "bench/oracle/oracle.h"
#include "bench/support/names.h"
#include "bench/support/random.h"
#include "bench/support/system/interrupt.h"
#include "bench/trajectories/surface.h"
#include "core/sign/side_finder.h"

namespace touchmark::bench::experiments::audit {
namespace {

constexpr std::array<support::Name<Place>, places> names{{{Place::inside, "inside"},
                                                          {Place::cavities, "cavities"},
                                                          {Place::near, "near"},
                                                          {Place::beyond, "beyond"}}};
constexpr std::size_t tries_a_point = 20;
constexpr double hull_error = 1.0 / 8;  ///< a share of the tolerance

/// Without vertices that no triangle uses.
std::vector<Vec3> corners_of(const TriangleMesh& mesh) {
  std::vector<Vec3> corners;
  for (std::size_t i = 0; i < mesh.size(); ++i)
    for (int k = 0; k < 3; ++k) corners.push_back(mesh.corner(i, k));
  return corners;
}

/// Tells places apart. Not the oracle: it only has to find points; what is true of them the oracle says.
class Finder {
 public:
  Finder(const TriangleMesh& mesh, const AuditLengths& lengths, std::uint64_t seed)
      : mesh_(mesh),
        lengths_(lengths),
        random_(seed),
        surface_(mesh),
        sides_(SideFinder::build(mesh)),
        hull_(corners_of(mesh), hull_error * lengths.tolerance) {}

  /// Returns points of four kinds in turns: within twice the radius of the surface, farther from it but
  /// mostly near, and anywhere in the box, or in one that is larger by a quarter of its diagonal on each
  /// side.
  AuditPoint candidate(std::size_t attempt) {
    const double diagonal = mesh_.diagonal(), reach[] = {2 * lengths_.radius, diagonal / 4};
    const std::size_t kind = attempt % 4;
    Vec3 center;
    if (kind < 2) {
      const trajectories::SurfacePoint at = surface_.random_surface_point(random_);
      const double u = random_.between(-1, 1);
      center = at.point + at.normal * (reach[kind] * (kind == 0 ? u : u * u * u));
    } else {
      const Aabb& box = mesh_.bounds();
      const Vec3 margin = Vec3::Constant(kind == 2 ? 0 : diagonal / 4), low = box.min - margin;
      const Vec3 size = box.max + margin - low;
      center = low + size.cwiseProduct(0.5 * (random_.point() + Vec3::Ones()));
    }
    const Contact nearest = surface_.nearest(center);
    const double depth = hull_.depth(center);
    return {center, place_of(center, nearest, depth), depth};
  }

 private:
  Place place_of(const Vec3& center, const Contact& nearest, double depth) {
    if (sides_.surface().closed &&
        sides_.side(center, nearest, Accuracy{Guarantee::approximate, 0, 0, false}, counted_) == Side::inside)
      return Place::inside;
    // Twice, so that a clear point is one by the oracle, too.
    if (depth > lengths_.tolerance && nearest.distance > lengths_.radius + 2 * lengths_.tolerance)
      return Place::cavities;
    return nearest.distance <= 2 * lengths_.radius ? Place::near : Place::beyond;
  }

  const TriangleMesh& mesh_;
  AuditLengths lengths_;
  support::Random random_;
  trajectories::Surface surface_;
  SideFinder sides_;
  ConvexHull hull_;
  std::uint64_t counted_ = 0;
};

std::vector<AuditPoint> in_turns(const std::array<std::vector<AuditPoint>, places>& found) {
  std::vector<AuditPoint> points;
  const std::size_t most = std::ranges::max_element(found, {}, &std::vector<AuditPoint>::size)->size();
  for (std::size_t i = 0; i < most; ++i)
    for (const std::vector<AuditPoint>& of_place : found)
      if (i < of_place.size()) points.push_back(of_place[i]);
  return points;
}

}  // namespace

std::string_view name_of(Place place) noexcept { return support::name_in(names, place); }

std::vector<AuditPoint> audit_points(const TriangleMesh& mesh, const AuditLengths& lengths,
                                     std::size_t wanted, std::uint64_t seed) {
  Finder finder(mesh, lengths, seed);
  std::array<std::vector<AuditPoint>, places> found;
  const std::size_t of_each = (wanted + places - 1) / places;
  for (std::size_t attempt = 0; attempt < tries_a_point * wanted; ++attempt) {
    if (attempt % 256 == 0) support::check_for_interrupt();
    AuditPoint point = finder.candidate(attempt);
    std::vector<AuditPoint>& of_place = found[static_cast<std::size_t>(point.place)];
    if (of_place.size() < of_each) of_place.push_back(point);
    if (std::ranges::all_of(found, [&](const auto& one) { return one.size() == of_each; })) break;
  }
  std::vector<AuditPoint> points = in_turns(found);
  std::vector<Probe> probes;
  for (const AuditPoint& point : points) probes.push_back({point.center, lengths.radius});
  const std::vector<oracle::GroundTruth> truths = oracle::Oracle(mesh).solve(probes);
  for (std::size_t i = 0; i < points.size(); ++i) points[i].truth = truths[i];
  return points;
}

}  // namespace touchmark::bench::experiments::audit
