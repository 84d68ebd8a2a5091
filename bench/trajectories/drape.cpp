#include "bench/trajectories/drape.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <stdexcept>

#include <Eigen/Eigenvalues>
#include <Eigen/Geometry>

#include "bench/support/median.h"
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

/// Moves and turns the points so that x, y and z are their axes of most, middle and least variance.
void turn_to_axes(Trajectory& recording) {
  std::vector<Vec3>& points = recording.positions;
  const double share = 1 / static_cast<double>(points.size());
  Vec3 mean = Vec3::Zero();
  for (const Vec3& point : points) mean += share * point;
  Eigen::Matrix3d variance = Eigen::Matrix3d::Zero();
  for (const Vec3& point : points) variance += share * (point - mean) * (point - mean).transpose();
  if (!variance.allFinite())
    throw std::invalid_argument(recording.name + ": the coordinates are too large for --drape");
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver(variance);
  for (Vec3& point : points) point = (solver.eigenvectors().transpose() * (point - mean)).reverse().eval();
  Vec3 moment = Vec3::Zero();
  for (const Vec3& point : points) moment += point.cwiseProduct(point).cwiseProduct(point);
  for (Vec3& point : points) point = (moment.array() < 0).select(-point, point).eval();
}

/// Counts z from its median, and turns it where the steps below would be the longer ones on average.
void find_ground(std::vector<Vec3>& points) {
  std::vector<double> heights;
  for (const Vec3& point : points) heights.push_back(point.z());
  const double ground = support::median(heights);
  std::array<double, 2> ways{}, steps{};
  for (std::size_t i = 0; i < points.size(); ++i) {
    points[i].z() -= ground;
    const std::size_t side = points[i].z() > 0 ? 1 : 0;
    ways[side] += i > 0 ? (points[i] - points[i - 1]).norm() : 0;
    ++steps[side];
  }
  if (ways[0] * steps[1] <= ways[1] * steps[0]) return;
  for (Vec3& point : points) point.z() *= -1;
}

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

Trajectory draped(Trajectory recording, Drape how, Motion motion) {
  std::vector<Vec3>& points = recording.positions;
  turn_to_axes(recording);
  find_ground(points);
  const double lowest = std::ranges::min(points, {}, [](const Vec3& point) { return point.z(); }).z();
  for (std::size_t i = 0; i < points.size(); ++i) {
    // In contact by so much that the coordinates' rounding loses none.
    constexpr double within = 1 - 0x1p-30;
    const double radius = recording.radii.empty() ? motion.radius : recording.radii[i];
    double& height = points[i].z();
    height = how == Drape::free ? height - lowest : std::clamp(height, -0.5 * radius, within * radius);
  }
  points = laid_on_surface(points, motion);
  return recording;
}

}  // namespace touchmark::bench::trajectories
