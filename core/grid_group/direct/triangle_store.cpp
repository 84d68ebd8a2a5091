#include "core/grid_group/direct/triangle_store.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <Eigen/Geometry>

#include "core/search/parallel.h"

namespace touchmark::grid {
namespace {

/// What the order is made by: the middle of a triangle, up to a factor.
struct Middle {
  Eigen::Vector3f at;
  std::uint32_t triangle;
};

/// Pieces of work so long that they are worth handing out.
constexpr std::size_t triangles_a_piece = 1024;

std::vector<Middle> middles_of(const TriangleMesh& mesh, const FilterFrame& frame, unsigned threads) {
  std::vector<Middle> middles(mesh.size());
  in_ranges(mesh.size(), triangles_a_piece, threads, [&](std::size_t first, std::size_t end) {
    for (std::size_t i = first; i < end; ++i) {
      Vec3 sum = Vec3::Zero();
      for (int k = 0; k < 3; ++k) sum += frame.to_frame(mesh.corner(i, k));
      middles[i] = {sum.cast<float>(), static_cast<std::uint32_t>(i)};
    }
  });
  return middles;
}

int longest_side(std::span<const Middle> middles) {
  Eigen::Array3f lower = middles.front().at, upper = lower;
  for (const Middle& middle : middles) {
    lower = lower.min(middle.at.array());
    upper = upper.max(middle.at.array());
  }
  int side = 0;
  (upper - lower).maxCoeff(&side);
  return side;
}

/// The first half is a power of two of blocks, so that the boxes of a hierarchy with eight children a node
/// fall on halves of halves of halves.
std::pair<std::span<Middle>, std::span<Middle>> halve(std::span<Middle> middles) {
  const std::size_t half = std::bit_ceil(middles.size()) / 2;
  const int side = longest_side(middles);
  std::nth_element(middles.begin(), middles.begin() + static_cast<std::ptrdiff_t>(half), middles.end(),
                   [side](const Middle& a, const Middle& b) {
                     return a.at[side] < b.at[side] || (a.at[side] == b.at[side] && a.triangle < b.triangle);
                   });
  return {middles.first(half), middles.subspan(half)};
}

/// Halves until a block is left.
void arrange(std::span<Middle> middles) {
  while (middles.size() > TriangleStore::block_size) {
    const auto [first, second] = halve(middles);
    arrange(first);
    middles = second;
  }
  // Whatever order the library left them in.
  std::sort(middles.begin(), middles.end(),
            [](const Middle& a, const Middle& b) { return a.triangle < b.triangle; });
}

TrianglePlanes infinitely_far() noexcept {
  TrianglePlanes planes{};
  planes.offset += std::numeric_limits<float>::infinity();
  return planes;
}

/// About the middle of the longest side, or about the centre of the circle through an acute triangle's
/// corners.
TriangleBall ball_around(const PreparedTriangle& triangle, const FilterFrame& frame) noexcept {
  std::array<Vec3, 3> v;
  for (std::size_t i = 0; i < 3; ++i) v[i] = frame.to_frame(triangle.corner[i]);
  const auto side_opposite = [&](std::size_t i) { return (v[(i + 2) % 3] - v[(i + 1) % 3]).squaredNorm(); };
  std::size_t o = side_opposite(1) > side_opposite(0) ? 1 : 0;
  if (side_opposite(2) > side_opposite(o)) o = 2;
  const Vec3 a = v[(o + 1) % 3] - v[o], b = v[(o + 2) % 3] - v[o], across = a.cross(b);
  Vec3 center = v[o] + 0.5 * (a + b);
  if (a.dot(b) > 0 && !triangle.normal.isZero(0)) {
    center = v[o] + (a.squaredNorm() * b - b.squaredNorm() * a).cross(across) / (2 * across.squaredNorm());
  }
  double squared = 0;
  for (const Vec3& corner : v) squared = std::max(squared, (corner - center).squaredNorm());
  return {static_cast<float>(center.x()), static_cast<float>(center.y()), static_cast<float>(center.z()),
          static_cast<float>(std::sqrt(squared))};
}

}  // namespace

TriangleStore TriangleStore::build(const TriangleMesh& mesh, unsigned threads) {
  TriangleStore store;
  store.frame = FilterFrame::around(mesh.bounds());
  store.fourth_powers_fit = store.frame.scale() > 0x1p-200 && store.frame.scale() < 0x1p200;
  std::vector<Middle> middles = middles_of(mesh, store.frame, threads);
  split_in_parallel(std::span(middles), threads, halve, arrange);

  store.exact.resize(mesh.size());
  const std::size_t whole = (mesh.size() + block_size - 1) / block_size * block_size;
  store.planes.resize(whole, infinitely_far());
  store.balls.resize(whole, {std::numeric_limits<float>::infinity(), 0, 0, 0});
  in_ranges(mesh.size(), triangles_a_piece, threads, [&](std::size_t first, std::size_t end) {
    for (std::size_t slot = first; slot < end; ++slot) {
      store.exact[slot] = prepare(mesh, middles[slot].triangle);
      store.planes[slot] = planes_of(store.exact[slot], store.frame);
      store.balls[slot] = ball_around(store.exact[slot], store.frame);
    }
  });
  store.ids = mesh.triangle_ids();
  return store;
}

std::vector<Aabb> TriangleStore::move(const TriangleMesh& mesh) {
  // Neighbours in the order share a box of what moved.
  constexpr std::uint32_t triangles_a_box = 512;
  std::vector<Aabb> boxes;
  for (std::uint32_t first = 0; first < size(); first += triangles_a_box) {
    Aabb box;
    for (std::uint32_t slot = first; slot < std::min(first + triangles_a_box, size()); ++slot) {
      if (!has_moved(exact[slot], mesh)) continue;
      for (const Vec3& corner : exact[slot].corner) box.extend(frame.to_frame(corner));
      exact[slot] = prepare(mesh, exact[slot].index);
      for (const Vec3& corner : exact[slot].corner) box.extend(frame.to_frame(corner));
      planes[slot] = planes_of(exact[slot], frame);
      balls[slot] = ball_around(exact[slot], frame);
    }
    if (!box.empty()) boxes.push_back(box);
  }
  return boxes;
}

std::size_t TriangleStore::bytes() const noexcept {
  return exact.capacity() * sizeof(PreparedTriangle) + planes.capacity() * sizeof(TrianglePlanes) +
         balls.capacity() * sizeof(TriangleBall) + ids.bytes();
}

}  // namespace touchmark::grid
