/// Distances from points to the mesh, to about a seventh, for the field of sampled distances.
#pragma once

#include <cstdint>

#include "core/bvh/wide_bvh.h"
#include "core/search/distance_field/distance_field.h"

namespace touchmark::bvh {

/// Samples one point after the other, each near the last one. Positions and distances are in the frame.
class Sampler {
 public:
  /// All samples together take no more work than `budget`; the first starts at the triangle in slot `near`.
  Sampler(const WideBvh& bvh, std::uint64_t budget, std::uint32_t near) noexcept
      : bvh_(bvh), budget_(budget), near_(near) {}

  /// Bounds the distance at a position, which is at most `max_distance`; negative when that is too much work.
  DistanceField::Interval operator()(const Vec3& position, double max_distance) noexcept;
  /// Returns the distance to the triangle in a slot, where the next sample starts.
  double distance_to(std::uint32_t near, const Vec3& position) noexcept;

  std::uint32_t near() const noexcept { return near_; }
  const Vec3& to_mesh() const noexcept { return to_mesh_; }  ///< from the last point to what is near it
  const Work& work() const noexcept { return work_; }

 private:
  const WideBvh& bvh_;
  std::uint64_t budget_;
  std::uint32_t near_;
  Work work_;
  Vec3 to_mesh_ = Vec3::Zero();
};

}  // namespace touchmark::bvh
