#include "core/subdivision/loop.h"

#include <cmath>
#include <numbers>

namespace touchmark {
namespace {

double beta(std::size_t valence) {
  if (valence <= 3) return 3. / 16;
  const auto k = static_cast<double>(valence);
  const double root = 3. / 8 + std::cos(2 * std::numbers::pi / k) / 4;
  return (5. / 8 - root * root) / k;
}

}  // namespace

Vec3 weighted_mean(std::span<const Weight> mask, std::span<const Vec3> positions) {
  Vec3 sum = Vec3::Zero();
  for (const auto& [vertex, weight] : mask) sum += weight * positions[vertex];
  return sum;
}

void loop_vertex_mask(const TriangleSurface& surface, std::uint32_t vertex, std::vector<Weight>& mask) {
  const std::uint32_t first = surface.side_from(vertex);
  mask.assign({{vertex, 1}});
  if (surface.location(vertex) == TriangleSurface::Location::corner) return;
  if (surface.location(vertex) == TriangleSurface::Location::boundary) {
    mask[0].weight = 3. / 4;
    mask.push_back({surface.end(first), 1. / 8});
    mask.push_back({surface.apex(surface.last_side_from(vertex)), 1. / 8});
    return;
  }
  std::uint32_t side = first;
  do {
    mask.push_back({surface.end(side), 0});
    side = surface.turned(side);
  } while (side != first);
  const std::size_t valence = mask.size() - 1;
  const double share = beta(valence);
  for (Weight& neighbour : mask) neighbour.weight = share;
  mask[0].weight = 1 - static_cast<double>(valence) * share;
}

void loop_edge_mask(const TriangleSurface& surface, std::uint32_t edge, std::vector<Weight>& mask) {
  const auto [a, b] = surface.edges().ends(edge);
  const auto sides = surface.edges().sides(edge);
  mask.assign({{a, 1. / 2}, {b, 1. / 2}});
  if (surface.location_of_edge(edge) == TriangleSurface::Location::inside)
    mask.assign(
        {{a, 3. / 8}, {b, 3. / 8}, {surface.apex(sides[0]), 1. / 8}, {surface.apex(sides[1]), 1. / 8}});
}

std::vector<Vec3> loop_points(const TriangleSurface& surface, std::span<const Vec3> positions,
                              std::span<const std::uint32_t> edges) {
  std::vector<Vec3> points;
  points.reserve(positions.size() + edges.size());
  std::vector<Weight> mask;
  for (std::uint32_t v = 0; v < positions.size(); ++v) {
    loop_vertex_mask(surface, v, mask);
    points.push_back(weighted_mean(mask, positions));
  }
  for (const std::uint32_t edge : edges) {
    loop_edge_mask(surface, edge, mask);
    points.push_back(weighted_mean(mask, positions));
  }
  return points;
}

}  // namespace touchmark
