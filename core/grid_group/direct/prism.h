/// The space over, under and a little beside a triangle, and the test that decides which triangles matter in
/// it.
///
/// A prism is cut into slim ones, each with a witness of its own on the triangle it stands on. What is
/// farther than the witness from all corners of a part is farther everywhere in it; a triangle is left out
/// when every part can do without it: docs/exactness.md, E15.
#pragma once

#include <array>
#include <cstddef>
#include <span>

#include "core/bvh/limited_point.h"
#include "core/geometry/point_triangle.h"
#include "core/search/plane_filter/plane_filter.h"

namespace touchmark::grid {

/// A triangle in the filter's frame.
struct FaceFrame {
  std::array<Vec3, 3> corner;
  Vec3 normal;  ///< unit, or zero: then there is no prism
  Vec3 incenter;
  std::array<double, 3> incenter_weights;  ///< barycentric
  double inradius = 0;
  double size = 0;  ///< square root of twice the area

  FaceFrame(const PreparedTriangle& triangle, const FilterFrame& frame) noexcept;
  /// The triangle whose sides lie `growth` inradii outside this one's.
  std::array<Vec3, 3> grown(double growth) const noexcept;
};

class Prism {
 public:
  /// The prism reaches from `height` under the grown triangle to `height` over it. A triangle that is left
  /// out is farther than the prism's own by `exclusion_margin` at least, everywhere in the prism. Lengths are
  /// in the frame.
  Prism(const FaceFrame& face_frame, double growth, double height, double exclusion_margin,
        const FilterFrame& frame) noexcept;

  /// What is farther from all of these points than each one's limit is nearest nowhere in the prism.
  std::span<const bvh::LimitedPoint> points() const noexcept { return points_; }
  /// For a quick look at bounding volumes first: what is in one that is beyond all of these is nearest
  /// nowhere.
  std::span<const bvh::LimitedPoint> corners() const noexcept { return corners_; }
  /// No point of the prism is farther than this from its triangle.
  double farthest() const noexcept { return farthest_; }
  /// No point of the prism is farther than this from the triangle's incenter.
  double radius() const noexcept { return radius_; }

 private:
  /// The triangle's sides are cut in so many.
  static constexpr int cuts = 2;
  static constexpr std::size_t points_an_end = (cuts + 1) * (cuts + 2) / 2;
  static constexpr std::size_t point_count = 2 * points_an_end;

  /// Returns the number of the lattice point that is i cuts from corner 0 towards 1 and j towards 2.
  static constexpr std::size_t number(int i, int j) {
    const int before = i * (2 * cuts + 3 - i) / 2;  // in the rows of smaller i
    return static_cast<std::size_t>(before + j);
  }
  void set_points(const FaceFrame& face_frame, double growth, double height,
                  const FilterFrame& frame) noexcept;
  void set_limits(const FaceFrame& face_frame, double growth, double height,
                  double exclusion_margin) noexcept;
  void set_corners(const FaceFrame& face_frame, double height, double exclusion_margin) noexcept;

  std::array<Vec3, points_an_end> base_;
  std::array<bvh::LimitedPoint, point_count> points_;
  std::array<bvh::LimitedPoint, 6> corners_;
  float plane_error_ = 0;  ///< the largest of these points
  double farthest_ = 0, radius_ = 0;
};

}  // namespace touchmark::grid
