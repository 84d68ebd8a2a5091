/// A hierarchy of bounding volumes over a mesh, eight children a node, with sampled distances around it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/aabb.h"
#include "core/bvh/clusters.h"
#include "core/bvh/node.h"
#include "core/detector.h"
#include "core/search/distance_field/distance_field.h"
#include "core/search/memory/epoch.h"
#include "core/search/plane_filter/plane_filter.h"
#include "core/simd/dispatch.h"
#include "core/triangle_mesh.h"

namespace touchmark {

/// Constant after it is built, but for parts and samples that lazy construction leaves to the first queries
/// that need them; any number of threads may search it. It names no query: traversal.h says what a search is.
class WideBvh {
 public:
  struct Options {
    Simd widest = Simd::avx2;  ///< no wider instructions; what the processor lacks is not used
    bool lazy = false;     ///< parts are built, and distances sampled, by the first queries that want them
    unsigned threads = 1;  ///< build it, at least 1; the same bits
  };

  WideBvh() = default;
  /// Without clusters each triangle is its own one, and with `lazy` parts of the tree are left to the
  /// queries.
  WideBvh(const TriangleMesh& mesh, const bvh::Clusters* clusters, const Options& options);

  /// Takes the same triangles, some of them elsewhere, and a new epoch. Returns boxes of the frame each of
  /// which holds some triangles that moved, as they were and as they are; nothing where the mesh is now of
  /// another size or at another position: nothing has changed then, and the hierarchy is to be built anew.
  std::optional<std::vector<Aabb>> update(const TriangleMesh& mesh);
  std::size_t bytes() const noexcept;

  const Epoch& epoch() const noexcept { return epoch_; }  ///< epoch of the triangles as they are
  Simd simd() const noexcept { return simd_; }
  bool is_lazy() const noexcept { return lazy_; }
  const Aabb& bounds() const noexcept { return bounds_; }       ///< mesh units
  const FilterFrame& frame() const noexcept { return frame_; }  ///< the tree's
  const bvh::Parts& parts() const noexcept { return parts_; }   ///< nodes, blocks and triangles by slot
  const TriangleIds& ids() const noexcept { return ids_; }      ///< those of the mesh, by index
  const DistanceField& distances() const noexcept { return distances_; }
  double radius() const noexcept {
    return radius_;
  }  ///< the ball around the frame's origin that holds the mesh
  double mean_leaf_radius() const noexcept { return mean_leaf_radius_; }

  /// False where the mesh or the place does not fit the frame: then every triangle is to be looked at.
  bool can_search(const Vec3& center) const noexcept { return searchable_ && frame_.covers(center); }
  bool can_search(const FilterPoint& point) const noexcept {
    return searchable_ && FilterFrame::covers(point);
  }
  /// Returns a lower bound of the distance by the mesh's box, in mesh units; may be negative.
  [[gnu::always_inline]] double clearance_by_box(const Vec3& center) const noexcept {
    return beyond_box(center, center) - box_margin_;
  }
  /// True if nothing is within reach, by the mesh's box.
  [[gnu::always_inline]] bool is_beyond_box(const Vec3& center, double reach) const noexcept {
    return beyond_box(center, center) > reach + box_margin_;
  }
  /// True if that holds on all of a path. Longer paths round more.
  [[gnu::always_inline]] bool is_beyond_box(const Sweep& sweep) const noexcept {
    return beyond_box(sweep.from.cwiseMin(sweep.to), sweep.from.cwiseMax(sweep.to)) >
               sweep.radius + box_margin_ &&
           (sweep.to - sweep.from).squaredNorm() < max_squared_beyond_box_;
  }

 private:
  /// Returns by how much what is between these two is beyond the mesh's box, along the axis where it is most.
  [[gnu::always_inline]] double beyond_box(const Vec3& min, const Vec3& max) const noexcept {
    return (bounds_.min - max).cwiseMax(min - bounds_.max).maxCoeff();
  }
  bvh::Parts build_parts(const TriangleMesh& mesh, const bvh::Clusters* clusters) const;
  void measure_box() noexcept;
  void measure_leaves() noexcept;
  void fill_distances();
  void refill_distances(std::size_t moved, const std::vector<Aabb>& boxes);

  Epoch epoch_ = Epoch::next();
  Simd simd_ = Simd::portable;
  bool searchable_ = false;  ///< else the mesh does not fit the frame
  Aabb bounds_;
  FilterFrame frame_;
  double radius_ = 0;
  double mean_leaf_radius_ = 0;
  /// How much farther than the reach the mesh's box must be to answer, and of how long a path, squared: then
  /// the margin is far more than all rounding on the way to an answer.
  double box_margin_ = std::numeric_limits<double>::infinity(), max_squared_beyond_box_ = 0;
  bvh::Parts parts_;
  bool lazy_ = false;
  unsigned threads_ = 1;
  DistanceField distances_;
  TriangleIds ids_;
};

}  // namespace touchmark
