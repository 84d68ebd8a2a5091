/// How Embree sees the mesh's coordinates, without Embree: for the detector, and for whoever asks what single
/// precision has left of them.
#pragma once

#include <cmath>
#include <limits>

#include "core/aabb.h"

namespace touchmark::baselines {

/// Embree computes in single precision, so it gets the mesh about the origin and of size 1 to 2: then an
/// offset costs no digits, and no coordinate overflows. The scale is a power of two.
struct EmbreeFrame {
  Vec3 origin;
  double scale = 1;

  explicit EmbreeFrame(const Aabb& bounds) : origin(bounds.center()) {
    const double size = bounds.extent().maxCoeff();
    if (size > 0) scale = std::ldexp(1.0, -std::ilogb(size));
  }
  Vec3 into(const Vec3& p) const noexcept { return scale * (p - origin); }
  /// By how much a distance between the point and a triangle of the mesh may come out wrong in single
  /// precision: a rounding each for the point's and the vertices' coordinates, for the difference, the
  /// square, the sum of three and the root, on coordinates of at most 1 + |p|. `p` is in the frame.
  static double slack(const Vec3& p) noexcept {
    constexpr double roundoff = std::numeric_limits<float>::epsilon() / 2;
    return 32 * roundoff * (1 + p.cwiseAbs().maxCoeff());
  }
};

}  // namespace touchmark::baselines
