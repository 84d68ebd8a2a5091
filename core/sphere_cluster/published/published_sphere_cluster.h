/// The sphere-cluster detector as published: A. R. Choi and M. Y. Sung, "Performance improvement of haptic
/// collision detection using subdivision surface and sphere clustering", PLoS ONE 12(9), 2017.
///
/// Bounding spheres of triangles are clustered by distance. A query tests the HIP against every sphere, the
/// fast level, and then searches the triangles of the spheres that it meets, the precise level. A ball of
/// radius r meets a sphere when the bare HIP meets the sphere enlarged by r, so every answer is exact.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "core/aabb.h"
#include "core/detector.h"
#include "core/geometry/point_triangle.h"
#include "core/mesh_update.h"
#include "core/search/linear_scan.h"
#include "core/sphere_cluster/clustering.h"
#include "core/sphere_cluster/published/fast_level.h"
#include "core/sphere_cluster/published/sphere_arrays.h"

namespace touchmark {

class ClosestCandidates;

/// The sphere-cluster detector as published; satisfies Detector, Updates and every query.
class PublishedSphereCluster {
 public:
  /// What `build` may be told; the defaults are the exact form.
  struct Options {
    double clustering = 0;  ///< distance between centroids that share a sphere, mesh units; 0: a sphere each
    bool precise = true;    ///< false: the fast level alone; spheres answer in place of their triangles
    VisitOrder order = VisitOrder::breadth_first;  ///< in which triangles are clustered
  };
  /// The work counters; nothing else is remembered.
  struct Session {
    Work work;
  };

  /// Throws std::invalid_argument for a clustering distance that is negative, infinite or not a number.
  static PublishedSphereCluster build(const TriangleMesh& mesh, const Options& options);
  static PublishedSphereCluster build(const TriangleMesh& mesh) { return build(mesh, Options()); }
  /// See the concept Updates. It is built anew.
  void update(const TriangleMesh& mesh);

  bool touches(const Probe& probe, Session& session) const noexcept;
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept;
  std::optional<Impact> first_hit(const Sweep& sweep, Session& session) const noexcept;
  std::size_t contacts(const Probe& probe, double reach, Session& session,
                       std::span<Contact> into) const noexcept;

  std::size_t bytes() const noexcept;
  /// precise: exact. Else conservative: contacts come early, by at most `absolute`.
  Accuracy accuracy() const noexcept;

  /// The clustered spheres, for drawing and for the paper's tables.
  const SphereClusters& clusters() const noexcept { return clusters_; }
  /// The paper's measure of how closely they fit; see average_tightness.
  double tightness() const noexcept { return tightness_; }

 private:
  LinearScan fallback() const noexcept { return {triangles_, bounds_, ids_}; }
  void search(std::size_t sphere, const Vec3& center, ClosestCandidates& candidates,
              Work& work) const noexcept;

  /// Calls found(i) for every sphere i that reaches within `reach` of the centre, until it returns true.
  template <class Found>
  bool for_each_met(const Vec3& center, double reach, const Found& found) const noexcept;

  Options options_;
  Connectivity connectivity_;
  SphereClusters clusters_;
  double tightness_ = 0;
  FastLevel fast_;  ///< Filled only without the precise level, which uses the members below.
  Aabb bounds_;
  SphereArrays spheres_;
  std::vector<PreparedTriangle> triangles_;  ///< in the order of their spheres
  TriangleIds ids_;
};

}  // namespace touchmark
