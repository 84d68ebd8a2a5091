// Ours over core/scene: the bodies are moved, and no mesh of them all is made.
#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "bench/proxies/certified.h"
#include "bench/proxies/methods.h"
#include "core/aabb_tree/aabb_tree.h"
#include "core/brute_force/brute_force.h"
#include "core/grid_group/grid_group.h"
#include "core/haptics/proxy.h"
#include "core/scene/pose.h"
#include "core/scene/scene.h"
#include "core/sphere_cluster/sphere_cluster.h"

namespace touchmark::bench::proxies {
namespace {

template <class D>
class CertifiedOverBodies final : public ProxyMethod {
 public:
  explicit CertifiedOverBodies(const MethodRequest& request) : proxy_(scene_, request.coupling) {
    for (const TriangleMesh& body : request.bodies)
      ids_.push_back(scene_.add(scene_.add_shape(Shape<D>::build(body)), Pose()));
    move_bodies(request.places);
  }

  void place(const Vec3& position) override { proxy_.place(position); }
  void step(const Vec3& goal, Step& step) override { take(proxy_.step(goal, session_), step); }
  /// A mesh is not what it runs on: see move.
  void update(const TriangleMesh&) override {}
  void move(std::span<const Vec3> places, const TriangleMesh&) override {
    moving_.clear();
    for (std::size_t i = 0; i < ids_.size(); ++i) {
      const Pose after = pose_of(places[i], 1, 0, 0, 0);
      if (after != scene_.pose(ids_[i])) moving_.emplace_back(ids_[i], scene_.pose(ids_[i]), after);
    }
    move_bodies(places);
    proxy_.bodies_moved(moving_);
  }
  bool limit_work(std::uint64_t max_work) override {
    proxy_.limit_work(max_work);
    return KeepsToLimit<Scene<D>>;
  }
  bool ask_nearest(const Vec3& goal) override {
    static_cast<void>(
        scene_.nearest({goal, 0}, std::numeric_limits<double>::infinity(), session_of_bare_query_));
    return true;
  }
  std::uint64_t work() const override { return session_.work.total(); }

 private:
  void move_bodies(std::span<const Vec3> places) {
    for (std::size_t i = 0; i < ids_.size(); ++i) scene_.move(ids_[i], pose_of(places[i], 1, 0, 0, 0));
  }

  Scene<D> scene_;
  std::vector<BodyId> ids_;
  std::vector<MovingBody> moving_;
  typename Scene<D>::Session session_, session_of_bare_query_;
  Proxy<Scene<D>> proxy_;
};

}  // namespace

std::unique_ptr<ProxyMethod> certified_over_bodies(const MethodRequest& request) {
  if (request.detector == "sphere-cluster")
    return std::make_unique<CertifiedOverBodies<SphereCluster>>(request);
  if (request.detector == "grid-group") return std::make_unique<CertifiedOverBodies<GridGroup>>(request);
  if (request.detector == "aabb-tree") return std::make_unique<CertifiedOverBodies<AabbTree>>(request);
  if (request.detector == "brute-force") return std::make_unique<CertifiedOverBodies<BruteForce>>(request);
  return nullptr;
}

}  // namespace touchmark::bench::proxies
