#include "bench/trajectories/drape.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "bench/trajectories/surface.h"

namespace touchmark::bench::trajectories {
namespace {

/// A point that is led over the surface, never below `floor_`, so that its side of the surface is known. The
/// positions below the floor are on the normal under it.
class SurfaceWalk {
 public:
  SurfaceWalk(Motion& motion, double height) : surface_(motion.mesh), floor_(1e-4 * motion.diagonal) {
    const SurfacePoint start = surface_.random_surface_point(motion.random);
    center_ = start.point + std::max(height, floor_) * start.normal;
    normal_ = start.normal;
    heading_ = motion.random.direction();
    find_foot();
  }

  /// Goes the way (x, y) along the surface, rises by z to `height`, and returns the position.
  Vec3 go(const Vec3& way, double height) {
    const double length = std::sqrt(way.x() * way.x() + way.y() * way.y());
    // The distance changes by no more than the centre moves: steps of half of it never lead through the
    // surface.
    constexpr double max_pieces = 64;
    const double pieces = std::clamp(std::ceil(2 * length / std::max(distance_, floor_)), 1.0, max_pieces);
    const double max_lift = (std::abs(way.z()) + lift_of_way * length) / pieces;
    for (int i = 0; i < static_cast<int>(pieces); ++i) {
      center_ += (way.x() * heading_ + way.y() * normal_.cross(heading_)) / pieces;
      find_foot();
      distance_ = std::min(std::max(height, floor_), distance_ + max_lift);
      center_ = foot_ + distance_ * normal_;
    }
    return foot_ + std::min(height, distance_) * normal_;
  }

 private:
  /// How much the centre is lifted on its way where it is too low: between walls that are too close it would
  /// otherwise be thrown from one to the other.
  static constexpr double lift_of_way = 0.1;

  void find_foot() {
    const Contact contact = surface_.nearest(center_);
    foot_ = contact.point;
    distance_ = contact.distance;
    // The smallest rotation from the old normal to the new one.
    const double cosine = normal_.dot(contact.normal);
    if (cosine > -0.99) heading_ -= heading_.dot(contact.normal) / (1 + cosine) * (normal_ + contact.normal);
    normal_ = contact.normal;
    heading_ -= heading_.dot(normal_) * normal_;
    heading_ = heading_.norm() > 0x1p-20 ? heading_.normalized() : normal_.unitOrthogonal();
  }

  Surface surface_;
  double floor_;  ///< 0.02 mm of 20 cm
  Vec3 center_, foot_, normal_, heading_;
  double distance_ = 0;
};

}  // namespace

Positions laid_on_surface(std::span<const Vec3> flat, Motion& motion) {
  SurfaceWalk walk(motion, flat.front().z());
  Positions positions;
  Vec3 last = flat.front();
  for (const Vec3& next : flat) {
    positions.push_back(walk.go(next - last, next.z()));
    last = next;
  }
  return positions;
}

}  // namespace touchmark::bench::trajectories
