/// The points at which a distance field is sampled.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include <Eigen/Core>

#include "core/simd/lanes.h"

namespace touchmark {

/// The middles of cubes that fill a box, in the filter's frame.
class SampleLattice {
 public:
  SampleLattice() = default;
  /// Holds the box and a tenth of its extent around it, in at most so many cubes.
  SampleLattice(const Eigen::Vector3f& min, const Eigen::Vector3f& max, std::uint32_t max_samples);
  /// Each cube cut in eight.
  SampleLattice halved() const noexcept;

  std::uint32_t count(int axis) const noexcept { return count_[static_cast<std::size_t>(axis)]; }
  std::size_t size() const noexcept { return std::size_t{count_[0]} * count_[1] * count_[2]; }
  float edge() const noexcept { return edge_; }
  float per_edge() const noexcept { return per_edge_; }
  float min(int axis) const noexcept { return min_[axis]; }
  float max(int axis) const noexcept { return max_[axis]; }

  std::uint32_t index(std::uint32_t x, std::uint32_t y, std::uint32_t z) const noexcept {
    return (z * count_[1] + y) * count_[0] + x;
  }
  /// The coordinate of a sample; the same bits wherever it is asked for.
  float middle(int axis, std::uint32_t i) const noexcept {
    return min(axis) + (static_cast<float>(i) + 0.5F) * edge_;
  }
  /// The nearest point of the box. Of lanes x, y and z; here and below, the last one means nothing.
  Lanes clamped(Lanes point) const noexcept { return simd::min(simd::max(point, min_), max_); }
  /// The cube that a point of the box is in; the nearest one to a point beyond.
  LaneBits cube_of(Lanes point) const noexcept { return whole((point - min_) * per_edge_, last_); }
  /// Returns the first in each direction of the eight cubes whose middles are around a point of the box.
  /// There must be two in each direction.
  LaneBits first_around(Lanes point) const noexcept {
    return whole((point - min_) * per_edge_ - 0.5F, last_ - 1);
  }
  std::uint32_t index(LaneBits cube) const noexcept {
    return index(static_cast<std::uint32_t>(cube[0]), static_cast<std::uint32_t>(cube[1]),
                 static_cast<std::uint32_t>(cube[2]));
  }
  Lanes middle(LaneBits cube) const noexcept {
    return min_ + (__builtin_convertvector(cube, Lanes) + 0.5F) * edge_;
  }

 private:
  static LaneBits whole(Lanes at, Lanes last) noexcept {
    return __builtin_convertvector(simd::min(simd::max(at, Lanes{}), last), LaneBits);
  }
  void set_count(const std::array<std::uint32_t, 3>& count) noexcept;

  Lanes min_{}, max_{};
  Lanes last_{};  ///< count_ less one
  float edge_ = 1, per_edge_ = 1;
  std::array<std::uint32_t, 3> count_{};
};

}  // namespace touchmark
