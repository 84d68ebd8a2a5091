// Ruspini's loop over one of our detectors, whose sweeps are decided exactly: a straight piece is gone only
// where the detector has said that no point of it is within the radius. So it cannot cross, whatever the
// arithmetic in between rounds. What this costs is the question asked again, and that a proxy stays a few
// roundings off.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "bench/experiments/proxy/half_spaces.h"
#include "bench/experiments/proxy/methods.h"
#include "bench/experiments/proxy/sweeper.h"

namespace touchmark::bench::experiments::proxy {
namespace {

class ExactSlide final : public ProxyMethod {
 public:
  ExactSlide(std::unique_ptr<Sweeper> sweeper, const TriangleMesh& mesh, const Coupling& coupling)
      : sweeper_(std::move(sweeper)), mesh_(mesh), coupling_(coupling) {}

  void place(const Vec3& position) override {
    position_ = goal_before_ = position;
    may_touch_ = true;
  }
  void step(const Vec3& goal, Step& step) override;
  void update(const TriangleMesh& mesh) override {
    sweeper_->update(mesh);
    mesh_ = mesh;
    may_touch_ = true;
  }
  std::uint64_t work() const override { return sweeper_->work(); }

 private:
  static constexpr std::size_t max_planes = 8;
  static constexpr int rounds = 12, retreats = 6;
  static constexpr double rounding = 0x1p-50;  ///< a share of the coordinates

  std::optional<SweepHit> hit_to(const Vec3& to) { return sweeper_->first_hit(position_, to, kept_); }
  /// Chooses the distance that this tick keeps: the radius, or where that is not free the largest of a few
  /// shares of it that is. Returns false where the position is on the surface itself.
  bool choose_kept();
  Vec3 normal_of(const SweepHit& hit, const Vec3& target) const;
  /// Goes as far towards what was hit as is surely free; stays where that is nowhere.
  void approach(const Vec3& target, double fraction, Step& step);
  void add(const Vec3& normal, double lift);
  /// Slides towards the goal; returns how many planes held it.
  std::size_t slide(const Vec3& goal, double lift, Step& step);

  std::unique_ptr<Sweeper> sweeper_;
  TriangleMesh mesh_;
  Coupling coupling_;
  Vec3 position_ = Vec3::Zero(), goal_before_ = Vec3::Zero();
  std::array<Plane, max_planes> planes_;
  std::size_t count_ = 0;
  double kept_ = 0;        ///< at least so far off it stays in this tick
  bool may_touch_ = true;  ///< it was put there, or the surface has moved
};

bool ExactSlide::choose_kept() {
  kept_ = coupling_.radius;
  if (!may_touch_) return true;
  may_touch_ = hit_to(position_).has_value();
  for (int eighths = 7; hit_to(position_); --eighths) {
    if (!(kept_ > 0)) return false;
    kept_ = eighths > 0 ? coupling_.radius * eighths / 8 : 0;
  }
  return true;
}

/// A bare point that stands on a face to rounding is nowhere from its contact: there the face tells the
/// normal.
Vec3 ExactSlide::normal_of(const SweepHit& hit, const Vec3& target) const {
  if (kept_ > 0) return hit.normal;
  std::size_t index = hit.triangle;
  if (!mesh_.ids().empty())
    index = static_cast<std::size_t>(std::lower_bound(mesh_.ids().begin(), mesh_.ids().end(), hit.triangle) -
                                     mesh_.ids().begin());
  const Vec3 face = (mesh_.corner(index, 1) - mesh_.corner(index, 0))
                        .cross(mesh_.corner(index, 2) - mesh_.corner(index, 0));
  const double area = face.norm();
  if (!(area > 0)) return hit.normal;
  return (face.dot(target - position_) > 0 ? -1 : 1) * face / area;
}

void ExactSlide::approach(const Vec3& target, double fraction, Step& step) {
  const Vec3 way = target - position_;
  const double length = way.norm();
  double short_of = 4 * rounding * (position_.norm() + coupling_.radius);
  for (int retreat = 0; retreat < retreats; ++retreat, short_of *= 8) {
    const double part = fraction - short_of / length;
    if (!(part > 0)) return;
    const Vec3 to = position_ + part * way;
    if (hit_to(to)) continue;
    position_ = to;
    step.go(to);
    return;
  }
}

/// A plane of an earlier one's direction takes its place, and is lifted further.
void ExactSlide::add(const Vec3& normal, double lift) {
  constexpr double same_direction = 1e-7;
  for (std::size_t i = 0; i < count_; ++i) {
    if ((planes_[i].normal - normal).norm() > same_direction) continue;
    planes_[i] = {normal, std::max(planes_[i].offset, normal.dot(position_)) + lift};
    return;
  }
  if (count_ < max_planes) planes_[count_++] = {normal, normal.dot(position_)};
}

std::size_t ExactSlide::slide(const Vec3& goal, double lift, Step& step) {
  const bool has_friction = coupling_.static_friction > 0 || coupling_.dynamic_friction > 0;
  std::size_t contacts = 0;
  count_ = 0;
  for (int round = 0; round < rounds; ++round) {
    Vec3 target = nearest_outside(goal, {planes_.data(), count_}, position_);
    if (count_ > 0) target = held_by_friction(position_, target, goal, coupling_);
    if (target == position_ || (count_ > 0 && !((target - position_).norm() > lift))) break;
    const std::optional<SweepHit> hit = hit_to(target);
    if (!hit) {
      position_ = target;
      step.go(target);
      if (count_ == 0 || has_friction) break;
      contacts = count_;
      count_ = 0;  // the next round finds those planes again that it is still on
      continue;
    }
    const Vec3 normal = normal_of(*hit, target);
    approach(target, hit->fraction, step);
    add(normal, rounding * (1 << round) * (position_.norm() + goal.norm() + coupling_.radius));
    contacts = std::max(contacts, count_);
  }
  return contacts;
}

/// A tick that comes no nearer to its goal than rounding is not gone, so that a resting goal lets the proxy
/// rest.
void ExactSlide::step(const Vec3& goal, Step& step) {
  step.begin(position_);
  const Vec3 start = position_;
  const bool is_off = choose_kept();
  const double lift = 64 * rounding * (position_.norm() + goal.norm() + coupling_.radius);
  const std::size_t contacts = is_off ? slide(goal, lift, step) : 0;
  if (position_ != goal && !((position_ - goal).norm() < (start - goal).norm() - lift)) {
    position_ = start;
    step.way.resize(1);
  }
  if (position_ != goal) {
    step.contacts = std::max<std::size_t>(contacts, 1);
    step.status = Status::in_contact;
    step.force = spring_force(position_, goal, goal_before_, coupling_);
  }
  if (may_touch_) step.status = Status::stuck;
  goal_before_ = goal;
}

}  // namespace

std::unique_ptr<ProxyMethod> exact_slide_method(const MethodRequest& request) {
  return std::make_unique<ExactSlide>(sweeper_of(request.roster, request.detector, request.mesh),
                                      request.mesh, request.coupling);
}

}  // namespace touchmark::bench::experiments::proxy
