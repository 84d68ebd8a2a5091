#include "bench/proxies/way_oracle.h"

#include <algorithm>
#include <cstdint>
#include <utility>

#include <Eigen/Geometry>

#include "bench/ground_truth/scene_truths.h"

namespace touchmark::bench::proxies {

WayOracle::WayOracle(const TriangleMesh& mesh) : mesh_(mesh), diagonal_(mesh.diagonal()) {
  oracle_.emplace(*mesh_, 1);
}

WayOracle::WayOracle(scenes::PlacedScene scene, scenes::ScheduleView schedule) {
  oracle::SceneOracle oracle = ground_truth::scene_oracle(scene);
  bodies_.emplace(Bodies{std::move(scene), std::move(oracle), schedule});
  stand_at(0);
  diagonal_ = (bodies_->oracle.bounds().max - bodies_->oracle.bounds().min).norm();
}

void WayOracle::stand_at(std::size_t step) {
  if (!bodies_) return;
  bodies_->follower.stand_at(
      &bodies_->schedule, step,
      [&](std::uint32_t body, const Pose& pose) { bodies_->oracle.place(body, pose); },
      [&](std::uint32_t body) { return bodies_->scene.bodies[body].start; });
}

double WayOracle::shortfall(const Vec3& at, double radius) const {
  if (!is_nearer(at, at, radius)) return 0;
  const oracle::GroundTruth truth = reference().solve(at);
  return (radius - truth.high) - truth.low;
}

WayOracle::WayOut WayOracle::way_out(const Vec3& at) const {
  const oracle::GroundTruth truth = reference().solve(at);
  Vec3 direction = truth.direction;
  if (direction.isZero()) {
    if (mesh_) {
      const Vec3 corner = mesh_->corner(truth.triangle, 0);
      direction = (mesh_->corner(truth.triangle, 1) - corner)
                      .cross(mesh_->corner(truth.triangle, 2) - corner)
                      .stableNormalized();
    }
    // A triangle without an area, or a body's: any way out of the box will do.
    if (direction.isZero()) direction = Vec3::UnitZ();
  } else if (side(at) == Side::inside) {
    direction = -direction;
  }
  return {truth.point, direction};
}

Vec3 free_start(const WayOracle& oracle, std::span<const Vec3> goals, double radius) {
  const auto is_free = [&](const Vec3& at) { return !oracle.is_within(at, at, radius); };
  const auto first = std::find_if(goals.begin(), goals.end(), is_free);
  if (first != goals.end()) return *first;
  constexpr double min_share = 0x1p-20;
  const WayOracle::WayOut out = oracle.way_out(goals.front());
  // Nothing of the mesh is near beyond its box, so that this ends.
  for (double beyond = min_share * (oracle.diagonal() + radius);; beyond *= 2) {
    const Vec3 start = out.from + (radius + beyond) * out.direction;
    if (is_free(start)) return start;
  }
}

}  // namespace touchmark::bench::proxies
