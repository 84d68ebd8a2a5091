/// Triangles grouped by where they are, so that a query looks at few of them: the fast exact form of the
/// grid-group detector. The form as published is core/grid_group/published/published_grid_group.h.
///
/// As in the paper, the HIP's position names the triangles to look at:
/// 1. What the tick before left, or a sampled distance field, answers what it can
///    (core/point_queries/memory.h).
/// 2. The triangle of the tick before, or else the uniform cell that holds the HIP, gives the triangle to
///    start from (cells.h).
/// 3. That triangle's group is looked at if it covers the point: all triangles that can be nearest in a prism
///    over the triangle, found when the groups are built (prism.h, groups.h).
/// 4. Elsewhere a hierarchy over all triangles is searched, nearest first (core/bvh/wide_bvh.h).
/// It is exact at any radius and reach.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/detector.h"
#include "core/grid_group/direct/grouped_surface.h"
#include "core/mesh_update.h"
#include "core/point_queries/queries.h"

namespace touchmark {

/// The grid-group detector; satisfies Detector, Updates, Prepares and every query. May be built lazily.
class GridGroup {
 public:
  /// When the groups are built. Answers are the same.
  enum class Construction {
    whole,  ///< all in build()
    lazy    ///< each by the first query that misses it, one a query at most, which takes a few microseconds
  };
  /// What `build` may be told.
  struct Options {
    double cell = 0;                  ///< edge of a cell, mesh units; 0: choose
    double bytes_per_triangle = 400;  ///< what the structure may take, mesh copy included (200 at least)
    bool certified = true;            ///< false: as doubles have it, to measure what certainty costs
    Construction construction = Construction::whole;
    unsigned threads = 1;  ///< build it, at most 256; 0: as many as there are processors; the same bits
  };
  /// What one haptic point remembers between ticks.
  using Session = queries::Session;
  static constexpr bool keeps_to_limit = true;

  /// Throws std::invalid_argument for a cell below 0 or not finite, a budget below 200, or too many threads.
  static void check(const Options& options);
  /// Throws what `check` does.
  static GridGroup build(const TriangleMesh& mesh, const Options& options);
  static GridGroup build(const TriangleMesh& mesh) { return build(mesh, Options()); }

  /// See the concept Updates. Groups and cells near what moved are made anew, and all where the mesh has
  /// become of another size or place.
  void update(const TriangleMesh& mesh);

  [[gnu::always_inline]] bool touches(const Probe& probe, Session& session) const noexcept {
    return queries::touches(surface_, probe, session);
  }
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept {
    if (!queries::asks_nearest(surface_, probe, reach, session)) return std::nullopt;
    return look_for_nearest(probe.center, reach, session);
  }
  /// See the concept AnswersWithinBudget. The search is that of the hierarchy, without groups.
  Bracket nearest(const Probe& probe, double reach, Session& session, std::uint64_t budget) const noexcept {
    return queries::nearest_bracket(surface_, probe, reach, budget, session);
  }
  std::optional<Impact> first_hit(const Sweep& sweep, Session& session) const noexcept {
    return queries::first_hit(surface_, sweep, session);
  }

  std::size_t contacts(const Probe& probe, double reach, Session& session,
                       std::span<Contact> into) const noexcept {
    return queries::contacts(surface_, probe, reach, session, into);
  }

  /// Asks the last question again where the point will be if it goes on as it moved, unless that is known to
  /// be clear. The next query then finds its data and its code in the caches, best when this is called just
  /// before the device is read. Work is bounded as that of three queries is.
  void prepare(Session& session) const noexcept { queries::prepare(surface_, session); }

  /// Bounds what lazy construction adds to a query: no more boxes and triangles than this besides those that
  /// answer it, and with those no more than twice as many as there are triangles, and a little.
  static constexpr std::uint64_t max_lazy_work = 10'000;

  std::size_t bytes() const noexcept { return surface_.bytes(); }
  Accuracy accuracy() const noexcept { return options_.certified ? certified : uncertified; }
  bool builds_lazily() const noexcept { return options_.construction == Construction::lazy; }

  /// Triangles that have a group.
  std::size_t groups() const noexcept { return surface_.groups.count(); }
  /// Edge of a cell, in mesh units; 0 where the mesh's extent admits no cells.
  double cell() const noexcept { return surface_.cells.edge(); }
  /// True if cells are larger than asked for, or groups are left out, to keep within memory.
  bool coarsened() const noexcept { return surface_.cells.coarsened() || surface_.groups.ran_out(); }

 private:
  /// Returns how many bytes are left for groups, and cells, by what the rest takes.
  std::size_t bytes_left(std::size_t taken) const noexcept;
  std::optional<Contact> look_for_nearest(const Vec3& center, double reach, Session& session) const noexcept;
  /// Makes what the last query missed: the group of the triangle it found, and names that in the cell.
  /// `spent` counts what the query looked at.
  void make_missing(std::uint64_t spent, Session& session) const noexcept;

  Options options_;
  Connectivity connectivity_;
  grid::GroupedSurface surface_;
};

}  // namespace touchmark
