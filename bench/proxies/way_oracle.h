/// What is true of a proxy's way: exact, by the oracle's box tree, intervals and integers, and by nothing of
/// core/geometry.
#pragma once

#include <optional>
#include <span>

#include "bench/oracle/oracle.h"
#include "bench/oracle/triangle_tree.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::proxies {

class WayOracle {
 public:
  explicit WayOracle(const TriangleMesh& mesh);
  WayOracle(const WayOracle&) = delete;
  WayOracle& operator=(const WayOracle&) = delete;

  /// Returns true if the segment and a triangle have a point in common, sides, corners and ends included.
  bool meets(const Vec3& from, const Vec3& to) const { return oracle_.segment_within(from, to, 0); }
  /// Returns true if the segment comes within the radius: at most so near.
  bool is_within(const Vec3& from, const Vec3& to, double radius) const {
    return oracle_.segment_within(from, to, radius);
  }
  /// Returns true if the segment comes nearer than the radius.
  bool is_nearer(const Vec3& from, const Vec3& to, double radius) const;
  /// Returns true if the segment passes a triangle's inside with both ends and its sides at least `margin`
  /// away: no rounding explains it.
  bool surely_crosses(const Vec3& from, const Vec3& to, double margin) const {
    return oracle_.surely_crosses(from, to, margin);
  }
  /// How much nearer to the surface than the radius the position is; 0 where it is not. Rounded.
  double shortfall(const Vec3& at, double radius) const;
  /// The side of a closed mesh; nothing where it is not closed.
  std::optional<Side> side(const Vec3& at) const { return oracle_.side(at); }

  /// The nearest place of the mesh, and a unit vector from there away from the mesh, over the position where
  /// that is outside or not known to be inside.
  struct WayOut {
    Vec3 from, direction;
  };
  WayOut way_out(const Vec3& at) const;

  double diagonal() const { return mesh_.diagonal(); }

 private:
  TriangleMesh mesh_;
  oracle::Oracle oracle_;
  oracle::TriangleTree tree_;
};

/// Returns where a proxy that is to follow these goals, at least one, is free from the start: farther than
/// the radius from the mesh. That is the first goal that is free. Where none is, it is a place outward from
/// the first goal, as far as that takes: on the line from the nearest point of the mesh through the goal, or
/// from inside a closed mesh the other way.
Vec3 free_start(const WayOracle& oracle, std::span<const Vec3> goals, double radius);

}  // namespace touchmark::bench::proxies
