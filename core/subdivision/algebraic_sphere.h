/// The algebraic sphere that fits points with normals (Guennebaud & Gross 2007, "Algebraic point set
/// surfaces").
#pragma once

#include "core/probe.h"

namespace touchmark {

/// Fits c + l.x + q x.x = 0 so that the gradient l + 2 q x is nearest to the normals. The sums are taken
/// about the first point, so a far offset of the mesh costs nothing.
class AlgebraicSphereFit {
 public:
  void clear() noexcept { *this = {}; }
  /// `normal` of any length: its length weighs like `weight`.
  void add(const Vec3& point, const Vec3& normal, double weight) noexcept;

  struct Projection {
    Vec3 point;
    Vec3 gradient;  ///< outwards at the point, not unit; zero where the normals cancel
  };
  /// The weighted mean of the points, moved along the gradient there on to the sphere; itself where the
  /// normals cancel.
  Projection mean_on_sphere() const noexcept;

 private:
  Vec3 origin_ = Vec3::Zero();
  double weight_ = 0;
  Vec3 points_ = Vec3::Zero();
  Vec3 normals_ = Vec3::Zero();
  double points_normals_ = 0;
  double points_points_ = 0;
};

}  // namespace touchmark
