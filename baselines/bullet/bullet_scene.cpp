#include "baselines/bullet/bullet_scene.h"

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

#include <BulletCollision/BroadphaseCollision/btDbvt.h>

namespace touchmark::baselines {
namespace {

/// A box in Bullet's numbers, rounded outward.
btDbvtVolume volume_of(const Aabb& box) {
  // One rounding of each corner; what doubles round before that is less.
  constexpr double roundoff = 2 * std::numeric_limits<btScalar>::epsilon();
  const Vec3 pad = roundoff * box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs());
  const auto rounded = [](const Vec3& v) {
    return btVector3(static_cast<btScalar>(v.x()), static_cast<btScalar>(v.y()),
                     static_cast<btScalar>(v.z()));
  };
  return btDbvtVolume::FromMM(rounded(box.min - pad), rounded(box.max + pad));
}

template <class Visit>
class BodyVisitor final : public btDbvt::ICollide {
 public:
  explicit BodyVisitor(const Visit& visit) : visit_(visit) {}
  void Process(const btDbvtNode* leaf) override { visit_(static_cast<std::uint32_t>(leaf->dataAsInt)); }

 private:
  const Visit& visit_;
};

}  // namespace

struct BulletScene::State {
  PosedShapes<BulletDetector>::Session shapes;
  btNodeStack stack;
};

struct BulletScene::World {
  World(const PosedScene& scene, const BulletDetector::Options& chosen)
      : bodies(scene, chosen), checked(chosen.query == Asking::checked) {
    for (std::uint32_t i = 0; i < scene.bodies.size(); ++i) {
      const Aabb box = bodies.box(i);
      bounds.extend(box.min);
      bounds.extend(box.max);
      btDbvtNode* leaf = tree.insert(volume_of(box), nullptr);
      leaf->dataAsInt = static_cast<int>(i);
      leaves.push_back(leaf);
    }
  }

  /// Calls visit(body) for every body whose box meets the region.
  template <class Visit>
  void near(const Aabb& region, btNodeStack& stack, const Visit& visit) const {
    BodyVisitor<Visit> visitor(visit);
    tree.collideTVNoStackAlloc(tree.m_root, volume_of(region), stack, visitor);
  }

  PosedShapes<BulletDetector> bodies;
  bool checked;
  btDbvt tree;
  std::vector<btDbvtNode*> leaves;  ///< by body
  Aabb bounds;                      ///< holds all places where a body has been
};

BulletScene::BulletScene(const PosedScene& scene, const BulletDetector::Options& options)
    : world_(make_hidden<World>(scene, options)) {}

void BulletScene::place(std::uint32_t body, const Pose& pose) {
  world_->bodies.place(body, pose);
  const Aabb box = world_->bodies.box(body);
  world_->bounds.extend(box.min);
  world_->bounds.extend(box.max);
  btDbvtVolume volume = volume_of(box);
  // As Bullet's broad phase does: a box that still holds the body's stays as it is.
  constexpr double part = 0.05;
  world_->tree.update(world_->leaves[body], volume, static_cast<btScalar>(part * box.extent().maxCoeff()));
}

std::optional<BodyContact> BulletScene::nearest_body(const Probe& probe, double reach,
                                                     Session& session) const noexcept {
  const World& world = *world_;
  if (out_of_reach(world.bounds, probe.center, reach) || !answerable(probe.center, reach))
    return std::nullopt;
  State& state = session.ready();
  std::optional<BodyContact> best;
  if (world.checked && session.last < world.bodies.size())
    world.bodies.consider(session.last, probe, reach, state.shapes, best);
  const std::optional<std::uint32_t> asked = best ? std::optional(session.last) : std::nullopt;
  const auto ask = [&](double within) {
    const Vec3 pad = Vec3::Constant(within);
    world.near({probe.center - pad, probe.center + pad}, state.stack, [&](std::uint32_t body) {
      if (body != asked) world.bodies.consider(body, probe, within, state.shapes, best);
    });
    return best;
  };
  const double finite = finite_reach(world.bounds, probe.center, reach);
  if (best) {
    ask(std::min(finite, best->contact.distance));
  } else {
    nearest_by_growing(world.bounds, probe.center, finite, ask);
  }
  session.last = best ? best->body.index : no_triangle;
  session.work += std::exchange(state.shapes.work, {});
  return best;
}

std::optional<BodyImpact> BulletScene::first_hit_body(const Sweep& sweep, Session& session) const noexcept {
  const World& world = *world_;
  if (out_of_reach(world.bounds, sweep) || !answerable(sweep.from, sweep.radius) || !answerable(sweep.to, 0))
    return std::nullopt;
  State& state = session.ready();
  const Vec3 pad = Vec3::Constant(finite_reach(world.bounds, sweep.from, sweep.radius));
  std::optional<BodyImpact> first;
  world.near({sweep.from.cwiseMin(sweep.to) - pad, sweep.from.cwiseMax(sweep.to) + pad}, state.stack,
             [&](std::uint32_t body) { world.bodies.consider(body, sweep, state.shapes, first); });
  session.work += std::exchange(state.shapes.work, {});
  return first;
}

std::size_t BulletScene::bytes() const noexcept {
  return world_->bodies.bytes() + world_->leaves.size() * (2 * sizeof(btDbvtNode) + sizeof(btDbvtNode*));
}

Accuracy BulletScene::accuracy() const noexcept { return world_->bodies.accuracy(); }

}  // namespace touchmark::baselines
