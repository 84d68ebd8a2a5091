#include "core/search/distance_field/distance_field.h"

namespace touchmark {

SampleLattice::SampleLattice(const Eigen::Vector3f& min, const Eigen::Vector3f& max,
                             std::uint32_t max_samples) {
  const Eigen::Vector3f extent = max - min;
  // The box and its surroundings in cubes, of which there are at most so many.
  const auto counts = [&](float edge) {
    std::array<std::uint32_t, 3> count;
    for (int k = 0; k < 3; ++k)
      count[static_cast<std::size_t>(k)] = static_cast<std::uint32_t>(1.2F * extent[k] / edge) + 1;
    return count;
  };
  edge_ = 1.2F * extent.maxCoeff() / std::cbrt(static_cast<float>(max_samples));
  // A flat box needs fewer cubes than it may have, so they may be smaller, but not without end.
  constexpr float finer = 0.9F;
  const float finest = extent.maxCoeff() / 128;
  const auto fits = [&](float edge) {
    const std::array<std::uint32_t, 3> count = counts(edge);
    return std::uint64_t{count[0]} * count[1] * count[2] <= max_samples;
  };
  while (!fits(edge_)) edge_ /= finer;
  while (edge_ > finest && fits(edge_ * finer)) edge_ *= finer;
  set_count(counts(edge_));
  per_edge_ = 1 / edge_;
  for (int k = 0; k < 3; ++k) {
    const auto axis = static_cast<std::size_t>(k);
    const float middle = 0.5F * (min[k] + max[k]), half = 0.5F * edge_ * static_cast<float>(count_[axis]);
    min_[axis] = std::min(middle - half, min[k]);
    max_[axis] = std::max(middle + half, max[k]);
  }
}

void SampleLattice::set_count(const std::array<std::uint32_t, 3>& count) noexcept {
  count_ = count;
  for (std::size_t axis = 0; axis < 3; ++axis) last_[axis] = static_cast<float>(count[axis] - 1);
}

SampleLattice SampleLattice::halved() const noexcept {
  SampleLattice half = *this;
  half.edge_ *= 0.5F;
  half.per_edge_ *= 2;
  half.set_count({2 * count_[0], 2 * count_[1], 2 * count_[2]});
  return half;
}

DistanceField::DistanceField(const Eigen::Vector3f& min, const Eigen::Vector3f& max, std::size_t triangles) {
  // As many as pay: 64 kilobytes stay in the second cache. A small mesh can have more for each triangle.
  constexpr std::size_t fewest = 8, max_of_small = std::size_t{1} << 10, most = std::size_t{1} << 13;
  const std::size_t samples = std::max(std::min(triangles / 4, max_of_small), triangles / 8);
  coarse_ = SampleLattice(min, max, static_cast<std::uint32_t>(std::clamp(samples, fewest, most)));
  fine_ = coarse_.halved();
  constexpr float steps_an_edge = 8;
  step_ = std::ldexp(1.0F, std::ilogb(fine_.edge() / steps_an_edge));
  // From the middle of a cube it is less than the box's extent to anywhere in it.
  constexpr int bits = 15;
  const float across =
      coarse_.edge() * static_cast<float>(std::max({coarse_.count(0), coarse_.count(1), coarse_.count(2)}));
  vector_step_ = std::ldexp(1.0F, std::ilogb(across) + 1 - bits);
}

DistanceField DistanceField::around(const FilterFrame& frame, const Aabb& bounds, std::size_t triangles) {
  // The samples lie within a tenth and a cube of the mesh's box, whose coordinates are below 2. Their places
  // are rounded when they are taken, and half of the 2^-23 that a sample may be off by is left for the rest.
  constexpr double largest = 4;
  if (!(frame.from_frame_error(largest) < 0x1p-24)) return {};
  const Aabb box = frame.to_frame(bounds);
  return {box.min.cast<float>(), box.max.cast<float>(), triangles};
}

// The square of the distance, less that of the position, is concave, so between samples it is at least what
// lies linearly between theirs: with t of the way from one to the next, t (1 - t) of the square of that way
// less for the square of the distance.
float DistanceField::tight_lower_bound(const FilterPoint& p) const noexcept {
  if (fine_steps_.empty()) return 0;
  const Lanes point = lanes_of(p), nearest = fine_.clamped(point);
  const LaneBits first = fine_.first_around(nearest);
  const Lanes from_first = (nearest - fine_.middle(first)) * fine_.per_edge();
  const Lanes t = simd::min(simd::max(from_first, Lanes{}), broadcast(1)), rest = 1 - t;
  const std::uint32_t row = fine_.count(0), plane = row * fine_.count(1);
  const auto step_count = [&](std::uint32_t cube) { return static_cast<float>(fine_steps_[cube].load()); };
  const auto steps = [&](std::uint32_t at) {
    return Lanes{step_count(at), step_count(at + 1), step_count(at + row), step_count(at + row + 1)};
  };
  const std::uint32_t at = fine_.index(first);
  const Lanes near_plane = steps(at), far_plane = steps(at + plane);
  const Lanes in_plane = Lanes{rest[0], t[0], rest[0], t[0]} * Lanes{rest[1], rest[1], t[1], t[1]};
  const Lanes along = near_plane * near_plane * rest[2] + far_plane * far_plane * t[2];
  const Lanes weighted = in_plane * along, lost = t * rest;
  // Rounding of the point and of t is as if the point were elsewhere; both sums are of few roundings each.
  const float between = (weighted[0] + weighted[1] + weighted[2] + weighted[3]) * (step_ * step_);
  const float less = (lost[0] + lost[1] + lost[2]) * (fine_.edge() * fine_.edge());
  const float interpolated = between * (1 - sum_error) - less * (1 + sum_error);
  const Lanes outside = (from_first - t) * fine_.edge();
  const float within = interpolated > 0 ? root(interpolated) - root(squared(outside)) - interpolation_pad : 0;
  return beyond_box(p, point - nearest, within);
}

bool DistanceField::holds(const FilterFrame& frame, const Aabb& bounds) const noexcept {
  const Aabb box = frame.to_frame(bounds);
  const Eigen::Vector3f min = box.min.cast<float>(), max = box.max.cast<float>();
  for (int k = 0; k < 3; ++k)
    if (min[k] < fine_.min(k) || max[k] > fine_.max(k)) return false;
  return true;
}

}  // namespace touchmark
