#include "core/field/plane_fitter.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>

#include "core/float_limits.h"

namespace touchmark::field {
namespace {

constexpr std::size_t max_triangles = 256;  // in a ball: more are not flat together, as a rule

Vec3 corner_of(std::size_t corner) noexcept {
  return {static_cast<double>(corner & 1), static_cast<double>(corner >> 1 & 1),
          static_cast<double>(corner >> 2 & 1)};
}

}  // namespace

/// The feet of a cube's points: their coordinates along two axes, of which the third follows. Lengths are
/// mesh units, from the cube's corner.
struct PlaneFitter::Grid {
  std::array<int, 2> axes;
  int across;
  std::array<double, 2> first, size;

  /// Returns the foot in the middle of one of 2^bits squares a side.
  Vec3 middle(const PlaneCell& cell, std::uint32_t square) const noexcept {
    const double squares = static_cast<double>(1U << cell.stored.bits);
    const std::array<std::uint32_t, 2> at{square & ((1U << cell.stored.bits) - 1),
                                          square >> cell.stored.bits};
    Vec3 foot = Vec3::Zero();
    for (std::size_t side = 0; side < 2; ++side)
      foot[axes[side]] = first[side] + (at[side] + 0.5) * size[side] / squares;
    foot[across] = -(cell.normal.dot(foot) + static_cast<double>(cell.stored.offset)) / cell.normal[across];
    return foot;
  }
  /// Returns how far feet in one of the squares are from its middle, at most.
  double half_diagonal(const PlaneCell& cell) const noexcept {
    const double half = 0.5 / static_cast<double>(1U << cell.stored.bits);
    double most = 0;
    for (const double sign : {1.0, -1.0}) {
      Vec3 to = Vec3::Zero();
      to[axes[0]] = half * size[0];
      to[axes[1]] = sign * half * size[1];
      to[across] = -cell.normal.dot(to) / cell.normal[across];
      most = std::max(most, to.norm());
    }
    return most * (1 + 0x1p-10);  // places on the grid are rounded
  }
  /// Tells the cell where the squares are.
  void lay(PlaneCell& cell, double unit) const noexcept {
    for (std::size_t side = 0; side < 2; ++side) {
      cell.stored.first[side] = static_cast<float>(first[side] / unit);
      cell.stored.per_edge[side] =
          static_cast<float>(static_cast<double>(1U << cell.stored.bits) * unit / size[side]);
    }
  }
};

std::optional<PlaneFitter::Fit> PlaneFitter::fit(const Cube& cube, const Sample& middle,
                                                 const Sampler& sample) const {
  const Ball ball{cube.corner + Vec3::Constant(0.5 * cube.edge), middle.distance + 2 * cube.radius};
  std::vector<Near> near = triangles_in(ball);
  if (near.size() > max_triangles) return std::nullopt;
  const Vec3 normal = mean_normal(near, ball, middle);
  if (!(normal.squaredNorm() > 0.5)) return std::nullopt;
  Fit fit{PlaneCell::across(normal), {}, {}, 0};
  for (Near& one : near) one.height = heights_of(triangles_[one.triangle], ball, fit.cell.normal);
  if (!lay_plane(cube, near, fit) || !name_feet(cube, sample, fit)) return std::nullopt;
  fit.error += 8 * limits_.slop;
  return fit;
}

/// Lays the plane through the middle of what the cube's points may be over, if that is flat enough for points
/// on both sides; else just below the top of it.
bool PlaneFitter::lay_plane(const Cube& cube, std::span<const Near> near, Fit& fit) const noexcept {
  Heights under{infinity, -infinity};
  for (const Near& one : near) {
    const double off = std::max(std::abs(one.height.least), std::abs(one.height.most));
    if (one.distance * one.distance - off * off > cube.radius * cube.radius) continue;
    under = {std::min(under.least, one.height.least), std::max(under.most, one.height.most)};
  }
  const bool is_flat = under.most - under.least <= 1.99 * allowed_;
  const double wanted = is_flat ? 0.5 * (under.most + under.least) : under.most - 0.5 * allowed_;
  const double corner = -0.5 * cube.edge * fit.cell.normal.sum();  // above the middle
  fit.cell.stored.offset = static_cast<float>(corner - wanted);
  const double middle = static_cast<double>(fit.cell.stored.offset) - corner;  // above the plane
  if (!std::isfinite(middle)) return false;
  Heights of_cube{infinity, -infinity};
  for (std::size_t i = 0; i < 8; ++i) {
    const double height = fit.cell.height(corner_of(i), cube.edge);
    of_cube = {std::min(of_cube.least, height), std::max(of_cube.most, height)};
  }
  fit.error = 0;
  for (const Near& one : near) {
    const Outlier above{one.distance, one.height.most + middle, middle, of_cube.most};
    const Outlier below{one.distance, -(one.height.least + middle), -middle, -of_cube.least};
    for (const Outlier& side : {above, below}) {
      if (side.top_of_cube <= allowed_) continue;
      if (side.top > allowed_ && !is_out_of_the_way(side, cube.radius)) return false;
      fit.error = std::max(fit.error, std::min(side.top, allowed_));
    }
  }
  return true;
}

/// Let x be a point of the triangle at a height h(x) above t, the error allowed. Its distance along the plane
/// from the middle of the cube is at least the root of |x - m|^2 - (h(x) - h(m))^2, and from any point p of
/// the cube less than that by at most the cube's radius: L, say. x is no reason for d(p) < h(p) - t where L^2
/// + (h(p) - h(x))^2 >= (h(p) - t)^2, which is L^2 >= (h(x) - t) (2 h(p) - t - h(x)). The right side is
/// greatest at the cube's top, and there at the triangle's top or where both are the same.
bool PlaneFitter::is_out_of_the_way(const Outlier& outlier, double radius) const noexcept {
  const double off = std::max(std::abs(allowed_ - outlier.middle), std::abs(outlier.top - outlier.middle));
  const double distance = outlier.distance - 4 * limits_.slop;
  const double along = std::sqrt(std::max(distance * distance - off * off, 0.0)) - radius - 8 * limits_.slop;
  const double top = std::min(outlier.top, outlier.top_of_cube);
  return along > 0 &&
         along * along >= (1 + 0x1p-20) * (top - allowed_) * (2 * outlier.top_of_cube - allowed_ - top);
}

std::vector<PlaneFitter::Near> PlaneFitter::triangles_in(const Ball& ball) const {
  std::vector<Near> found;
  const double radius = ball.radius + limits_.slop, squared = radius * radius;
  tree_.visit(
      [&](const Aabb& box) {
        return found.size() <= max_triangles && box.squared_distance(ball.center) <= squared;
      },
      [&](const sign::TriangleTree::Item& item) {
        const double one = squared_distance(triangles_[item.index], ball.center);
        if (one <= squared) found.push_back({item.index, std::sqrt(one), {}});
      });
  return found;
}

/// The mean of the normals, by how much of a triangle may be in the ball, turned to the middle's side.
Vec3 PlaneFitter::mean_normal(std::span<const Near> near, const Ball& ball,
                              const Sample& middle) const noexcept {
  const Vec3 away = ball.center - middle.nearest;
  const Vec3 first =
      middle.distance > 64 * limits_.slop ? Vec3(away.normalized()) : triangles_[middle.triangle].normal;
  Vec3 sum = Vec3::Zero();
  for (const Near& one : near) {
    const PreparedTriangle& triangle = triangles_[one.triangle];
    const double area =
        0.5 * (triangle.corner[1] - triangle.corner[0]).cross(triangle.corner[2] - triangle.corner[0]).norm();
    const double off = triangle.normal.dot(ball.center - triangle.corner[0]);
    const double disc = 3.2 * std::max(ball.radius * ball.radius - off * off, 0.0);
    sum += std::copysign(std::min(area, disc), first.dot(triangle.normal)) * triangle.normal;
  }
  return sum.squaredNorm() > 0 ? Vec3(sum.normalized()) : first;
}

/// Bounds the heights above the plane through the ball's middle of what the triangle has in the ball: by its
/// corners, and by the disc that the ball cuts from its plane.
PlaneFitter::Heights PlaneFitter::heights_of(const PreparedTriangle& triangle, const Ball& ball,
                                             const Vec3& normal) const noexcept {
  Heights heights{infinity, -infinity};
  for (const Vec3& corner : triangle.corner) {
    const double height = normal.dot(corner - ball.center);
    heights = {std::min(heights.least, height), std::max(heights.most, height)};
  }
  if (!(triangle.normal.squaredNorm() > 0.5)) return heights;
  const double off = triangle.normal.dot(triangle.corner[0] - ball.center);
  const double along = normal.dot(triangle.normal);
  const double radius = ball.radius + 2 * limits_.slop;
  const double disc = std::sqrt(std::max(radius * radius - off * off, 0.0));
  const double spread = disc * (normal - along * triangle.normal).norm() + 2 * limits_.slop;
  return {std::max(heights.least, along * off - spread), std::min(heights.most, along * off + spread)};
}

PlaneFitter::Grid PlaneFitter::grid_over(const Cube& cube, const PlaneCell& cell) const noexcept {
  Grid grid;
  grid.axes = cell.axes;
  grid.across = 3 - cell.axes[0] - cell.axes[1];
  for (std::size_t side = 0; side < 2; ++side) {
    double least = infinity, most = -infinity;
    for (std::size_t i = 0; i < 8; ++i) {
      const double height = cell.height(corner_of(i), cube.edge);
      const double at = (corner_of(i) * cube.edge - height * cell.normal)[grid.axes[side]];
      least = std::min(least, at);
      most = std::max(most, at);
    }
    const double pad = 4 * limits_.slop + 0x1p-20 * (most - least);
    grid.first[side] = least - pad;
    grid.size[side] = most - least + 2 * pad;
  }
  return grid;
}

/// Finds a triangle for each square of the grid, the squares as large as the error allows.
bool PlaneFitter::name_feet(const Cube& cube, const Sampler& sample, Fit& fit) const {
  const Grid grid = grid_over(cube, fit.cell);
  while (grid.half_diagonal(fit.cell) > 0.5 * allowed_)
    if (++fit.cell.stored.bits > PlaneCell::max_bits) return false;
  if (!name_squares(grid, cube, sample, fit)) return false;
  if (fit.near.size() == 1) {
    fit.cell.stored.bits = 0;
    fit.names.resize(1);
  }
  fit.cell.stored.near = static_cast<std::uint16_t>(fit.near.size());
  grid.lay(fit.cell, limits_.unit);
  return true;
}

bool PlaneFitter::name_squares(const Grid& grid, const Cube& cube, const Sampler& sample, Fit& fit) const {
  const double allowed = allowed_ - grid.half_diagonal(fit.cell);
  double farthest = 0;
  for (std::uint32_t i = 0; i < fit.cell.squares(); ++i) {
    const Sample there = sample(cube.corner + grid.middle(fit.cell, i), allowed);
    farthest = std::max(farthest, there.distance);
    if (!(farthest <= allowed)) return false;
    auto named = std::find(fit.near.begin(), fit.near.end(), there.triangle);
    if (named == fit.near.end()) named = fit.near.insert(named, there.triangle);
    fit.names.push_back(static_cast<std::uint8_t>(named - fit.near.begin()));
  }
  fit.error = std::max(fit.error, farthest + grid.half_diagonal(fit.cell));
  return true;
}

}  // namespace touchmark::field
