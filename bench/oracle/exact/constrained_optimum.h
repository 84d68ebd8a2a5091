/// The constrained optimum of a ball that may not pass some planes, to far more digits than doubles have:
/// what a proxy in a convex free space is to reach.
#pragma once

#include <memory>
#include <optional>
#include <span>

#include "bench/oracle/triangle.h"

namespace touchmark::bench::oracle {

/// The points that are at least `radius` off the plane of each triangle, on the side of one point.
class ConvexFreeSpace {
 public:
  /// `inside` is on no plane. Triangles without a plane are left out.
  ConvexFreeSpace(std::span<const Triangle> triangles, const Vec3& inside, double radius);
  ~ConvexFreeSpace();
  ConvexFreeSpace(ConvexFreeSpace&&) noexcept;
  ConvexFreeSpace& operator=(ConvexFreeSpace&&) noexcept;

  /// The nearest point to the goal, rounded to doubles: the quadratic program's conditions of Karush, Kuhn
  /// and Tucker, tried for every set of at most three planes in numbers of 256 bits. Planes that are the same
  /// to 2^-48 of the largest coordinate count as one. Nothing where no set fulfils them.
  std::optional<Vec3> nearest(const Vec3& goal) const;

 private:
  struct Planes;
  std::unique_ptr<const Planes> planes_;
};

}  // namespace touchmark::bench::oracle
