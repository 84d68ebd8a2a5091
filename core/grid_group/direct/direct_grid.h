/// The fast exact form: where the HIP is decides which triangles are looked at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "core/detector.h"
#include "core/grid_group/direct/box_tree.h"
#include "core/grid_group/direct/cell_tree.h"
#include "core/grid_group/direct/groups.h"
#include "core/grid_group/direct/triangle_store.h"
#include "core/search/distance_field/distance_field.h"
#include "core/search/linear_scan.h"
#include "core/search/memory/epoch.h"
#include "core/search/memory/last_distance.h"
#include "core/search/memory/last_question.h"
#include "core/search/tracing.h"

namespace touchmark::grid {

class NearestSearch;

struct DirectOptions {
  double cell = 0;                  ///< edge of the smallest cell, mesh units; 0: choose
  double bytes_per_triangle = 400;  ///< the whole structure
  bool certified = true;            ///< false: as doubles have it
  bool lazy = false;                ///< groups are made by the first queries that miss them, one a query
  unsigned threads = 1;             ///< build it, at least 1; the same bits
};

/// What one haptic point remembers between ticks. The bounds are padded by the kernel's error wherever they
/// are put to use.
struct DirectMemory : LastDistance {
  /// Returns true if this point is certainly less than that far from the centre, padded for the rounding of a
  /// displacement and of what is compared with it.
  bool moved_less(const Vec3& to, double by) const noexcept {
    constexpr double shy = 1 - 0x1p-40;
    return by > 0 && (to - center).squaredNorm() < by * by * shy;
  }
};

class DirectGrid {
 public:
  /// The mesh's box must fit the filter's frame (FilterFrame::fits).
  static DirectGrid build(const TriangleMesh& mesh, const DirectOptions& options);

  /// The mesh's same triangles, some elsewhere. What memories hold of before is not believed any more. False
  /// where the mesh is now of another size or at another place: nothing has changed then, and the grid is to
  /// be built anew.
  bool update(const TriangleMesh& mesh);

  /// Is it known, without looking, that no triangle is within reach?
  bool is_clear(const Vec3& center, double reach, const DirectMemory& memory) const noexcept {
    return memory.epoch == epoch_ && memory.moved_less(center, memory.lower - reach);
  }
  // All look, even where it is known to be clear. A radius or reach must be at least 0.
  bool touches(const Probe& probe, DirectMemory& memory, Work& work) const noexcept;
  std::optional<Contact> nearest(const Vec3& center, double reach, DirectMemory& memory,
                                 Work& work) const noexcept;
  std::optional<Impact> first_hit(const Sweep& sweep, DirectMemory& memory, Work& work) const noexcept;

  std::size_t contacts(const Vec3& center, double reach, DirectMemory& memory, std::span<Contact> into,
                       Work& work) const noexcept;

  /// Asks the question again where the point was, unless that is known to be clear.
  void prepare(const LastQuestion& question, DirectMemory& memory, Work& work) const noexcept {
    if (memory.epoch == epoch_ && !is_clear(memory.center, question.reach, memory))
      ask_again(*this, question, memory.center, Vec3::Zero(), memory, work);
  }

  /// Bounds what lazy construction adds to a query: no more boxes and triangles than this besides those that
  /// answer it, and with those no more than twice as many as there are triangles, and a little; a sweep at
  /// twice as many, for it may ask what is nearest to its start.
  static constexpr std::uint64_t max_lazy_work = 10'000;

  std::size_t bytes() const noexcept;
  std::size_t groups() const noexcept { return groups_.count(); }
  double cell() const noexcept { return cells_.smallest_edge() / store_.frame.scale(); }
  bool coarsened() const noexcept { return coarsened_; }
  bool is_certified() const noexcept { return certified_; }

 private:
  /// A tick's work is bounded: no more boxes are looked at for a group, and no more of them and of triangles
  /// for a cell.
  static constexpr std::uint64_t max_lazy_looks = 4096;
  /// The slot to look at first, where the point is not known to be clear.
  struct Start {
    bool beyond = false;  ///< nothing is within reach
    std::uint32_t slot = 0;
    const Group* group = nullptr;  ///< group of that slot, if it covers the point
  };
  void claim(DirectMemory& memory) const noexcept {
    if (memory.epoch == epoch_) return;
    memory = DirectMemory();
    memory.epoch = epoch_;
  }
  /// Is nothing within reach, by what was sampled? Few bytes, which stay in the cache: what is far needs no
  /// cell. Closely after a jump: a point that comes near slowly meets a group, which tells more.
  bool rejects_by_distance_field(const Vec3& center, const FilterPoint& point, double reach,
                                 DirectMemory& memory) const noexcept {
    double least = static_cast<double>(distances_.lower_bound(point)) * store_.frame.unit();
    if (!(least > reach) && !memory.moved_less(center, std::max(memory.lower - reach, 0.0) + cell()))
      least = static_cast<double>(distances_.tight_lower_bound(point)) * store_.frame.unit();
    if (!(least > reach)) return false;
    remember(center, point.plane_error, least, std::numeric_limits<double>::infinity(), memory);
    return true;
  }
  /// Is nothing within reach, by the mesh's box? It is in the cache, where samples may not be.
  bool rejects_by_box(const Vec3& center, const FilterPoint& point, double reach,
                      DirectMemory& memory) const noexcept {
    constexpr double down = 1 - 0x1p-50;  // a difference is rounded once
    const double least = down * (bounds_.min - center).cwiseMax(center - bounds_.max).maxCoeff();
    if (!(least > reach)) return false;
    remember(center, point.plane_error, least, std::numeric_limits<double>::infinity(), memory);
    return true;
  }
  /// Makes the memory this grid's. Is nothing within reach, by the box or by what was sampled, where nothing
  /// was near? What was near is asked about before the samples are, in start_at.
  bool rejects_at_start(const Vec3& center, const FilterPoint& point, double reach,
                        DirectMemory& memory) const noexcept {
    claim(memory);
    return !memory.is_near() && (rejects_by_box(center, point, reach, memory) ||
                                 rejects_by_distance_field(center, point, reach, memory));
  }
  /// Finds where to look first, after rejects_at_start.
  Start start_at(const Vec3& center, const FilterPoint& point, double reach, DirectMemory& memory,
                 Work& work) const noexcept;
  /// Returns the group of the triangle in this slot if it covers the point.
  /// Always inline: the compiler takes the atomic reads of a group for more than the loads that they are.
  [[gnu::always_inline]] const Group* group_covering(std::uint32_t slot, const FilterPoint& point,
                                                     Work& work) const noexcept {
    ++work.cells;
    const Group& group = groups_.of(slot);
    if constexpr (tracing)
      note_group(group, group.covers(plane_values(store_.planes[slot], point), point.plane_error));
    return group.covers(plane_values(store_.planes[slot], point), point.plane_error) ? &group : nullptr;
  }
  void note_group(const Group& group, bool covers) const;
  void note_cell(const Vec3& in_frame) const;
  /// Returns at least the distance to the triangle in this slot, or infinity.
  double upper_bound_to(std::uint32_t slot, const FilterPoint& point, Work& work) const noexcept {
    ++work.triangles;
    const TrianglePlanes& planes = store_.planes[slot];
    return store_.frame.from_frame_rounded_up(
        distance_upper_bound(planes, plane_values(planes, point), point));
  }
  /// The nearest triangle, or none when nothing is within reach. One that is found may still be beyond it, by
  /// a rounding of the filter; then `squared_lower` bounds the squared distance to all. To `touch`, any
  /// triangle within the reach is as good: then `within` bounds its distance and no more is told, and else
  /// nothing touches.
  struct Located {
    const PreparedTriangle* triangle = nullptr;
    /// The exactly nearest one; null where `triangle` surely is that, or to touch.
    const PreparedTriangle* exactly = nullptr;
    Offset offset{Vec3::Zero(), 0};
    double squared_lower = 0;
    float plane_error = 0;   ///< the filter's, at the centre
    double error = 0;        ///< bounds the error of a computed distance there
    bool exhausted = false;  ///< after as much work as all triangles would have been
    double within = std::numeric_limits<double>::infinity();
  };
  enum class Sought { touch, contact };
  template <Sought sought>
  Located locate(const Vec3& center, const FilterPoint& point, double reach, DirectMemory& memory,
                 Work& work) const noexcept;
  void look_for_group(NearestSearch& search, Start& start, Work& work) const noexcept;
  template <Sought sought>
  Located conclude(NearestSearch& search, const Vec3& center, double squared_lower, DirectMemory& memory,
                   Work& work) const noexcept;
  /// Builds lazily after a query that no group covered: the group of one of the slots, or the cell of this
  /// centre, whichever is still to be done. `spent` counts the boxes and triangles of the query.
  void build_lazily(std::uint32_t near, std::uint32_t start, const Vec3& center, std::uint64_t spent,
                    Work& work) const noexcept {
    if (groups_.is_lazy()) build_missing(near, start, center, spent, work);
  }
  void build_missing(std::uint32_t near, std::uint32_t start, const Vec3& center, std::uint64_t spent,
                     Work& work) const noexcept;
  void make_group(std::uint32_t slot, std::uint64_t budget, Work& work) const noexcept;
  void remember(const Vec3& center, float plane_error, double lower, double upper,
                DirectMemory& memory) const noexcept {
    // Twice culling_pad, for the kernel's error here: plane_error is 2^-21 of a length above the largest
    // difference. What the error grows by elsewhere goes with the displacement and is in moved_less.
    const double pad = static_cast<double>(plane_error) * (0x1p-24 * (1 + 0x1p-20)) * store_.frame.unit();
    memory.center = center;
    memory.lower = lower - pad;
    memory.upper = upper + pad;
  }

  /// Answers for probes so far away that single precision tells the triangles no longer apart.
  std::optional<Contact> far_nearest(const Vec3& center, double reach, Work& work) const noexcept;
  std::optional<Impact> far_first_hit(const Sweep& sweep, Work& work) const noexcept;
  std::optional<Impact> impact_of(FirstTouch first, DirectMemory& memory, Work& work) const noexcept;
  /// Returns the contact with the exactly nearest triangle, where rounding could tell; nothing where it is
  /// beyond the reach.
  std::optional<Contact> exact_contact(const PreparedTriangle& nearest, const Vec3& center, double reach,
                                       double error, Work& work) const noexcept;
  /// Samples distances, or those that the boxes of what moved may have changed.
  void fill_distances();
  void refill_distances(const std::vector<Aabb>& moved);
  DistanceField::Interval sample(const Vec3& in_frame, double max_distance,
                                 std::uint64_t& left) const noexcept;
  auto sampler() const noexcept;
  LinearScan fallback() const noexcept { return {store_.exact, bounds_, store_.ids, certified_}; }

  Epoch epoch_;
  Aabb bounds_;
  TriangleStore store_;
  BoxTree tree_;
  Groups groups_;
  CellTree cells_;
  DistanceField distances_;      ///< empty where there is no room for it, or construction is lazy
  double exclusion_margin_ = 0;  ///< see GroupFinder
  std::size_t max_bytes_ = 0;
  unsigned threads_ = 1;
  bool coarsened_ = false;
  bool certified_ = true;
};

}  // namespace touchmark::grid
