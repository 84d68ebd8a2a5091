#include "core/haptics/proxy_motion.h"

#include <algorithm>
#include <cmath>

#include "core/geometry/sphere_triangle_sweep.h"

namespace touchmark {
namespace {

/// A tick tries so often; what is still left is for the next one.
constexpr int max_rounds = 8;
/// One slide is enough on planes. On a curve of the ball's own each comes nearer by a share: what so many in
/// a row have not reached is left to the next tick.
constexpr int max_slides = 3;
/// So often a tick goes straight on at its end: not far at first, then however far it is.
constexpr int max_descents = 2;
/// A goal that has been the same for so many ticks has been followed as far as it will be.
constexpr int ticks_to_settle = 8;

double largest(const Vec3& v) noexcept { return v.cwiseAbs().maxCoeff(); }

}  // namespace

ProxyMotion::ProxyMotion(const Coupling& coupling, const TriangleMesh* mesh,
                         const ForceShading* shading) noexcept
    : coupling_(coupling), shading_(shading) {
  surface_moved(mesh);
  place(Vec3::Zero());
}

void ProxyMotion::place(const Vec3& position) noexcept {
  state_ = {};
  state_.position = state_.way[0] = goal_ = position;
  surface_moved(mesh_);
}

void ProxyMotion::surface_moved(const TriangleMesh* mesh) noexcept {
  mesh_ = mesh;
  mesh_size_ = mesh == nullptr ? 0 : std::max(largest(mesh->bounds().min), largest(mesh->bounds().max));
  planes_.clear();
  same_goal_ = 0;
  may_touch_ = true;
  free_eighths_.reset();
  rests_ = false;
}

void ProxyMotion::begin_way(const Vec3& at) noexcept {
  state_.position = state_.way[0] = at;
  state_.pieces = state_.carried = 0;
  state_.unfinished = false;
}

void ProxyMotion::carry(const Vec3& to, const ProxyState::Carry& carry) noexcept {
  state_.carries[state_.carried++] = carry;
  state_.position = state_.way[++state_.pieces] = to;
}

bool ProxyMotion::begin(const Vec3& goal) noexcept {
  if (!goal.allFinite()) {
    state_.status = ProxyStatus::unanswered;
    state_.contacts = 0;
    state_.force.setZero();
    return false;
  }
  same_goal_ = goal == goal_ ? same_goal_ + 1 : 0;
  goal_before_ = goal_;
  goal_ = goal;
  if (same_goal_ > 0 && (rests_ || same_goal_ >= ticks_to_settle)) {
    if (state_.status == ProxyStatus::unanswered) note_contacts();
    if (state_.contacts > 0) set_force();
    return false;
  }
  size_ = largest(position()) + mesh_size_ + coupling_.radius;
  skin_ = 0x1p-43 * size_ + 0x1p-48 * largest(goal);
  last_slide_ = 0;
  rounds_ = slides_ = descents_ = 0;
  has_slid_ = false;
  return true;
}

/// Is a point of the surface known that the ball would come too near to on the straight way to its goal?
bool ProxyMotion::is_surely_blocked() const noexcept {
  const Vec3 way = goal_ - position();
  const double squared = way.squaredNorm(), enough = kept_ - skin_;
  if (!(enough > 0) || !(squared > 0)) return false;
  return std::ranges::any_of(planes_.all(), [&](const ContactPlane& plane) {
    const Vec3 to = plane.anchor - position();
    const double part = std::clamp(to.dot(way) / squared, 0.0, 1.0);
    return (to - part * way).squaredNorm() < enough * enough;
  });
}

/// After the last slide along a curve the proxy is off it: what is left is to go straight on, to where the
/// surface holds it. By the planes around that is near, and a short way costs less to ask for than all of it.
/// Nothing where the surface holds it already.
std::optional<Vec3> ProxyMotion::descent() noexcept {
  constexpr double negligible = 0x1p-11;
  const Vec3 way = goal_ - position();
  const double length = way.norm();
  double gap = length;
  for (const ContactPlane& plane : planes_.all()) {
    const double down = -plane.normal.dot(way) / length;
    if (down > 0) gap = std::min(gap, (plane.height(position()) - kept_) / down);
  }
  if (descents_ == max_descents || gap <= std::max(16 * skin_, negligible * kept_)) return std::nullopt;
  planes_.clear();
  has_moved_ = false;
  if (++descents_ == max_descents || 2 * gap >= length) return goal_;
  return position() + 2 * gap / length * way;
}

std::optional<Vec3> ProxyMotion::next_target() noexcept {
  if (rounds_ == 0 && !planes_.empty() && !is_surely_blocked()) planes_.clear();
  if (state_.pieces == ProxyState::max_pieces) return std::nullopt;
  if (descents_ > 0 || has_slid_ || slides_ == max_slides || rounds_++ == max_rounds) return descent();
  Vec3 target = planes_.nearest_to(goal_, position(), kept_ + skin_, skin_ / 8);
  if (!planes_.empty() && coupling_.has_friction()) {
    target = held_by_friction(position(), target, goal_, coupling_);
    has_slid_ = true;
  }
  if (target == position() || (target != goal_ && (target - position()).norm() <= skin_)) return std::nullopt;
  has_moved_ = false;
  return target;
}

void ProxyMotion::go(const Vec3& to) noexcept {
  if (to == position()) return;
  last_slide_ = planes_.empty() ? 0 : (to - position()).norm();
  if (!planes_.empty()) ++slides_;
  state_.position = state_.way[++state_.pieces] = to;
  has_moved_ = true;
}

/// The piece from here to the rounded end is nowhere farther than position_error from the sweep's own way,
/// and of the margin one rounding is lost where it is added to the distance kept.
double ProxyMotion::margin(const Vec3& target) const noexcept {
  const double margin = skin_ / 8;
  const double needed = position_error({position(), target, kept_}) + 0x1p-50 * kept_;
  return kept_ > 0 && target != goal_ && needed < margin ? margin : 0;
}

std::optional<Vec3> ProxyMotion::approach(const Vec3& target, const Impact& impact,
                                          int retreat) const noexcept {
  constexpr double grazing = 0x1p-40;
  const Vec3 way = target - position();
  const double length = way.norm();
  const Vec3 normal = met_normal(impact, target);
  const double back = std::ldexp(skin_, 3 * retreat) / std::max(-normal.dot(way) / length, grazing);
  const double part = impact.fraction - back / length;
  if (!(part * length > skin_)) return std::nullopt;
  return position() + part * way;
}

/// The normal of a face by its corners, either way round; nothing where it has no area, or no mesh is known.
std::optional<Vec3> ProxyMotion::face_normal(TriangleId id) const noexcept {
  if (mesh_ == nullptr) return std::nullopt;
  std::size_t index = id;
  if (!mesh_->ids().empty())
    index = static_cast<std::size_t>(std::ranges::lower_bound(mesh_->ids(), id) - mesh_->ids().begin());
  if (index >= mesh_->size()) return std::nullopt;
  const Vec3& a = mesh_->corner(index, 0);
  const Vec3 normal = (mesh_->corner(index, 1) - a).cross(mesh_->corner(index, 2) - a);
  const double area = normal.norm();
  if (!(area > 0)) return std::nullopt;
  return normal / area;
}

/// What rounding may do to a unit normal over this distance.
double ProxyMotion::normal_error(double distance) const noexcept { return 0x1p-48 * size_ / distance; }

/// The contact's own normal where it is well off the surface. Nearer, a face's, if it may be that one:
/// between two faces a point that stands on an edge to rounding is nowhere in particular.
std::optional<Vec3> ProxyMotion::normal_at(const Contact& contact) const noexcept {
  constexpr double good = 1e-9, usable = 1e-4, far_off = 0.5;
  const double error = normal_error(contact.distance);
  if (error <= good) return contact.normal;
  if (const std::optional<Vec3> face = face_normal(contact.triangle)) {
    const Vec3 normal = face->dot(contact.normal) < 0 ? Vec3(-*face) : *face;
    if ((normal - contact.normal).norm() <= std::min(8 * error, far_off)) return normal;
  }
  if (error <= usable) return contact.normal;
  return std::nullopt;
}

Vec3 ProxyMotion::met_normal(const Impact& impact, const Vec3& target) const noexcept {
  constexpr double good = 1e-9;
  if (normal_error(kept_) <= good) return impact.contact.normal;
  const std::optional<Vec3> face = face_normal(impact.contact.triangle);
  if (!face) return impact.contact.normal;
  return face->dot(target - position()) > 0 ? Vec3(-*face) : *face;
}

/// The plane may be among those around already, if it has moved.
void ProxyMotion::meet(const Impact& impact, const Vec3& target) noexcept {
  const ContactPlane plane{met_normal(impact, target), impact.contact.point, 0, impact.contact.triangle};
  planes_.meet(plane, has_moved_ ? 0 : skin_);
  has_slid_ = false;
  slides_ = std::max(slides_ - 1, 0);
}

/// After a slide, so far that what it has come off by stays in sight: on a curve of the ball's own radius, or
/// off a face for a point. Farther off a face, a point goes straight on.
double ProxyMotion::look() const noexcept {
  const double off = kept_ > skin_ ? std::min(last_slide_ * last_slide_ / kept_, kept_ / 8)
                                   : std::min(last_slide_ / 4, size_ / 256);
  return kept_ + 4 * skin_ + off;
}

/// A contact whose point is behind the plane of a nearer one tells nothing new. It may be of a triangle that
/// rises elsewhere: that one is met on the way.
void ProxyMotion::look_around(std::span<const Contact> contacts) noexcept {
  planes_.clear();
  for (const Contact& contact : contacts) {
    if (!planes_.protrudes(contact.point, skin_ / 4)) continue;
    if (const std::optional<Vec3> normal = normal_at(contact))
      planes_.add({*normal, contact.point, 0, contact.triangle});
  }
}

/// Is the end no farther from the goal than the start, but for rounding? By the difference of the squares,
/// which cancels less than they do.
bool ProxyMotion::came_nearer() const noexcept {
  const Vec3& start = state_.way[state_.carried];
  const Vec3 moved = position() - start, before = start - goal_;
  return moved.dot(2 * before + moved) <= before.norm() * skin_ / 8;
}

void ProxyMotion::set_force() noexcept {
  state_.force = coupling_force(position(), goal_, goal_before_, coupling_);
  if (shading_ != nullptr) state_.force = shading_->shaded(state_, coupling_.shading);
}

void ProxyMotion::note_contacts() noexcept {
  state_.contacts = 0;
  state_.force.setZero();
  state_.status = ProxyStatus::free;
  if (position() != goal_) {
    planes_.nearest_to(goal_, position(), kept_ + skin_, skin_ / 8);
    for (const std::uint8_t index : planes_.active()) {
      const ContactPlane& plane = planes_.all()[index];
      state_.points[state_.contacts] = plane.anchor;
      state_.triangles[state_.contacts] = plane.triangle;
      state_.normals[state_.contacts++] = plane.normal;
    }
    if (state_.contacts == 0) {
      state_.points[0] = position();
      state_.triangles[0].reset();
      state_.normals[state_.contacts++] = (position() - goal_).normalized();
    }
    state_.status = ProxyStatus::in_contact;
    set_force();
  }
  if (may_touch_) state_.status = ProxyStatus::stuck;
}

const ProxyState& ProxyMotion::end(bool is_unfinished) noexcept {
  if (state_.pieces > state_.carried && !is_at_goal() && !came_nearer()) {
    state_.position = state_.way[state_.carried];
    state_.pieces = state_.carried;
    planes_.clear();
  }
  if (is_at_goal()) planes_.clear();
  rests_ = state_.pieces == 0 && !is_unfinished;
  if (is_unfinished) same_goal_ = 0;
  state_.unfinished = is_unfinished;
  note_contacts();
  return state_;
}

}  // namespace touchmark
