/// A sample of a range, the same in every build.
#pragma once

#include <cstdint>

namespace touchmark::bvh {

/// Steps through a range by 1 to 2 mean steps less 1, at random, since what repeats in the order of a mesh's
/// triangles must not repeat in the sample.
class RandomSteps {
 public:
  explicit RandomSteps(std::uint32_t mean) noexcept : steps_(2 * std::uint64_t{mean} - 1) {}

  std::uint32_t next() noexcept {
    if (steps_ == 1) return 1;
    state_ = 1664525 * state_ + 1013904223;  // Numerical Recipes, third edition, 7.1.1
    return 1 + static_cast<std::uint32_t>(steps_ * state_ >> 32);
  }

 private:
  std::uint64_t steps_;
  std::uint32_t state_ = 1;
};

}  // namespace touchmark::bvh
