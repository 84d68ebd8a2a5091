#include "baselines/fcl/fcl_scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

#include <fcl/broadphase/broadphase_dynamic_AABB_tree.h>
#include <fcl/geometry/collision_geometry.h>
#include <fcl/geometry/shape/sphere.h>
#include <fcl/narrowphase/collision_object.h>

namespace touchmark::baselines {
namespace {

using Object = fcl::CollisionObjectd;

/// What FCL's manager sees of a body: the box and the ball that FCL's own mesh has.
class Outline final : public fcl::CollisionGeometryd {
 public:
  explicit Outline(const TriangleMesh& mesh) {
    const Aabb bounds = mesh.bounds();
    aabb_local = fcl::AABBd(bounds.min, bounds.max);
    aabb_center = bounds.center();
    aabb_radius = 0;
    for (const Vec3& vertex : mesh.vertices())
      aabb_radius = std::max(aabb_radius, (vertex - aabb_center).norm());
  }
  void computeLocalAABB() override {}  // it never changes
};

/// One question, which FCL's manager shows bodies to.
struct Asked {
  const PosedShapes<FclDetector>& bodies;
  const Probe& probe;
  double reach, slack;
  FclScene::Session& session;
  std::optional<BodyContact> best;

  /// FCL goes on with boxes that are nearer than this, so of bodies as near as the best all are shown.
  double limit() const noexcept {
    const double within = best ? std::min(reach, best->contact.distance) : reach;
    return std::nextafter(within + slack, std::numeric_limits<double>::infinity());
  }
};

/// FCL's callback. The body's number is its user data.
bool consider(Object* one, Object* other, void* data, double& limit) {
  auto& asked = *static_cast<Asked*>(data);
  const void* const number = one->getUserData() != nullptr ? one->getUserData() : other->getUserData();
  const auto body = static_cast<std::uint32_t>(reinterpret_cast<std::uintptr_t>(number) - 1);
  asked.bodies.consider(body, asked.probe, asked.reach, asked.session, asked.best);
  limit = asked.limit();
  return false;
}

}  // namespace

struct FclScene::World {
  World(const PosedScene& scene, const FclDetector::Options& options) : bodies(scene, options) {
    std::vector<std::shared_ptr<Outline>> outlines;
    for (const auto& mesh : scene.shapes) {
      outlines.push_back(std::make_shared<Outline>(*mesh));
      size = std::max(size, largest_coordinate(mesh->bounds()));
    }
    for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
      objects.push_back(std::make_unique<Object>(outlines[scene.bodies[i].shape]));
      objects.back()->setUserData(reinterpret_cast<void*>(std::uintptr_t{i} + 1));
      set_pose(i, scene.bodies[i].pose);
      moved.push_back(objects.back().get());
    }
    manager.registerObjects(moved);
    manager.setup();
    moved.clear();
  }

  void set_pose(std::uint32_t body, const Pose& pose) {
    farthest = std::max(farthest, pose.translation.cwiseAbs().maxCoeff());
    fcl::Transform3d at = fcl::Transform3d::Identity();
    at.linear() = pose.rotation;
    at.translation() = pose.translation;
    objects[body]->setTransform(at);
    objects[body]->computeAABB();
  }

  PosedShapes<FclDetector> bodies;
  std::vector<std::unique_ptr<Object>> objects;
  std::vector<Object*> moved;
  fcl::DynamicAABBTreeCollisionManagerd manager;
  double size = 0;      ///< the largest coordinate of a shape
  double farthest = 0;  ///< the largest that a body has been moved by
};

FclScene::FclScene(const PosedScene& scene, const FclDetector::Options& options)
    : world_(make_hidden<World>(scene, options)) {}

void FclScene::place(std::uint32_t body, const Pose& pose) {
  world_->bodies.place(body, pose);
  world_->set_pose(body, pose);
  world_->moved.push_back(world_->objects[body].get());
}

void FclScene::publish() {
  // One by one FCL would balance its tree after each.
  world_->manager.update(world_->moved);
  world_->moved.clear();
}

std::optional<BodyContact> FclScene::nearest_body(const Probe& probe, double reach,
                                                  Session& session) const noexcept {
  if (!answerable(probe.center, reach)) return std::nullopt;
  // FCL takes a rotation for none that is within 1e-12 of none, and leaves a box where it is that moved by
  // less than 100 roundings of its corner.
  const double slack = 0x1p-37 * (world_->size + world_->farthest + probe.center.cwiseAbs().maxCoeff());
  Asked asked{world_->bodies, probe, reach, slack, session, {}};
  try {
    Object point(std::make_shared<fcl::Sphered>(0));
    point.setTranslation(probe.center);
    point.computeAABB();
    world_->manager.distance(&point, &asked, consider);
  } catch (...) {  // out of memory or FCL's own: what it has found counts
  }
  return asked.best;
}

std::size_t FclScene::bytes() const noexcept {
  using Node = fcl::detail::NodeBase<fcl::AABBd>;
  return world_->bodies.bytes() +
         world_->objects.size() * (sizeof(Object) + sizeof(world_->objects[0]) + 2 * sizeof(Node));
}

Accuracy FclScene::accuracy() const noexcept { return world_->bodies.accuracy(); }

}  // namespace touchmark::baselines
