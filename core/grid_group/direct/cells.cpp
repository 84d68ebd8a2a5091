#include "core/grid_group/direct/cells.h"

#include <algorithm>
#include <cmath>

#include "core/bvh/sampler.h"
#include "core/search/linear_scan.h"
#include "core/search/threads/parallel.h"

namespace touchmark::grid {

Cells::Cells(const Aabb& bounds, double edge, std::size_t triangles, std::size_t max_bytes) {
  constexpr double larger = 1.0625;
  const Vec3 extent = bounds.extent();
  const double most = static_cast<double>(edge > 0 ? max_bytes / sizeof(std::uint32_t)
                                                   : std::min(max_bytes / sizeof(std::uint32_t), triangles));
  edge_ = edge > 0 ? edge : extent.maxCoeff() / static_cast<double>(triangles + 1);
  // One beyond the box on either side.
  const auto along = [&](int k) { return std::floor(extent[k] / edge_) + 3; };
  while (along(0) * along(1) * along(2) > most && edge_ <= extent.maxCoeff()) edge_ *= larger;
  coarsened_ = edge > 0 && edge_ > edge;
  if (along(0) * along(1) * along(2) > most) return;
  origin_ = bounds.min - Vec3::Constant(edge_);
  for (int k = 0; k < 3; ++k) counts_[static_cast<std::size_t>(k)] = static_cast<std::size_t>(along(k));
  slots_.assign(counts_[0] * counts_[1] * counts_[2], nowhere);
}

void Cells::fill(const WideBvh& bvh, unsigned threads) {
  constexpr std::size_t cells_a_piece = 1024;
  const FilterFrame& frame = bvh.frame();
  in_ranges(slots_.size(), cells_a_piece, threads, [&](std::size_t first, std::size_t end) {
    bvh::Sampler sampler(bvh, any_work, 0);
    for (std::size_t number = first; number < end; ++number) {
      const Vec3 middle = middle_of(number);
      slots_[number] = nowhere;
      // What is near no part of the surface starts nowhere.
      if (static_cast<double>(bvh.distances().lower_bound(frame.point(middle))) > edge_ * frame.scale())
        continue;
      const double reach = edge_ * frame.scale();
      if (sampler(frame.to_frame(middle), reach).upper < reach) slots_[number] = sampler.near();
    }
  });
}

void Cells::clear() noexcept { std::fill(slots_.begin(), slots_.end(), nowhere); }

void Cells::name(const Vec3& center, std::uint32_t slot) const noexcept {
  if (const std::size_t number = number_of(center); number < slots_.size())
    slots_[number].replace(nowhere, slot);
}

std::size_t Cells::number_of(const Vec3& center) const noexcept {
  std::size_t number = 0;
  for (int k = 2; k >= 0; --k) {
    const std::size_t count = counts_[static_cast<std::size_t>(k)];
    const double along = (center[k] - origin_[k]) / edge_;
    if (!(along >= 0 && along < static_cast<double>(count))) return slots_.size();
    number = number * count + static_cast<std::size_t>(along);
  }
  return number;
}

Vec3 Cells::middle_of(std::size_t number) const noexcept {
  const std::size_t x = number % counts_[0], yz = number / counts_[0];
  const Vec3 at(static_cast<double>(x), static_cast<double>(yz % counts_[1]),
                static_cast<double>(yz / counts_[1]));
  return origin_ + edge_ * (at + Vec3::Constant(0.5));
}

Aabb Cells::box_of(const Vec3& center) const noexcept {
  const std::size_t number = number_of(center);
  if (number >= slots_.size()) return {};
  const Vec3 half = Vec3::Constant(edge_ / 2), middle = middle_of(number);
  return {middle - half, middle + half};
}

}  // namespace touchmark::grid
