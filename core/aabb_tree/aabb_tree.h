/// A plain binary tree of axis-aligned boxes in double precision, nearest box first: what every collision
/// library has at its heart, without anything special. The reference that cleverer detectors are measured
/// against.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <type_traits>
#include <vector>

#include "core/aabb.h"
#include "core/detector.h"
#include "core/geometry/distance_error.h"
#include "core/geometry/point_triangle.h"
#include "core/mesh_motion.h"
#include "core/mesh_update.h"
#include "core/search/linear_scan.h"

namespace touchmark {

/// A binary tree of axis-aligned boxes over the triangles; satisfies Detector, Updates and every query.
class AabbTree {
 public:
  /// What `build` may be told.
  struct Options {
    std::size_t leaf_size = 4;  ///< triangles a leaf holds at most, 1 to 255
    bool certified = true;      ///< false: as doubles have it, to measure what certainty costs
    unsigned threads = 1;       ///< build it, at most 256; 0: as many as there are processors; the same bits
  };
  /// What one haptic point remembers between ticks.
  struct Session {
    Work work;
    /// Slot of the triangle of the last contact, if there was one: `touches` asks it first, and its distance
    /// bounds `nearest`.
    std::uint32_t last = no_triangle;
  };
  static constexpr std::uint32_t no_triangle = std::numeric_limits<std::uint32_t>::max();

  /// Throws std::invalid_argument for a leaf size out of range, or too many threads.
  static AabbTree build(const TriangleMesh& mesh, const Options& options);
  static AabbTree build(const TriangleMesh& mesh) { return build(mesh, Options()); }
  /// See the concept Updates. The boxes follow their triangles; where they would make queries dearer by more
  /// than `max_growth`, the tree is built anew.
  void update(const TriangleMesh& mesh);

  bool touches(const Probe& probe, Session& session) const noexcept;
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept;
  /// See the concept AnswersWithinBudget.
  Bracket nearest(const Probe& probe, double reach, Session& session, std::uint64_t budget) const noexcept;
  std::optional<Impact> first_hit(const Sweep& sweep, Session& session) const noexcept;
  /// See the concept AnswersMovingSweep.
  std::optional<Impact> first_hit_moving(const Sweep& sweep, const MeshMotion& motion,
                                         Session& session) const noexcept;
  std::size_t contacts(const Probe& probe, double reach, Session& session,
                       std::span<Contact> into) const noexcept;

  std::size_t bytes() const noexcept;
  Accuracy accuracy() const noexcept { return certified_ ? certified : uncertified; }

  /// Calls visit(triangle) for every triangle in a leaf whose box is within `reach` of the centre: a broad
  /// phase for libraries that have none. Misses no triangle whose computed distance is at most the reach. A
  /// visit that returns bool ends it by returning true.
  template <class Visit>
  void for_each_near(const Vec3& center, double reach, Work& work, const Visit& visit) const noexcept {
    const double pad = culling_pad(largest_difference(bounds(), center));
    std::array<std::uint32_t, max_levels> stack;
    std::size_t count = 0;
    stack[count++] = 0;
    while (count > 0) {
      const Node& node = nodes_[stack[--count]];
      ++work.boxes;
      if (lower_bound(node.box, center, pad) > reach) continue;
      if (node.count == 0) {
        stack[count++] = node.first + 1;
        stack[count++] = node.first;
        continue;
      }
      work.triangles += node.count;
      for (std::uint32_t i = node.first; i < node.first + node.count; ++i) {
        if constexpr (std::is_same_v<decltype(visit(triangles_[i])), bool>) {
          if (visit(triangles_[i])) return;
        } else {
          visit(triangles_[i]);
        }
      }
    }
  }

 private:
  friend class FloatTree;  // the same tree, rounded
  struct Node {
    Aabb box;
    std::uint32_t first =
        0;  ///< a leaf's first triangle, or the first of two children that follow one another
    std::uint32_t count = 0;  ///< a leaf's triangles; 0 in an inner node
  };
  /// Splits halve from `halving_level` on, so 32 more levels reach a single triangle of 2^32.
  static constexpr std::size_t halving_level = 48, max_levels = halving_level + 34;
  static constexpr double max_growth = 2;  ///< factor of expected_cost

  class Builder;

  /// What the distance of a triangle in the box cannot fall below, as the kernel computes it.
  static double lower_bound(const Aabb& box, const Vec3& center, double pad) noexcept;
  const Aabb& bounds() const noexcept { return nodes_.front().box; }
  double expected_cost() const noexcept;
  template <class Exhausted>
  std::optional<Contact> search_nearest(const Vec3& center, double reach, Session& session,
                                        std::uint64_t budget, const Exhausted& exhausted) const noexcept;
  LinearScan fallback() const noexcept { return {triangles_, bounds(), ids_, certified_}; }
  std::uint64_t work_limit(const Work& work) const noexcept {
    return work.boxes + work.triangles + work_budget(triangles_.size());
  }

  Options options_;
  Connectivity connectivity_;
  double cost_as_built_ = 0;  ///< 0: not asked for yet
  bool certified_ = true;
  std::vector<Node> nodes_;
  std::vector<PreparedTriangle> triangles_;  ///< in the order of the leaves
  TriangleIds ids_;
};

}  // namespace touchmark
