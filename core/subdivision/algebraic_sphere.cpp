#include "core/subdivision/algebraic_sphere.h"

#include <cmath>

namespace touchmark {

void AlgebraicSphereFit::add(const Vec3& point, const Vec3& normal, double weight) noexcept {
  if (weight_ == 0) origin_ = point;
  const Vec3 p = point - origin_;
  weight_ += weight;
  points_ += weight * p;
  normals_ += weight * normal;
  points_normals_ += weight * p.dot(normal);
  points_points_ += weight * p.dot(p);
}

AlgebraicSphereFit::Projection AlgebraicSphereFit::mean_on_sphere() const noexcept {
  const Vec3 mean = points_ / weight_;
  // About the mean the sphere is c + l.x + q x.x with l the mean normal, and c = -q times the mean square.
  const double spread = points_points_ - points_.dot(mean);
  const double q = spread > 0 ? (points_normals_ - mean.dot(normals_)) / (2 * spread) : 0;
  const Vec3 l = normals_ / weight_;
  const double c = -q * spread / weight_;
  const double slope = l.norm();
  if (!(slope > 0)) return {origin_ + mean, Vec3::Zero()};
  // Along the unit gradient: q t^2 + slope t + c = 0, whose root nearer to 0 in the form that holds for a
  // plane (q = 0) too. q c <= 0, so there is always one.
  const double t = -2 * c / (slope + std::sqrt(slope * slope - 4 * q * c));
  const Vec3 step = t / slope * l;
  return {origin_ + mean + step, l + 2 * q * step};
}

}  // namespace touchmark
