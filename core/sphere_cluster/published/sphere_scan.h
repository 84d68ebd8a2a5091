/// Choi & Sung's two-level detection as published: the fast level tests the HIP against every sphere, the
/// precise level searches the triangles of the spheres that it meets. A ball of radius r meets a sphere when
/// the bare HIP meets the sphere enlarged by r, so every answer is exact.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/aabb.h"
#include "core/detector.h"
#include "core/geometry/point_triangle.h"
#include "core/search/linear_scan.h"
#include "core/sphere_cluster/clustering.h"
#include "core/sphere_cluster/published/sphere_arrays.h"

namespace touchmark {

class ClosestCandidates;

class SphereScan {
 public:
  SphereScan() = default;
  SphereScan(const TriangleMesh& mesh, const SphereClusters& clusters);

  // A radius or reach must be at least 0.
  bool touches(const Probe& probe, Work& work) const noexcept;
  std::optional<Contact> nearest(const Vec3& center, double reach, Work& work) const noexcept;
  std::optional<Impact> first_hit(const Sweep& sweep, Work& work) const noexcept;
  std::size_t contacts(const Vec3& center, double reach, std::span<Contact> into, Work& work) const noexcept;
  std::size_t bytes() const noexcept;

 private:
  LinearScan fallback() const noexcept { return {triangles_, bounds_, ids_}; }
  void search(std::size_t sphere, const Vec3& center, ClosestCandidates& candidates,
              Work& work) const noexcept;

  /// Calls found(i) for every sphere i that reaches within `reach` of the centre, until it returns true.
  template <class Found>
  bool for_each_met(const Vec3& center, double reach, const Found& found) const noexcept;

  Aabb bounds_;
  SphereArrays spheres_;
  std::vector<std::uint32_t> first_;         // sphere i holds triangles_[first_[i]] .. before first_[i + 1]
  std::vector<PreparedTriangle> triangles_;  // in the order of their spheres
  TriangleIds ids_;
};

}  // namespace touchmark
