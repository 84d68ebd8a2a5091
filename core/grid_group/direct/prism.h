/// The space over, under and a little beside a triangle, and the test that decides which triangles matter in
/// it.
///
/// A prism is cut into slim ones, each with a witness of its own on the triangle it stands on. What is
/// farther than the witness from all corners of a part is farther everywhere in it; a triangle is left out
/// when every part can do without it: docs/exactness.md, E15.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>

#include "core/geometry/point_triangle.h"
#include "core/grid_group/direct/triangle_store.h"
#include "core/search/plane_filter/plane_filter.h"
#include "core/simd/lanes.h"

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

/// Points of a prism as plain arrays: what is farther from all of them than each one's limit loses everywhere
/// in it.
struct PrismPoints {
  static constexpr std::size_t count = 12;

  std::array<float, count> x, y, z;
  std::array<float, count> limit;  ///< squared
  float plane_error = 0;
};

/// A point, and the distance from it beyond which a ball loses there.
struct BallLimit {
  float x, y, z, limit;
};

class Prism {
 public:
  /// The prism reaches from `height` under the grown triangle to `height` over it. A triangle that is left
  /// out is farther than the prism's own by `exclusion_margin` at least, everywhere in the prism. Lengths are
  /// in the frame.
  Prism(const FaceFrame& face_frame, double growth, double height, double exclusion_margin,
        const FilterFrame& frame) noexcept;

  /// Bit i of sixteen is set where the triangle in slot i is surely not nearest anywhere in the prism. Planes
  /// and balls are those of a TriangleStore.
  unsigned excluded(const std::uint32_t* slots, const TrianglePlanes* planes,
                    const TriangleBall* balls) const noexcept;
  /// For a quick look at balls first: what is in a ball that is beyond these limits is nearest nowhere.
  const std::array<BallLimit, 6>& corner_limits() const noexcept { return corner_limits_; }
  static constexpr std::size_t triangles_a_look = 16;
  /// No point of the prism is farther than this from its triangle.
  double farthest() const noexcept { return farthest_; }

 private:
  /// The triangle's sides are cut in so many.
  static constexpr int cuts = 2;
  static constexpr std::size_t points_an_end = (cuts + 1) * (cuts + 2) / 2;
  static constexpr std::size_t points = 2 * points_an_end;
  static_assert(points == PrismPoints::count);

  /// Returns the number of the lattice point that is i cuts from corner 0 towards 1 and j towards 2.
  static constexpr std::size_t number(int i, int j) {
    const int before = i * (2 * cuts + 3 - i) / 2;  // in the rows of smaller i
    return static_cast<std::size_t>(before + j);
  }
  void set_points(const FaceFrame& face_frame, double growth, double height,
                  const FilterFrame& frame) noexcept;
  void set_limits(const FaceFrame& face_frame, double growth, double height,
                  double exclusion_margin) noexcept;
  void set_ball_limits(const FaceFrame& face_frame, double height, double exclusion_margin) noexcept;

  std::array<Vec3, points_an_end> base_;
  PrismPoints points_;
  std::array<BallLimit, 6> corner_limits_;
  double farthest_ = 0;
};

}  // namespace touchmark::grid
