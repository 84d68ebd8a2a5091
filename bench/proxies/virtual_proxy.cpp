// The virtual proxy of D. C. Ruspini, K. Kolarov and O. Khatib, "The haptic display of complex graphical
// environments", SIGGRAPH 1997: a ball that moves straight to its goal until it meets an obstacle of
// configuration space, there takes the obstacle's plane as a constraint, and goes on to the goal's nearest
// point behind no constraint, until it comes no nearer. The same loop with a skin kept off the surface is
// what programs build from the sweeps of physics engines, so those run here, too.
#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include "bench/proxies/half_spaces.h"
#include "bench/proxies/methods.h"
#include "bench/proxies/sweeper.h"

namespace touchmark::bench::proxies {
namespace {

class SweepAndSlide final : public ProxyMethod {
 public:
  SweepAndSlide(std::unique_ptr<Sweeper> sweeper, const Coupling& coupling, double skin, int rounds)
      : sweeper_(std::move(sweeper)), coupling_(coupling), skin_(skin), rounds_(rounds) {}

  void place(const Vec3& position) override { position_ = goal_before_ = position; }
  void step(const Vec3& goal, Step& step) override;
  void update(const TriangleMesh& mesh) override { sweeper_->update(mesh); }
  std::uint64_t work() const override { return sweeper_->work(); }

 private:
  static constexpr std::size_t max_planes = 10;
  static constexpr double no_way = 0x1p-46;  ///< a share of the coordinates: less is their rounding
  static constexpr double same_direction = 1e-7;

  static void add(const Plane& plane, std::array<Plane, max_planes>& planes, std::size_t& count);

  std::unique_ptr<Sweeper> sweeper_;
  Coupling coupling_;
  double skin_;
  int rounds_;
  Vec3 position_ = Vec3::Zero(), goal_before_ = Vec3::Zero();
};

/// A plane of an earlier one's direction takes its place: both would be parallel to rounding.
void SweepAndSlide::add(const Plane& plane, std::array<Plane, max_planes>& planes, std::size_t& count) {
  std::size_t place = 0;
  while (place < count && (planes[place].normal - plane.normal).norm() > same_direction) ++place;
  planes[place] = plane;
  count = std::max(count, place + 1);
}

void SweepAndSlide::step(const Vec3& goal, Step& step) {
  step.begin(position_);
  std::array<Plane, max_planes> planes;
  std::size_t count = 0;
  const bool has_friction = coupling_.static_friction > 0 || coupling_.dynamic_friction > 0;
  for (int round = 0; round < rounds_ && count < max_planes; ++round) {
    Vec3 target = nearest_outside(goal, {planes.data(), count}, position_);
    if (count > 0) target = held_by_friction(position_, target, goal, coupling_);
    const Vec3 way = target - position_;
    const double length = way.norm();
    if (!(length > no_way * (position_.norm() + goal.norm()))) break;
    const std::optional<SweepHit> hit = sweeper_->first_hit(position_, target, coupling_.radius);
    if (!hit) {
      position_ = target;
      step.go(target);
      if (count == 0 || has_friction) break;
      count = 0;  // the next round finds those planes again that it is still on
      continue;
    }
    const double short_of = std::max(hit->fraction - skin_ / length, 0.0);
    position_ += short_of * way;
    step.go(position_);
    add({hit->normal, hit->normal.dot(position_)}, planes, count);
  }
  if (!position_.allFinite()) step.status = Status::no_answer;
  step.contacts = position_ == goal ? 0 : std::max<std::size_t>(count, 1);
  if (step.contacts > 0 && step.status == Status::free) {
    step.status = Status::in_contact;
    step.force = coupling_force(position_, goal, goal_before_, coupling_);
  }
  goal_before_ = goal;
}

constexpr int ruspini_rounds = 20;
/// Bullet's btKinematicCharacterController, the loop that its users begin with, slides ten times.
constexpr int engine_rounds = 10;

}  // namespace

std::unique_ptr<ProxyMethod> virtual_proxy_method(const MethodRequest& request) {
  return std::make_unique<SweepAndSlide>(sweeper_for(request), request.coupling, 0, ruspini_rounds);
}

std::unique_ptr<ProxyMethod> engine_sweep_method(const MethodRequest& request) {
  return std::make_unique<SweepAndSlide>(sweeper_for(request), request.coupling,
                                         request.options.number("skin"), engine_rounds);
}

}  // namespace touchmark::bench::proxies
