#include "core/grid_group/direct/triangle_store.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

#include <Eigen/Geometry>

#include "core/search/threads/parallel.h"

namespace touchmark::grid {
namespace {

/// What the order is made by: the middle of a triangle, up to a factor.
struct alignas(16) Middle {
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

/// The order along a side: ties by number, so that there are none.
struct Along {
  int side;

  bool operator()(const Middle& a, const Middle& b) const noexcept {
    return a.at[side] < b.at[side] || (a.at[side] == b.at[side] && a.triangle < b.triangle);
  }
};

/// Puts the first `half` along the side before the others. Whole intervals of the side are told apart by a
/// look at each middle, without a branch; an order is needed in that interval alone in which the halves meet.
void put_first(std::span<Middle> middles, std::size_t half, int side, float lower, float upper) {
  constexpr std::size_t most = 256;
  std::array<Middle, most> few;
  std::vector<Middle> many(middles.size() > most ? middles.size() : 0);
  Middle* const sorted = many.empty() ? few.data() : many.data();
  const std::size_t intervals = std::min(middles.size(), most);
  const float per_length = static_cast<float>(intervals) / (upper - lower);
  // Without an extent, or with one that has no inverse.
  if (!(per_length < std::numeric_limits<float>::max())) {
    std::nth_element(middles.begin(), middles.begin() + static_cast<std::ptrdiff_t>(half), middles.end(),
                     Along{side});
    return;
  }
  const auto interval_of = [&](const Middle& middle) {
    const auto interval = static_cast<std::size_t>((middle.at[side] - lower) * per_length);
    return std::min(interval, intervals - 1);
  };
  std::array<std::uint32_t, most> counts{};
  for (const Middle& middle : middles) ++counts[interval_of(middle)];
  std::size_t meeting = 0, before = 0;
  while (before + counts[meeting] <= half) before += counts[meeting++];
  std::array<std::size_t, 3> at = {0, before, before + counts[meeting]};
  for (const Middle& middle : middles) {
    const std::size_t interval = interval_of(middle);
    sorted[at[std::size_t{interval >= meeting} + std::size_t{interval > meeting}]++] = middle;
  }
  std::copy_n(sorted, middles.size(), middles.begin());
  const auto from = middles.begin() + static_cast<std::ptrdiff_t>(before);
  std::nth_element(from, middles.begin() + static_cast<std::ptrdiff_t>(half), from + counts[meeting],
                   Along{side});
}

/// The first half is a power of two of blocks, so that the boxes of a hierarchy with eight children a node
/// fall on halves of halves of halves.
std::pair<std::span<Middle>, std::span<Middle>> halve(std::span<Middle> middles) {
  const std::size_t half = std::bit_ceil(middles.size()) / 2;
  Lanes lower = load(middles.front().at.data()), upper = lower;  // the number's bits with them
  for (const Middle& middle : middles) {
    const Lanes at = load(middle.at.data());
    lower = simd::min(lower, at);
    upper = simd::max(upper, at);
  }
  const Lanes extent = upper - lower;
  int side = extent[1] > extent[0] ? 1 : 0;
  if (extent[2] > extent[side]) side = 2;
  put_first(middles, half, side, lower[side], upper[side]);
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
