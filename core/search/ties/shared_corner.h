/// The corner that is nearest to a point, and so of every triangle that has it and lies behind it: where a
/// search has found one of them, it need not measure the others.
#pragma once

#include <cstddef>

#include "core/geometry/point_triangle.h"
#include "core/probe.h"

namespace touchmark {

class SharedCorner {
 public:
  /// Takes a triangle and the kernel's offset from it to the point; both must outlive this. `margin` is at
  /// least 2^-43 M^2, M the largest coordinate difference between the point and the mesh. Most often a face
  /// or a side is nearest, and one coordinate tells.
  void find(const PreparedTriangle& triangle, const Vec3& point, const Vec3& offset, double margin) noexcept {
    corner_ = nullptr;
    for (const Vec3& corner : triangle.corner)
      if (point.x() - corner.x() == offset.x()) return look_at(triangle, point, offset, margin);
  }
  bool is_known() const noexcept { return corner_ != nullptr; }
  /// Has the triangle that corner, and is it nearest by far more than the kernel may be off by? Then it is
  /// exactly as far as the first triangle, and the kernel's offset from it has the same bits:
  /// docs/exactness.md, E6. False says nothing.
  bool is_nearest_of(const PreparedTriangle& triangle) const noexcept;

 private:
  void look_at(const PreparedTriangle& triangle, const Vec3& point, const Vec3& offset,
               double margin) noexcept;
  bool is_behind(const PreparedTriangle& triangle, std::size_t corner) const noexcept;

  const Vec3* corner_ = nullptr;  ///< null: none is known
  const Vec3* offset_ = nullptr;
  double margin_ = 0;
};

}  // namespace touchmark
