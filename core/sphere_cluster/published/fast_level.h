/// Choi & Sung's fast level alone: the probe against the spheres, no triangle looked at. A sphere holds its
/// triangles, so a contact is never missed; it may be reported too early, by at most the largest radius.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/detector.h"
#include "core/sphere_cluster/clustering.h"
#include "core/sphere_cluster/published/sphere_arrays.h"

namespace touchmark {

/// The sphere that counts is the one with the least |p - c| - R, then the first. The contact's point is that
/// sphere's nearest to the probe's centre p (p itself inside, at distance 0), the normal runs from the
/// sphere's centre to p, the triangle is the cluster's leader. A swept probe hits where it first touches a
/// sphere.
class FastLevel {
 public:
  FastLevel() = default;
  FastLevel(const TriangleMesh& mesh, const SphereClusters& clusters);

  // A radius or reach must be at least 0.
  bool touches(const Probe& probe, Work& work) const noexcept;
  std::optional<Contact> nearest(const Vec3& center, double reach, Work& work) const noexcept;
  std::optional<Impact> first_hit(const Sweep& sweep, Work& work) const noexcept;
  /// One contact for each sphere within the reach, in the order of `nearest`.
  std::size_t contacts(const Vec3& center, double reach, std::span<Contact> into, Work& work) const noexcept;
  /// True distance minus reported distance lies between 0 and this, up to kernel_relative_error: a sphere
  /// holds its triangles and is centred on one of them. The largest radius plus the rounding of a centroid.
  double error_bound() const noexcept { return error_bound_; }
  std::size_t bytes() const noexcept;

 private:
  double gap(std::size_t sphere, const Vec3& center) const noexcept;
  Contact contact_with(std::size_t sphere, const Vec3& center) const noexcept;

  /// Calls found(i) for every sphere i with gap(i) <= limit, and maybe for others, until it returns true.
  /// `limit` may shrink between calls.
  template <class Found>
  void for_each_within(const double& limit, const Vec3& center, const Found& found) const noexcept;

  SphereArrays spheres_;
  std::vector<TriangleId> ids_;  // of each sphere's leader
  double error_bound_ = 0;
};

}  // namespace touchmark
