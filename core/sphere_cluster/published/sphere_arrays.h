/// Spheres as the published level 1 tests them: every one, by a loop without a branch.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/geometry/smallest_sphere.h"

namespace touchmark {

/// Plain arrays, so that the loop vectorises.
struct SphereArrays {
  std::vector<double> x, y, z, radius;

  SphereArrays() = default;
  explicit SphereArrays(std::span<const Sphere> spheres) {
    for (std::vector<double>* values : {&x, &y, &z, &radius}) values->reserve(spheres.size());
    for (const Sphere& sphere : spheres) {
      x.push_back(sphere.center.x());
      y.push_back(sphere.center.y());
      z.push_back(sphere.center.z());
      radius.push_back(sphere.radius);
    }
  }

  std::size_t size() const noexcept { return x.size(); }
  Vec3 center(std::size_t i) const noexcept { return {x[i], y[i], z[i]}; }
  std::size_t bytes() const noexcept { return 4 * x.capacity() * sizeof(double); }
};

/// Calls `found(i)` for every i < count with outside(i) false, in order, until it returns true. `outside` is
/// evaluated in blocks, and may change with what `found` does from one block to the next.
template <class Outside, class Found>
bool for_each_held(std::size_t count, const Outside& outside, const Found& found) noexcept {
  constexpr std::size_t block = 32;
  std::array<std::uint8_t, block> out;
  for (std::size_t begin = 0; begin < count; begin += block) {
    const std::size_t size = std::min(block, count - begin);
    std::uint8_t all_out = 1;
    for (std::size_t i = 0; i < size; ++i) {
      out[i] = outside(begin + i);
      all_out &= out[i];
    }
    if (all_out != 0) continue;
    for (std::size_t i = 0; i < size; ++i)
      if (out[i] == 0 && found(begin + i)) return true;
  }
  return false;
}

}  // namespace touchmark
