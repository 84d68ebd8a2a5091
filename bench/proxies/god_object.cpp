// The god-object of C. B. Zilles and J. K. Salisbury, "A constraint-based god-object method for haptic
// display", IROS 1995: a point. A face becomes active where the line from the god-object to its goal goes
// through it from outside; the new place minimises the spring's energy on the active planes, by Lagrange
// multipliers; the line to the new place is asked again until it meets nothing more, at most three planes. A
// face is left when the goal is in front of it or its multiplier pulls. Faces hold from outside only, as in
// the paper. The paper lets edges overlap so that rounding opens no gap, and does not say by how much: here
// 1e-6 of the face, and the point may be as far behind its plane as that of the largest coordinate times
// 2^-40.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <vector>

#include "bench/proxies/half_spaces.h"
#include "bench/proxies/methods.h"
#include "bench/proxies/plain_mesh.h"

namespace touchmark::bench::proxies {
namespace {

using oracle::Triangle;

constexpr double overlap = 1e-6;         ///< a share of the face's height
constexpr double plane_slack = 0x1p-40;  ///< a share of the largest coordinate
constexpr int max_rounds = 10;

Plane plane_of(const Triangle& t) {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
  return {normal, normal.dot(t[0])};
}

/// Returns true if the point of the plane is on the face or as near beside it as faces overlap.
bool is_over(const Triangle& t, const Vec3& point) {
  const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]);
  const double area = normal.squaredNorm();
  for (std::size_t i = 0; i < 3; ++i)
    if ((t[(i + 1) % 3] - t[i]).cross(point - t[i]).dot(normal) < -overlap * area) return false;
  return true;
}

class GodObject final : public ProxyMethod {
 public:
  GodObject(const TriangleMesh& mesh, const Coupling& coupling) : mesh_(mesh), coupling_(coupling) {}

  void place(const Vec3& position) override {
    position_ = goal_before_ = position;
    active_.clear();
  }
  void step(const Vec3& goal, Step& step) override;
  void update(const TriangleMesh& mesh) override {
    mesh_.update(mesh);
    active_.clear();
  }
  std::uint64_t work() const override { return mesh_.work(); }

 private:
  void keep_active(const Vec3& goal);
  /// The nearest point on the active planes; leaves those that pull.
  Vec3 target(const Vec3& goal);
  std::optional<std::uint32_t> first_crossed(const Vec3& to);

  PlainMesh mesh_;
  Coupling coupling_;
  Vec3 position_ = Vec3::Zero(), goal_before_ = Vec3::Zero();
  std::vector<std::uint32_t> active_;
};

/// A face stays active while the goal is behind it and the god-object over it.
void GodObject::keep_active(const Vec3& goal) {
  std::erase_if(active_, [&](std::uint32_t index) {
    const Triangle t = oracle::triangle_of(mesh_.mesh(), index);
    return !(plane_of(t).height(goal) < 0) || !is_over(t, position_);
  });
}

Vec3 GodObject::target(const Vec3& goal) {
  while (!active_.empty()) {
    std::array<Plane, 3> planes;
    for (std::size_t i = 0; i < active_.size(); ++i)
      planes[i] = plane_of(oracle::triangle_of(mesh_.mesh(), active_[i]));
    const std::optional<OnPlanes> found = nearest_on(goal, {planes.data(), active_.size()});
    if (!found) {  // parallel planes: the one found first holds
      active_.pop_back();
      continue;
    }
    Eigen::Index pulling = 0;
    if (found->multipliers.head(static_cast<Eigen::Index>(active_.size())).minCoeff(&pulling) >= 0)
      return found->point;
    active_.erase(active_.begin() + pulling);
  }
  return goal;
}

std::optional<std::uint32_t> GodObject::first_crossed(const Vec3& to) {
  std::optional<std::uint32_t> first;
  double least = 2;
  const double slack = plane_slack * std::max(position_.cwiseAbs().maxCoeff(), to.cwiseAbs().maxCoeff());
  mesh_.near(position_, to, slack, [&](std::uint32_t index, const Triangle& t) {
    if (std::find(active_.begin(), active_.end(), index) != active_.end()) return;
    const Plane plane = plane_of(t);
    const double before = plane.height(position_), after = plane.height(to);
    if (!(before >= -slack) || !(after < -slack) || !std::isfinite(before)) return;
    const double fraction = std::max(before, 0.0) / (std::max(before, 0.0) - after);
    if (fraction < least && is_over(t, position_ + fraction * (to - position_)))
      least = fraction, first = index;
  });
  return first;
}

void GodObject::step(const Vec3& goal, Step& step) {
  step.begin(position_);
  keep_active(goal);
  const bool was_in_contact = !active_.empty();
  Vec3 to = target(goal);
  for (int round = 0;; ++round) {
    const std::optional<std::uint32_t> crossed = first_crossed(to);
    if (!crossed) break;
    if (active_.size() == 3 || round == max_rounds) {  // held from more sides than a point can use
      to = position_;
      break;
    }
    active_.push_back(*crossed);
    to = target(goal);
  }
  if (was_in_contact) to = held_by_friction(position_, to, goal, coupling_);
  position_ = to;
  step.go(to);
  step.contacts = active_.size();
  if (!active_.empty()) {
    step.status = Status::in_contact;
    step.force = coupling_force(position_, goal, goal_before_, coupling_);
  }
  goal_before_ = goal;
}

}  // namespace

std::unique_ptr<ProxyMethod> god_object_method(const MethodRequest& request) {
  Coupling point = request.coupling;
  point.radius = 0;
  return std::make_unique<GodObject>(request.mesh, point);
}

}  // namespace touchmark::bench::proxies
