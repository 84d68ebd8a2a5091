/// A hierarchy of spheres over a mesh, searched nearest first: the fast exact form of the sphere-cluster
/// detector.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "core/aabb.h"
#include "core/detector.h"
#include "core/geometry/point_triangle.h"
#include "core/search/distance_field.h"
#include "core/search/linear_scan.h"
#include "core/search/plane_filter.h"
#include "core/simd/dispatch.h"
#include "core/sphere_cluster/clustering.h"
#include "core/sphere_cluster/tree/leaf_cache.h"
#include "core/sphere_cluster/tree/node.h"

namespace touchmark {

namespace spheres {
struct MovedTriangles;
}

class SphereTree {
 public:
  /// What a haptic point remembers between ticks: it changes the cost of an answer, never the answer.
  struct Memory {
    std::uint64_t tree = 0;      ///< whose memory this is; 0: nobody's
    Vec3 center = Vec3::Zero();  ///< where the point was
    double free = -1;            ///< no triangle was nearer, all rounding included; -1: nothing is known
    double nearest = std::numeric_limits<double>::infinity();  ///< triangle `last` was that far
    Vec3 move =
        Vec3::Zero();  ///< by which the point had moved then; infinite after `touches`, which lists none
    std::uint32_t last = 0;  ///< where it is kept
    spheres::NearBlocks blocks;
  };

  struct Options {
    Simd widest = Simd::avx512;  ///< no wider instructions; what the processor lacks is not used
    bool certified = true;       ///< false: contact as doubles have it
    bool samples_later = false;  ///< distances are sampled by the first queries that want them
  };

  SphereTree() = default;
  SphereTree(const TriangleMesh& mesh, const SphereClusters& clusters, const Options& options);

  /// The same triangles, some of them elsewhere. What memories hold of before is not believed any more. False
  /// where the mesh is now of another size or at another place: nothing has changed then, and the tree is to
  /// be built anew.
  bool update(const TriangleMesh& mesh);

  /// Is it known, without looking, that no triangle is within reach? The distance changes by no more than the
  /// point moves. Of a tree that holds nothing, nothing is known.
  bool surely_free(const Vec3& center, double reach, const Memory& memory) const noexcept {
    const double room = memory.free - reach;
    return memory.tree == number_ && room > 0 && (center - memory.center).squaredNorm() < room * room;
  }
  // Both look, even where it is surely free.
  bool touches(const Probe& probe, Memory& memory, Work& work) const noexcept;
  /// Where `gives_up` points somewhere, a search that looked at as much as all triangles are ends there, with
  /// that set and no answer.
  std::optional<Contact> nearest(const Vec3& center, double reach, Memory& memory, Work& work,
                                 bool* gives_up = nullptr) const noexcept;
  std::optional<Impact> first_hit(const Sweep& sweep, Memory& memory, Work& work) const noexcept;
  /// Did the last query find a triangle?
  bool is_near(const Memory& memory) const noexcept {
    return memory.tree == number_ && memory.nearest < std::numeric_limits<double>::infinity();
  }
  /// Where it is near: lists what a next query may need, and fetches what it does if the point goes on as it
  /// moved.
  void look_ahead(Memory& memory, Work& work) const noexcept;
  std::size_t bytes() const noexcept;

 private:
  TriangleId id(std::uint32_t index) const noexcept { return ids_.empty() ? index : ids_[index]; }
  bool can_search(const Vec3& center) const noexcept { return searchable_ && frame_.covers(center); }
  bool can_search(const FilterPoint& point) const noexcept {
    return searchable_ && FilterFrame::covers(point);
  }
  void claim(Memory& memory) const noexcept {
    if (memory.tree != number_) start_anew(memory);
  }
  void start_anew(Memory& memory) const noexcept;
  double slack_at(const FilterPoint& point) const noexcept;
  double free_within(float unseen, double shown, double slack) const noexcept;
  bool is_far(const FilterPoint& point, const Vec3& center, double reach, Memory& memory) const noexcept;
  [[gnu::noinline]] bool is_far_once_sampled(const FilterPoint& point, const Vec3& center, double reach,
                                             Memory& memory, std::uint64_t& most, Work& work) const noexcept;
  static void remember_touch(const Vec3& center, double free, double nearest, Memory& memory) noexcept;
  /// From a point of the mesh's frame to another, in the tree's, at least.
  float way(const Vec3& from, const Vec3& to, const FilterPoint& at) const noexcept;

  EveryTriangle all() const noexcept { return {parts_.triangles, bounds_, ids_, certified_}; }
  std::uint64_t most_work() const noexcept { return most_work_before_all(parts_.triangles.size()); }
  std::optional<Contact> nearest_without(const Vec3& center, double reach, Work& work) const noexcept;

  void measure_grain() noexcept;
  void renew() noexcept;
  void fill_distances();
  void refill_distances(const spheres::MovedTriangles& moved);
  struct Sampling {
    std::uint64_t most;      ///< work, of all samples together
    std::uint32_t near = 0;  ///< a triangle near the last place, and so perhaps the next
    Work work{};
  };
  /// Bounds the distance at a place of the frame, which is at most `most`, to about a fifth; negative when
  /// that is too much work.
  DistanceGrid::Interval sample(const Vec3& place, double most, Sampling& sampling) const noexcept;

  // Visitors: see sphere_tree_search.h.
  template <class Visitor>
  void show(std::uint32_t at, Visitor& visitor) const noexcept;
  template <class Visitor>
  void show_all(Visitor& visitor) const noexcept;
  template <class Visitor>
  float descend(const FilterPoint& point, Visitor& visitor, std::uint64_t most) const noexcept;
  template <class Visitor>
  float search_near(const FilterPoint& point, Visitor& visitor, Memory& memory,
                    std::uint64_t most) const noexcept;
  template <class Visitor>
  float search_listed(const FilterPoint& point, Visitor& visitor, const spheres::NearBlocks& blocks,
                      float away, std::uint64_t most) const noexcept;
  bool list_blocks(const Vec3& center, const Vec3& move, float distance, Memory& memory, std::uint64_t most,
                   Work& work) const noexcept;

  std::uint64_t number_ = 0;  ///< of this tree and its copies
  Simd simd_ = Simd::portable;
  bool searchable_ = false;  ///< else the mesh does not fit the frame, and every triangle is looked at
  Aabb bounds_;
  FilterFrame frame_;
  bool certified_ = true;
  double radius_ = 0;  ///< of a ball about the frame's origin that holds the mesh
  double grain_ = 0;   ///< the mean radius of a block
  spheres::TreeParts parts_;
  bool samples_later_ = false;
  DistanceGrid distances_;
  std::vector<TriangleId> ids_;  ///< by mesh index; empty when they are the same
};

}  // namespace touchmark
