#include "core/grid_group/triangle_store.h"

#include <algorithm>
#include <limits>

namespace touchmark::grid {
namespace {

struct Keyed {
  std::uint64_t key;
  std::uint32_t triangle;

  auto operator<=>(const Keyed&) const = default;
};

/// Spreads 21 bits to every third bit.
std::uint64_t spread(std::uint64_t x) noexcept {
  x = (x | x << 32) & 0x001f00000000ffffULL;
  x = (x | x << 16) & 0x001f0000ff0000ffULL;
  x = (x | x << 8) & 0x100f00f00f00f00fULL;
  x = (x | x << 4) & 0x10c30c30c30c30c3ULL;
  return (x | x << 2) & 0x1249249249249249ULL;
}

std::uint64_t morton_key(const TriangleMesh& mesh, std::uint32_t triangle) noexcept {
  constexpr double cells = 1 << 21;
  const Aabb& box = mesh.bounds();
  const double scale = (cells - 1) / box.extent().maxCoeff();
  std::uint64_t key = 0;
  for (int k = 0; k < 3; ++k) {
    double offset = 0;
    for (int i = 0; i < 3; ++i) offset += (mesh.corner(triangle, i)[k] - box.min[k]) / 3;
    const double cell = std::clamp(offset * scale, 0.0, cells - 1);
    key |= spread(static_cast<std::uint64_t>(cell)) << k;
  }
  return key;
}

TrianglePlanes infinitely_far() noexcept {
  TrianglePlanes planes{};
  planes.offset += std::numeric_limits<float>::infinity();
  return planes;
}

}  // namespace

TriangleStore TriangleStore::build(const TriangleMesh& mesh) {
  const auto count = static_cast<std::uint32_t>(mesh.size());
  std::vector<Keyed> order(count);
  for (std::uint32_t i = 0; i < count; ++i) order[i] = {morton_key(mesh, i), i};
  std::sort(order.begin(), order.end());

  TriangleStore store;
  store.frame = FilterFrame::around(mesh.bounds());
  store.exact.reserve(count);
  const std::size_t whole = (static_cast<std::size_t>(count) + block_size - 1) / block_size * block_size;
  store.planes.reserve(whole);
  for (const Keyed& next : order) {
    store.exact.push_back(prepare(mesh, next.triangle));
    store.planes.push_back(planes_of(store.exact.back(), store.frame));
  }
  store.planes.resize(whole, infinitely_far());
  store.ids.assign(mesh.ids().begin(), mesh.ids().end());
  return store;
}

std::size_t TriangleStore::bytes() const noexcept {
  return exact.capacity() * sizeof(PreparedTriangle) + planes.capacity() * sizeof(TrianglePlanes) +
         ids.capacity() * sizeof(TriangleId);
}

}  // namespace touchmark::grid
