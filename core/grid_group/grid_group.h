/// Triangles grouped by where they are, so that a query looks at few of them: the fast exact form of the
/// grid-group detector. The form as published is core/grid_group/published/published_grid_group.h.
///
/// As in the paper, the HIP's position names the triangles to look at:
/// 1. A sampled distance field rejects what is far (core/search/distance_field/distance_field.h).
/// 2. The triangle of the tick before, or else an octree of cells each of which names a triangle near its
///    middle, gives the triangle to start from (cell_tree.h).
/// 3. That triangle's group is looked at if it covers the point: the list of all triangles that can be
///    nearest in a prism over the triangle, found when the grid is built (prism.h, groups.h).
/// 4. Elsewhere a tree of eight-wide boxes over all triangles is searched, nearest first (box_tree.h).
/// It is exact at any radius and reach.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <variant>

#include "core/brute_force/brute_force.h"
#include "core/detector.h"
#include "core/grid_group/direct/direct_grid.h"
#include "core/mesh_update.h"

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
    double cell = 0;                  ///< edge of the smallest cell, mesh units; 0: choose
    double bytes_per_triangle = 400;  ///< what the structure may take, mesh copy included (200 at least)
    bool certified = true;            ///< false: as doubles have it, to measure what certainty costs
    Construction construction = Construction::whole;
    unsigned threads = 1;  ///< build it, at most 256; 0: as many as there are processors; the same bits
  };
  /// What one haptic point remembers between ticks.
  struct Session : BruteForce::Session {
    LastQuestion question;
    grid::DirectMemory memory;
  };

  /// Throws std::invalid_argument for a cell below 0 or not finite, a budget below 200, or too many threads.
  static void check(const Options& options);
  /// Throws what `check` does.
  static GridGroup build(const TriangleMesh& mesh, const Options& options);
  static GridGroup build(const TriangleMesh& mesh) { return build(mesh, Options()); }

  /// See the concept Updates. Groups and cells near what moved are made anew, and all where the mesh has
  /// become of another size or place.
  void update(const TriangleMesh& mesh);

  // Inline as far as clear space: there a query is a few comparisons, less than a call.
  bool touches(const Probe& probe, Session& session) const noexcept {
    return !is_clear(probe.center, probe.radius, session) && look_for_touch(probe, session);
  }
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept {
    if (is_clear(probe.center, reach, session)) return std::nullopt;
    return look_for_nearest(probe, reach, session);
  }
  /// A ball that holds both ends of a path holds all of it.
  std::optional<Impact> first_hit(const Sweep& sweep, Session& session) const noexcept {
    if (is_clear(sweep.from, sweep.radius, session) && is_clear(sweep.to, sweep.radius, session))
      return std::nullopt;
    return look_for_impact(sweep, session);
  }

  std::size_t contacts(const Probe& probe, double reach, Session& session,
                       std::span<Contact> into) const noexcept {
    return is_clear(probe.center, reach, session) ? 0 : look_for_contacts(probe, reach, session, into);
  }

  /// Asks the last question again where the point was, unless that is known to be clear. The next query then
  /// finds its data and its code in the caches, best when this is called just before the device is read. Work
  /// is bounded as a query's is.
  void prepare(Session& session) const noexcept;

  std::size_t bytes() const noexcept;
  Accuracy accuracy() const noexcept;
  bool builds_lazily() const noexcept { return options_.construction == Construction::lazy; }

  /// Triangles that have a group.
  std::size_t groups() const noexcept { return direct() == nullptr ? 1 : direct()->groups(); }
  /// Edge of the smallest cell, in mesh units; 0 where the mesh's extent admits no cells.
  double cell() const noexcept { return direct() == nullptr ? 0 : direct()->cell(); }
  /// Were the cells made larger than asked, or fewer than wanted, to keep within memory?
  bool coarsened() const noexcept { return direct() != nullptr && direct()->coarsened(); }

 private:
  const grid::DirectGrid* direct() const noexcept { return std::get_if<grid::DirectGrid>(&form_); }
  /// Answers where `direct` is null.
  const BruteForce& brute_force() const noexcept { return *std::get_if<BruteForce>(&form_); }
  bool is_clear(const Vec3& center, double reach, const Session& session) const noexcept {
    return direct() != nullptr && direct()->is_clear(center, reach, session.memory);
  }
  bool look_for_touch(const Probe& probe, Session& session) const noexcept;
  std::optional<Contact> look_for_nearest(const Probe& probe, double reach, Session& session) const noexcept;
  std::optional<Impact> look_for_impact(const Sweep& sweep, Session& session) const noexcept;
  std::size_t look_for_contacts(const Probe& probe, double reach, Session& session,
                                std::span<Contact> into) const noexcept;

  Options options_;
  Connectivity connectivity_;
  /// BruteForce serves the meshes whose extent is zero or whose squares leave the range of double.
  std::variant<BruteForce, grid::DirectGrid> form_;
};

}  // namespace touchmark
