#include "core/subdivision/butterfly.h"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace touchmark {
namespace {

class Butterfly {
 public:
  Butterfly(const TriangleSurface& surface, std::span<const Vec3> positions)
      : surface_(surface), positions_(positions) {}

  /// Along the boundary: the cubic through four vertices, at its middle.
  Vec3 four_point(std::uint32_t side) const {
    const std::uint32_t a = surface_.start(side), b = surface_.end(side);
    return 9. / 16 * (positions_[a] + positions_[b]) - 1. / 16 * (before(a, b) + after(b, a));
  }

  Vec3 middle(std::uint32_t side) const {
    return (positions_[surface_.start(side)] + positions_[surface_.end(side)]) / 2;
  }

  Vec3 eight_point(std::uint32_t side) const {
    const std::uint32_t other = surface_.across(side);
    const Vec3 ends = positions_[surface_.start(side)] + positions_[surface_.end(side)];
    const Vec3 apexes = positions_[surface_.apex(side)] + positions_[surface_.apex(other)];
    const Vec3 wings = wing(TriangleSurface::next(side)) + wing(TriangleSurface::previous(side)) +
                       wing(TriangleSurface::next(other)) + wing(TriangleSurface::previous(other));
    return 1. / 2 * ends + 1. / 8 * apexes - 1. / 16 * wings;
  }

  Vec3 modified(std::uint32_t side) {
    const std::uint32_t other = surface_.across(side);
    const bool start_rules = !regular(surface_.start(side));
    const bool end_rules = !regular(surface_.end(side));
    if (start_rules && end_rules) return 0.5 * (from_ring(side) + from_ring(other));
    if (start_rules) return from_ring(side);
    if (end_rules) return from_ring(other);
    return eight_point(side);
  }

 private:
  using Location = TriangleSurface::Location;

  /// A corner has no rule of its own.
  bool regular(std::uint32_t v) const {
    if (surface_.location(v) == Location::corner) return true;
    return surface_.valence(v) == (surface_.location(v) == Location::boundary ? 4 : 6);
  }

  /// The boundary vertex before `v`, whose next one is `next`; where a corner ends the boundary, `next`
  /// reflected.
  Vec3 before(std::uint32_t v, std::uint32_t next) const {
    if (surface_.location(v) == Location::corner) return 2 * positions_[v] - positions_[next];
    return positions_[surface_.apex(surface_.last_side_from(v))];
  }
  Vec3 after(std::uint32_t v, std::uint32_t previous) const {
    if (surface_.location(v) == Location::corner) return 2 * positions_[v] - positions_[previous];
    return positions_[surface_.end(surface_.side_from(v))];
  }

  Vec3 wing(std::uint32_t side) const {
    const std::uint32_t beyond = surface_.across(side);
    if (beyond != TriangleSurface::no_side) return positions_[surface_.apex(beyond)];
    return positions_[surface_.start(side)] + positions_[surface_.end(side)] -
           positions_[surface_.apex(side)];
  }

  /// The rule of an extraordinary vertex at the start of the side.
  Vec3 from_ring(std::uint32_t side) {
    const std::uint32_t v = surface_.start(side);
    return surface_.location(v) == Location::boundary ? from_half_ring(v, surface_.end(side))
                                                      : from_whole_ring(v, side);
  }

  Vec3 from_whole_ring(std::uint32_t v, std::uint32_t side) {
    surface_.ring(side, ring_);
    const auto k = static_cast<double>(ring_.size());
    Vec3 sum = 0.75 * positions_[v];
    for (std::size_t j = 0; j < ring_.size(); ++j) sum += ring_weight(j, k) * positions_[ring_[j]];
    return sum;
  }

  static double ring_weight(std::size_t j, double k) {
    if (k < 4) return j == 0 ? 5. / 12 : -1. / 12;
    if (k == 4) return j == 0 ? 3. / 8 : j == 2 ? -1. / 8 : 0;
    const double angle = 2 * std::numbers::pi * static_cast<double>(j) / k;
    return (1. / 4 + std::cos(angle) + std::cos(2 * angle) / 2) / k;
  }

  /// `i` is the edge's place in the fan, with k triangles spread over half a turn.
  Vec3 from_half_ring(std::uint32_t v, std::uint32_t end) {
    surface_.ring(surface_.side_from(v), ring_);
    std::size_t i = 0;
    while (ring_[i] != end) ++i;
    const std::size_t triangles = ring_.size() - 1;
    const auto k = static_cast<double>(triangles);
    const double t = std::numbers::pi / k, it = static_cast<double>(i) * t;
    const double outer =
        std::cos(it) / 4 - std::sin(2 * t) * std::sin(2 * it) / (4 * k * (std::cos(t) - std::cos(2 * t)));
    Vec3 sum = (1 - std::sin(t) * std::sin(it) / (k * (1 - std::cos(t)))) * positions_[v];
    sum += outer * (positions_[ring_.front()] - positions_[ring_.back()]);
    for (std::size_t j = 1; j < triangles; ++j) {
      const double jt = static_cast<double>(j) * t;
      const double weight = (std::sin(it) * std::sin(jt) + std::sin(2 * it) * std::sin(2 * jt) / 2) / k;
      sum += weight * positions_[ring_[j]];
    }
    return sum;
  }

  const TriangleSurface& surface_;
  std::span<const Vec3> positions_;
  std::vector<std::uint32_t> ring_;
};

}  // namespace

std::vector<Vec3> butterfly_points(const TriangleSurface& surface, std::span<const Vec3> positions,
                                   std::span<const std::uint32_t> edges, SubdivisionForm form) {
  Butterfly butterfly(surface, positions);
  std::vector<Vec3> points;
  points.reserve(edges.size());
  for (const std::uint32_t edge : edges) {
    const auto sides = surface.edges().sides(edge);
    const TriangleSurface::Location location = surface.location_of_edge(edge);
    if (location == TriangleSurface::Location::boundary) {
      points.push_back(butterfly.four_point(sides[0]));
    } else if (location == TriangleSurface::Location::corner) {
      points.push_back(butterfly.middle(sides[0]));
    } else if (form == SubdivisionForm::published) {
      points.push_back(butterfly.modified(sides[0]));
    } else {
      points.push_back(butterfly.eight_point(sides[0]));
    }
  }
  return points;
}

}  // namespace touchmark
