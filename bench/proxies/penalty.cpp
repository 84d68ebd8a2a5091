// Penalty from the deepest contact: the device point itself, and a spring along the normal of the nearest
// face. There is no proxy, so the way is the device's own. Depth beyond the surface is told from the side of
// the nearest face that the point is behind; that loses thin parts, as Zilles and Salisbury (1995) describe.
#include "bench/proxies/half_spaces.h"
#include "bench/proxies/methods.h"
#include "bench/proxies/plain_mesh.h"

namespace touchmark::bench::proxies {
namespace {

class Penalty final : public ProxyMethod {
 public:
  Penalty(const TriangleMesh& mesh, const Coupling& coupling) : mesh_(mesh), coupling_(coupling) {}

  void place(const Vec3& position) override { position_ = position; }
  void step(const Vec3& goal, Step& step) override {
    step.begin(position_);
    step.go(goal);
    const PlainMesh::Nearest nearest = mesh_.nearest(goal);
    const oracle::Triangle t = oracle::triangle_of(mesh_.mesh(), nearest.triangle);
    const Vec3 gap = goal - nearest.point;
    const bool behind = gap.dot((t[1] - t[0]).cross(t[2] - t[0])) < 0;
    const double depth = behind ? coupling_.radius + nearest.distance : coupling_.radius - nearest.distance;
    if (depth > 0 && nearest.distance > 0) {
      const Vec3 outwards = (behind ? -1.0 : 1.0) * gap / nearest.distance;
      step.contacts = 1;
      step.status = Status::in_contact;
      step.force = coupling_force(goal + depth * outwards, goal, position_, coupling_);
    }
    position_ = goal;
  }
  void update(const TriangleMesh& mesh) override { mesh_.update(mesh); }
  std::uint64_t work() const override { return mesh_.work(); }

 private:
  PlainMesh mesh_;
  Coupling coupling_;
  Vec3 position_ = Vec3::Zero();
};

}  // namespace

std::unique_ptr<ProxyMethod> penalty_method(const MethodRequest& request) {
  return std::make_unique<Penalty>(request.mesh, request.coupling);
}

}  // namespace touchmark::bench::proxies
