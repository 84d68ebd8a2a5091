/// A hierarchy of spheres over a mesh, searched nearest first: the fast exact form of the sphere-cluster
/// detector.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/aabb.h"
#include "core/detector.h"
#include "core/geometry/point_triangle.h"
#include "core/search/close_triangles.h"
#include "core/search/distance_field.h"
#include "core/search/epoch.h"
#include "core/search/last_distance.h"
#include "core/search/last_question.h"
#include "core/search/linear_scan.h"
#include "core/search/plane_filter.h"
#include "core/simd/dispatch.h"
#include "core/sphere_cluster/clustering.h"
#include "core/sphere_cluster/tree/followed_point.h"
#include "core/sphere_cluster/tree/leaf_cache.h"
#include "core/sphere_cluster/tree/neighborhood.h"
#include "core/sphere_cluster/tree/node.h"

namespace touchmark {

class ContactsWithin;
struct ListedTriangles;
class FirstTouch;

namespace spheres {
struct MovedTriangles;
class SweepCandidates;
}  // namespace spheres

class SphereTree {
 public:
  /// What a haptic point remembers between ticks. The lower bound holds with all rounding included; the upper
  /// one is the computed distance of the triangle in `slot`.
  struct Memory : LastDistance {
    /// By which the point had moved then; infinite after `touches`, which refills no cache.
    Vec3 move = Vec3::Zero();
    /// A place that was found to be farther from the mesh than a radius, exactly; below 0: there is none.
    Vec3 free_center = Vec3::Zero();
    double free_radius = -1;
    spheres::LeafCache cache;
    spheres::Neighborhood neighborhood;
    /// The planes of the triangle that `touches` found last, in one line, and its slot.
    TrianglePlanes touched{};
    std::uint32_t touched_slot = std::numeric_limits<std::uint32_t>::max();
    /// So many more questions are for the mesh's box, which answered last.
    std::uint32_t for_box = 0;

    /// Becomes as a new one is, and that in a few stores.
    void start_anew() noexcept {
      static_cast<LastDistance&>(*this) = {};
      move = free_center = Vec3::Zero();
      free_radius = -1;
      cache.start_anew();
      neighborhood.start_anew();
      touched_slot = std::numeric_limits<std::uint32_t>::max();
      for_box = 0;
    }
    /// Is it known that a ball there does not touch?
    bool knows_free(const Vec3& at, double radius) const noexcept {
      return radius <= free_radius && at == free_center;
    }
  };

  struct Options {
    Simd widest = Simd::avx2;  ///< no wider instructions; what the processor lacks is not used
    bool certified = true;     ///< false: contact as doubles have it
    bool lazy = false;         ///< distances are sampled by the first queries that want them
    unsigned threads = 1;      ///< build it, at least 1; the same bits
  };

  SphereTree() = default;
  /// Without clusters each triangle is its own one, and with `lazy` parts of the tree are left to the
  /// queries.
  SphereTree(const TriangleMesh& mesh, const SphereClusters* clusters, const Options& options);

  /// Takes the same triangles, some of them elsewhere. What memories hold of before is not believed any more.
  /// Returns false where the mesh is now of another size or at another position: nothing has changed then,
  /// and the tree is to be built anew.
  bool update(const TriangleMesh& mesh);

  /// Is it known, without looking, that no triangle is within reach? The distance changes by no more than the
  /// point moves. Of a tree that holds nothing, nothing is known.
  bool is_clear(const Vec3& center, double reach, const Memory& memory) const noexcept {
    const double margin = memory.lower - reach;
    return memory.epoch == epoch_ && margin > 0 && (center - memory.center).squaredNorm() < margin * margin;
  }
  /// Is it known, without looking, that a triangle is within the radius? The point and that triangle are
  /// within some radii of the mesh then, where clearance_pad is less than this pad and grows by less than
  /// this factor.
  bool is_touching(const Vec3& center, double radius, const Memory& memory) const noexcept {
    const double margin = (radius - 0x1p-40 * radius_) * (1 - 0x1p-38) - memory.upper;
    return memory.epoch == epoch_ && margin > 0 && (center - memory.center).squaredNorm() < margin * margin;
  }
  /// Is that known of a whole path? A ball that holds both its ends holds all of it.
  bool is_clear(const Sweep& sweep, const Memory& memory) const noexcept {
    return is_clear(sweep.from, sweep.radius, memory) && is_clear(sweep.to, sweep.radius, memory);
  }
  /// Is nothing within reach, by the mesh's box?
  [[gnu::always_inline]] bool is_beyond_box(const Vec3& center, double reach) const noexcept {
    return beyond_box(center, center) > reach + box_margin_;
  }
  /// Longer paths round more.
  [[gnu::always_inline]] bool is_beyond_box(const Sweep& sweep) const noexcept {
    return beyond_box(sweep.from.cwiseMin(sweep.to), sweep.from.cwiseMax(sweep.to)) >
               sweep.radius + box_margin_ &&
           (sweep.to - sweep.from).squaredNorm() < longest_beyond_box_;
  }
  /// Is that so now, where nothing was near? Then how far the box is is remembered, as a clearance, and the
  /// next questions are for the box where the point moves too fast for that to be of use.
  [[gnu::always_inline]] bool turns_out_beyond_box(const Vec3& center, double reach,
                                                   Memory& memory) const noexcept {
    if (memory.epoch == epoch_ && memory.is_near()) return false;
    const double clearance = beyond_box(center, center) - box_margin_;
    if (!(clearance > reach)) return false;
    claim(memory);
    // A clearance that lasts twice as long as these questions serves better than the box.
    constexpr std::uint32_t questions = 64;
    const double half = 0.5 * (clearance - reach);
    memory.for_box = (center - memory.center).squaredNorm() < half * half ? 0 : questions;
    remember_touch(center, clearance * (1 - 0x1p-40), std::numeric_limits<double>::infinity(), memory);
    return true;
  }
  [[gnu::always_inline]] bool turns_out_beyond_box(const Sweep& sweep, Memory& memory) const noexcept {
    return is_beyond_box(sweep) && turns_out_beyond_box(sweep.to, sweep.radius, memory);
  }
  /// Is that known of one of many points?
  bool is_clear(const Vec3& center, double reach, const spheres::FollowedPoint& list) const noexcept {
    const double margin = list.covered - reach;
    return list.epoch == epoch_ && list.count == 0 && margin > 0 &&
           (center - list.center).squaredNorm() < margin * margin;
  }
  /// Bounds the distance from below by what is remembered; 0 where nothing is.
  double clearance(const Vec3& center, const Memory& memory) const noexcept {
    if (memory.epoch != epoch_) return 0;
    const double moved = (center - memory.center).norm() * (1 + 0x1p-50);
    return (memory.lower - moved) * (1 - 0x1p-50);
  }
  // All look, even where it is known to be clear. A radius or reach must be at least 0.
  bool touches(const Probe& probe, Memory& memory, Work& work) const noexcept;
  std::optional<Contact> nearest(const Vec3& center, double reach, Memory& memory, Work& work) const noexcept;
  /// Answers of one of many points, of which little is remembered.
  std::optional<Contact> nearest(const Vec3& center, double reach, spheres::FollowedPoint& list,
                                 Work& work) const noexcept;
  /// See the concept TellsCloseTriangles.
  bool close_triangles(const Vec3& center, double reach, double slack, Memory& memory, CloseTriangles& into,
                       Work& work) const noexcept;
  /// See the concept ListsTriangles.
  bool list_triangles(const Vec3& center, double radius, ListedTriangles& into, Work& work) const noexcept;
  std::optional<Impact> first_hit(const Sweep& sweep, Memory& memory, Work& work) const noexcept;
  std::size_t contacts(const Vec3& center, double reach, Memory& memory, std::span<Contact> into,
                       bool counts_all, Work& work) const noexcept;
  /// Refills the cache for the next query where the point is near, and asks the question ahead, where the
  /// point will be if it goes on as it moved, unless that is known to be clear.
  void prepare(const LastQuestion& question, Memory& memory, Work& work) const noexcept;
  std::size_t bytes() const noexcept;

 private:
  /// Returns by how much what is between these two is beyond the mesh's box, along the axis where it is most.
  [[gnu::always_inline]] double beyond_box(const Vec3& min, const Vec3& max) const noexcept {
    return (bounds_.min - max).cwiseMax(min - bounds_.max).maxCoeff();
  }
  bool can_search(const Vec3& center) const noexcept { return searchable_ && frame_.covers(center); }
  bool can_search(const FilterPoint& point) const noexcept {
    return searchable_ && FilterFrame::covers(point);
  }
  void claim(Memory& memory) const noexcept {
    if (memory.epoch != epoch_) start_anew(memory);
  }
  void start_anew(Memory& memory) const noexcept;
  void measure_box() noexcept;
  double clearance_pad(const FilterPoint& point) const noexcept;
  double clearance_from(float unseen, double shown, double pad) const noexcept;
  bool rejects_by_distance_field(const FilterPoint& point, const Vec3& center, double reach,
                                 Memory& memory) const noexcept;
  [[gnu::noinline]] bool rejects_once_sampled(const FilterPoint& point, const Vec3& center, double reach,
                                              Memory& memory, std::uint64_t& budget,
                                              Work& work) const noexcept;
  bool accepts_by_distance_field(const FilterPoint& point, const Vec3& center, double radius,
                                 Memory& memory) const noexcept;
  /// Remembers what `touches` found.
  static void remember_touch(const Vec3& center, double lower, double upper, Memory& memory) noexcept {
    memory.move = Vec3::Constant(std::numeric_limits<double>::infinity());
    memory.center = center;
    memory.lower = lower;
    memory.upper = upper;
  }
  static void remember_nearest(const Vec3& center, std::uint32_t slot, double distance, double pad,
                               Memory& memory) noexcept;
  void remember_planes(Memory& memory) const noexcept;
  bool still_touches(const FilterPoint& point, const Probe& probe, Memory& memory, Work& work) const noexcept;
  /// Returns at least the distance between two points of the mesh's frame, in the tree's.
  float displacement(const Vec3& from, const Vec3& to, const FilterPoint& at) const noexcept;

  template <class Exhausted>
  struct ContactEnds;
  struct CloseEnds;
  template <class Ends>
  auto search_nearest(const Vec3& center, double reach, Memory& memory, Work& work, std::uint64_t budget,
                      const Ends& ends) const noexcept;
  /// The answer of `nearest`, or that the work budget was exhausted before there was one.
  struct WithinBudget {
    std::optional<Contact> contact;
    bool exhausted;
  };
  WithinBudget nearest_within_budget(const Vec3& center, double reach, Memory& memory,
                                     Work& work) const noexcept;
  template <class Visitor>
  bool search_listed(double reach, double error, spheres::FollowedPoint& list,
                     Visitor& visitor) const noexcept;
  bool list_anew(const Vec3& center, double farthest, spheres::FollowedPoint& list,
                 Work& work) const noexcept;
  bool is_sampled_clear(const FilterPoint& point, const Vec3& center, double reach,
                        spheres::FollowedPoint& list) const noexcept;
  template <class Visitor>
  std::optional<Contact> contact_found(const Visitor& visitor, const Vec3& center, double reach, double error,
                                       Work& work) const noexcept;
  spheres::TreeParts build_parts(const TriangleMesh& mesh, const SphereClusters* clusters) const;
  [[gnu::noinline, gnu::cold]] LinearScan fallback(Work& work) const noexcept;
  std::uint64_t work_limit() const noexcept { return work_budget(parts_.triangles.size()); }
  /// Bounds what a query for the nearest takes. A descent looks at each node and block once at most, and so
  /// at no more than this, since a node has two children at least; a list is no longer than that. What it
  /// leaves is for a refill before it.
  std::uint64_t nearest_limit() const noexcept { return parts_.triangles.size() + work_limit(); }
  std::uint64_t refill_limit() const noexcept {
    return remaining(nearest_limit(), spheres::tree_width * (parts_.nodes.size() + parts_.blocks.size()));
  }
  std::optional<Contact> nearest_without(const Vec3& center, double reach, Work& work) const noexcept;

  double sampled_clearance(const FilterPoint& point) const noexcept {
    return static_cast<double>(distances_.lower_bound(point)) * frame_.unit();
  }
  void find_places(const Vec3& from, const Vec3& to, double reach, const spheres::Neighborhood& list,
                   spheres::PlacesInList& places) const noexcept;
  bool is_listed(const Vec3& from, const Vec3& to, double reach,
                 const spheres::Neighborhood& list) const noexcept;
  bool list_around(const Vec3& from, const Vec3& to, double reach, std::uint64_t budget,
                   spheres::Neighborhood& list, Work& work) const noexcept;
  void keep_apart(const Sweep& sweep, spheres::Neighborhood& list, spheres::PlacesInList& places,
                  Work& work) const noexcept;
  bool sweep_listed(const Sweep& sweep, double reach, std::uint64_t budget, FirstTouch& first, Memory& memory,
                    Work& work) const noexcept;
  bool contacts_listed(const Vec3& center, double reach, double error, ContactsWithin& found, Memory& memory,
                       Work& work) const noexcept;
  bool is_sampled_clear(const Sweep& sweep, double length, double reach, Memory& memory) const noexcept;
  bool search_middle(const Sweep& sweep, double length, double reach, std::uint64_t budget,
                     spheres::SweepCandidates& candidates, const Memory& memory, Work& work) const noexcept;
  std::optional<Impact> conclude(const FirstTouch& first, Memory& memory, Work& work) const noexcept;
  bool search_path(const Sweep& sweep, double length, double reach, std::uint64_t budget,
                   spheres::SweepCandidates& candidates, Work& work) const noexcept;

  void measure_leaves() noexcept;
  void fill_distances();
  void refill_distances(const spheres::MovedTriangles& moved);
  struct Sampling {
    std::uint64_t budget;    ///< work, of all these samples together
    std::uint32_t near = 0;  ///< a triangle near the last point, and so perhaps the next
    Work work{};
    Vec3 to_mesh = Vec3::Zero();  ///< from the last point to that triangle, in the frame
  };
  /// Samples one point after the other, each near the last one.
  class Sampler;
  /// Bounds the distance at a point of the frame, which is at most `max_distance`, to about a seventh;
  /// negative when that is too much work.
  DistanceField::Interval sample(const Vec3& position, double max_distance,
                                 Sampling& sampling) const noexcept;
  auto sampler() const noexcept;

  // Visitors: see search.h.
  template <class Visitor>
  void visit(std::uint32_t at, Visitor& visitor) const noexcept;
  template <class Visitor>
  float traverse(const FilterPoint& point, Visitor& visitor, std::uint64_t budget) const noexcept;
  template <class Visitor>
  float search_near(const FilterPoint& point, Visitor& visitor, Memory& memory,
                    std::uint64_t budget) const noexcept;
  template <class Visitor>
  float search_listed(const FilterPoint& point, Visitor& visitor, const Memory& memory,
                      std::uint64_t budget) const noexcept;
  template <class Visitor>
  float search_cached(const FilterPoint& point, Visitor& visitor, const spheres::LeafCache& cache, float away,
                      std::uint64_t budget) const noexcept;
  bool is_slow(const Vec3& move) const noexcept;
  bool pays_to_list(float step, float distance) const noexcept;
  void refill_ahead(Memory& memory, Work& work) const noexcept;
  bool refill(const Vec3& center, const Vec3& move, float distance, Memory& memory, std::uint64_t budget,
              Work& work) const noexcept;

  Epoch epoch_;
  Simd simd_ = Simd::portable;
  bool searchable_ = false;  ///< else the mesh does not fit the frame, and every triangle is looked at
  Aabb bounds_;
  FilterFrame frame_;
  bool certified_ = true;
  double radius_ = 0;            ///< radius of a ball around the frame's origin that holds the mesh
  double mean_leaf_radius_ = 0;  ///< the mean radius of a block
  /// How much farther than the reach the mesh's box must be to answer, and of how long a path, squared: then
  /// the margin is far more than all rounding on the way to an answer.
  double box_margin_ = std::numeric_limits<double>::infinity(), longest_beyond_box_ = 0;
  spheres::TreeParts parts_;
  bool lazy_ = false;
  unsigned threads_ = 1;
  DistanceField distances_;
  TriangleIds ids_;
};

}  // namespace touchmark
