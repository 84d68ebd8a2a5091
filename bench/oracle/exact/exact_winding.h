/// How often a closed surface winds round a point: the truth about inside and outside. By a ray in a
/// direction of whole numbers that is drawn again whenever the ray meets an edge; every sign in question is
/// decided in integers. Shares nothing with core/sign.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "bench/oracle/triangle.h"

namespace touchmark::bench::oracle {

/// Every edge must have as many triangles one way as the other; nothing where the point is on a triangle.
/// Finite coordinates. Looks at every triangle.
std::optional<int> winding_exactly(const Vec3& point, std::span<const Triangle> triangles);

/// On which side of a mesh a point is, where that has one answer.
class ExactSides {
 public:
  explicit ExactSides(const TriangleMesh& mesh);

  /// Returns true if every edge, by the positions of its ends, has as many triangles one way as the other.
  bool closed() const noexcept { return closed_; }
  /// Returns the side of a finite point, for a closed mesh, as core/sign/side_finder.h defines it: with a
  /// negative volume the space all round is inside. Undecided where shells contradict each other.
  Side side(const Vec3& point) const;

 private:
  std::vector<Triangle> triangles_;
  bool closed_ = false;
  bool inside_out_ = false;
};

}  // namespace touchmark::bench::oracle
