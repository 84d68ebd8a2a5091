// The finger proxy as CHAI3D's manual describes it: one constraint is looked for each tick. From free, the
// proxy goes towards its goal and stops a small epsilon off the first surface; the next tick it slides in
// that surface's tangent plane until a second stops it; the next along the line of both until a third does;
// and then begins anew. Segments are asked a little beyond their end. For a bare point a face whose doubled
// area squared is below 1e-13 m^4 stops nothing.
#include <algorithm>
#include <cmath>
#include <utility>

#include "bench/proxies/half_spaces.h"
#include "bench/proxies/methods.h"
#include "bench/proxies/plain_mesh.h"
#include "bench/proxies/sweeper.h"

namespace touchmark::bench::proxies {
namespace {

class FingerProxy final : public ProxyMethod {
 public:
  FingerProxy(const MethodRequest& request)
      : sweeper_(sweeper_for(request, request.options.number("smallest"))),
        coupling_(request.coupling),
        epsilon_(std::max(request.options.number("epsilon"), of_radius * request.coupling.radius)) {}

  void place(const Vec3& position) override {
    position_ = goal_before_ = position;
    constraints_ = 0;
  }
  void step(const Vec3& goal, Step& step) override;
  void update(const TriangleMesh& mesh) override { sweeper_->update(mesh); }
  std::uint64_t work() const override { return sweeper_->work(); }

 private:
  static constexpr double of_radius = 1e-4;  ///< epsilon is at least so much of the ball's radius

  /// The goal of this tick's search, on the constraints found so far.
  Vec3 subgoal(const Vec3& goal) const;

  std::unique_ptr<Sweeper> sweeper_;
  Coupling coupling_;
  double epsilon_;
  Vec3 position_ = Vec3::Zero(), goal_before_ = Vec3::Zero();
  std::size_t constraints_ = 0;
  Vec3 normals_[2];
};

Vec3 FingerProxy::subgoal(const Vec3& goal) const {
  const Vec3 way = goal - position_;
  if (constraints_ == 0) return goal;
  if (constraints_ == 1)
    return held_by_friction(position_, goal - normals_[0].dot(way) * normals_[0], goal, coupling_);
  const Vec3 line = normals_[0].cross(normals_[1]);
  const double length = line.squaredNorm();
  return length > 0 ? Vec3(position_ + (line.dot(way) / length) * line) : position_;
}

void FingerProxy::step(const Vec3& goal, Step& step) {
  step.begin(position_);
  const Vec3 towards = subgoal(goal), way = towards - position_;
  const double length = way.norm();
  std::size_t touching = constraints_;
  if (length > 0) {
    const double beyond = length + epsilon_;
    const Vec3 end = position_ + way * (beyond / length);
    const std::optional<SweepHit> hit = sweeper_->first_hit(position_, end, coupling_.radius);
    if (!hit) {
      position_ = towards;
      constraints_ = 0;
    } else {
      const double sine = std::max(-hit->normal.dot(way) / length, 1e-3);  // epsilon is kept along the normal
      position_ += way * (std::max(hit->fraction * beyond - epsilon_ / sine, 0.0) / length);
      if (constraints_ < 2) {
        normals_[constraints_++] = hit->normal;
        touching = constraints_;
      } else {
        touching = 3;
        constraints_ = 0;
      }
    }
  } else {
    constraints_ = 0;
  }
  step.go(position_);
  step.contacts = position_ == goal ? 0 : touching;
  if (step.contacts > 0) {
    step.status = Status::in_contact;
    step.force = coupling_force(position_, goal, goal_before_, coupling_);
  }
  goal_before_ = goal;
}

}  // namespace

std::unique_ptr<ProxyMethod> finger_proxy_method(const MethodRequest& request) {
  return std::make_unique<FingerProxy>(request);
}

}  // namespace touchmark::bench::proxies
