/// Every triangle, every time: what both papers call "without grouping" and "without clustering", and the
/// reference that every other detector here must equal bit for bit.
#pragma once

#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "core/aabb.h"
#include "core/detector.h"
#include "core/geometry/point_triangle.h"
#include "core/mesh_motion.h"
#include "core/mesh_update.h"
#include "core/search/linear_scan.h"

namespace touchmark {

/// Every triangle at every query; satisfies Detector, Updates and every query.
class BruteForce {
 public:
  /// There is nothing to choose.
  struct Options {};
  /// The work counters; nothing else is remembered.
  struct Session {
    Work work;
  };

  static BruteForce build(const TriangleMesh& mesh, const Options& options = {});
  /// See the concept Updates.
  void update(const TriangleMesh& mesh);

  bool touches(const Probe& probe, Session& session) const noexcept;
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept;
  std::optional<Impact> first_hit(const Sweep& sweep, Session& session) const noexcept;
  /// See the concept AnswersMovingSweep.
  std::optional<Impact> first_hit_moving(const Sweep& sweep, const MeshMotion& motion,
                                         Session& session) const noexcept;
  std::size_t contacts(const Probe& probe, double reach, Session& session,
                       std::span<Contact> into) const noexcept;

  std::size_t bytes() const noexcept;
  Accuracy accuracy() const noexcept { return certified; }

 private:
  LinearScan scan() const noexcept { return {triangles_, bounds_, ids_}; }

  Connectivity connectivity_;
  Aabb bounds_;
  std::vector<PreparedTriangle> triangles_;
  TriangleIds ids_;
};

}  // namespace touchmark
