#include "bench/workers/shapes_near.h"

#include <algorithm>
#include <cstdint>
#include <limits>

#include "core/scene/scene_bodies.h"
#include "core/scene/seen_body.h"

namespace touchmark::bench::workers {
namespace {

/// The bodies' boxes as they stand, and the shapes found so far.
class NearShapes {
 public:
  explicit NearShapes(const scenes::PlacedScene& scene) : near_(scene.shapes.size(), false) {
    for (std::size_t i = 0; i < scene.shapes.size(); ++i)
      shapes_.push_back(bodies_.add_shape(scene.shapes[i]->bounds().padded(scene.radius_of(i))));
    for (const scenes::PlacedScene::PlacedBody& body : scene.bodies)
      ids_.push_back(bodies_.add(shapes_[body.shape], body.start));
  }

  void place(std::uint32_t body, const Pose& pose) { bodies_.move(ids_[body], pose); }

  void look(const Vec3& from, const workload::Step& step) {
    const Vec3& at = step.probe.center;
    if (!from.allFinite() || !at.allFinite()) return;
    Aabb way, point;
    way.extend(from);
    way.extend(at);
    point.extend(at);
    mark(way, step.probe.radius);
    // No surface is farther than a corner of its box.
    double limit = step.reach;
    bodies_.tree().for_each_within(
        point, limit, [&](std::uint32_t body) { return limit = std::min(limit, farthest(body, at)); });
    mark(point, limit);
  }
  std::vector<bool> found() && { return std::move(near_); }

 private:
  void mark(const Aabb& region, double limit) {
    bodies_.tree().for_each_within(region, limit, [&](std::uint32_t body) {
      near_[bodies_[body].shape] = true;
      return limit;
    });
  }
  double farthest(std::uint32_t body, const Vec3& point) const {
    const PlacedBody& placed = bodies_[body];
    const Aabb& box = bodies_.bounds_of(placed);
    const Vec3 center = in_frame(placed.pose, point);
    const double corner = (center - box.min).cwiseAbs().cwiseMax((center - box.max).cwiseAbs()).norm();
    return SeenBody(placed.pose, double{placed.rigid}, point).in_scene(corner, 1e-12 * corner).upper;
  }

  SceneBodies bodies_;
  std::vector<ShapeId> shapes_;
  std::vector<BodyId> ids_;
  std::vector<bool> near_;
};

}  // namespace

std::vector<bool> shapes_near(const scenes::PlacedScene& scene,
                              std::span<const std::vector<workload::Step>> traces,
                              std::span<const scenes::ScheduleView> schedules) {
  NearShapes near(scene);
  scenes::ScheduleFollower follower;
  const auto place = [&](std::uint32_t body, const Pose& pose) { near.place(body, pose); };
  const auto stood = [&](std::uint32_t body) { return scene.bodies[body].start; };
  for (std::size_t trace = 0; trace < traces.size(); ++trace) {
    for (std::size_t i = 0; i < traces[trace].size(); ++i) {
      follower.stand_at(&schedules[trace], i, place, stood);
      near.look(traces[trace][i > 0 ? i - 1 : 0].probe.center, traces[trace][i]);
    }
  }
  return std::move(near).found();
}

}  // namespace touchmark::bench::workers
