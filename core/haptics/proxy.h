/// A haptic proxy: a ball, or a point, that follows the device's tip and never crosses the surface.
///
/// The invariant, decided exactly each tick: every straight piece of its way is farther from the surface than
/// the radius. A piece is gone only after a detector that decides exactly has said that its sweep meets
/// nothing, or how far a slightly larger ball meets nothing; everything else only suggests where to try.
/// docs/proxy.md has the argument and what it leaves open.
///
///   const auto detector = touchmark::SphereCluster::build(mesh);
///   touchmark::SphereCluster::Session session;
///   touchmark::Proxy proxy(detector, {.radius = 0.005, .stiffness = 800}, &mesh);
///   proxy.place(device.position());
///   for (;;) device.send(proxy.step(device.position(), session).force);
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/detector.h"
#include "core/haptics/contact_planes.h"
#include "core/haptics/coupling.h"
#include "core/haptics/force_planes.h"
#include "core/haptics/force_shading.h"
#include "core/haptics/proxy_motion.h"
#include "core/mesh_motion.h"
#include "core/probe.h"
#include "core/triangle_mesh.h"

namespace touchmark {

// Version 14 takes `noexcept ->` apart.
// clang-format off
/// What a proxy asks of a detector, by the concepts of core/detector.h: whether and where the way is free, and
/// what is around. The invariant needs one that `decides_exactly`.
template <class D>
concept GuidesProxy = requires(const D& detector, const Probe& probe, const Sweep& sweep, double reach,
                               typename D::Session& session, std::span<Contact> into) {
  { detector.touches(probe, session) } noexcept -> std::same_as<bool>;
  { detector.first_hit(sweep, session) } noexcept -> std::same_as<std::optional<Impact>>;
  { detector.contacts(probe, reach, session, into) } noexcept -> std::same_as<std::size_t>;
};
// clang-format on

/// A detector of bodies that can say what they meet while they move, as a scene can.
template <class D>
concept SeesMotion = requires {
  typename D::Session::Moving;
};
/// What a proxy over D is told of a body that has moved.
template <class D>
struct MovingOf {
  struct Type {};
};
/// The description that D itself takes.
template <SeesMotion D>
struct MovingOf<D> {
  using Type = typename D::Session::Moving;
};

/// One proxy over one detector, which must outlive it. Steps take no memory, and each asks a bounded number
/// of questions, within Coupling::max_work where that is set: what is not known by then counts as touched.
template <GuidesProxy D>
class Proxy {
 public:
  /// `mesh` is the detector's, for the normals of its faces: a bare point that stands on a face to rounding
  /// has no other. It must outlive the proxy; null where there is none, or only balls are asked for.
  /// `shading` turns the force where the coupling asks for it, and outlives the proxy, too.
  explicit Proxy(const D& detector, const Coupling& coupling, const TriangleMesh* mesh = nullptr,
                 const ForceShading* shading = nullptr) noexcept
      : detector_(&detector), motion_(coupling, mesh, shading) {}

  /// Puts the proxy anywhere and forgets all contacts. Where that is too near to the surface it is `stuck`.
  void place(const Vec3& position) noexcept { motion_.place(position); }
  /// To be called after each update of the detector. The proxy stays where it is; where the surface was moved
  /// onto it, it is `stuck` until it is off, and comes no nearer meanwhile.
  void surface_moved(const TriangleMesh* mesh = nullptr) noexcept {
    known_eighths_ = motion_.free_eighths().value_or(8);
    motion_.surface_moved(mesh);
  }
  /// To be called before an update of the detector that may move the surface through the proxy, and before
  /// surface_moved. The proxy goes straight from where it is to where the surface pushes it, and meets
  /// nothing on that way while the surface moves. Returns false, and stays, where no such way is found.
  bool surface_moving(const MeshMotion& motion,
                      typename D::Session& session) noexcept requires AnswersMovingSweep<D> {
    const int known = motion_.free_eighths().value_or(8);
    motion_.begin_way(motion_.position());
    is_pushed_ = false;
    // With the largest share of the radius with which it is free all along, less a half eighth of it.
    for (int eighths = known; eighths >= 0; --eighths)
      if (is_pushed(motion, known, eighths, session)) return true;
    return false;
  }
  /// To be called instead where bodies of a scene have moved, after Scene::move: from where the last step
  /// left them to where they are now. The next step begins with what they do to the proxy: it rests until
  /// one meets it, and then goes with that one. `moving` outlives that step.
  void bodies_moved(std::span<const typename MovingOf<D>::Type> moving) noexcept requires SeesMotion<D> {
    surface_moved();
    moving_ = moving;
  }

  /// One tick: follows the goal as far as the surface lets it. The state is this tick's, and stays where it
  /// is until the next one.
  const ProxyState& step(const Vec3& goal, typename D::Session& session) noexcept {
    if (!is_pushed_) motion_.begin_way(motion_.position());
    is_pushed_ = false;
    if constexpr (SeesMotion<D>) {
      // With the largest share of the radius with which it is free all along.
      for (int eighths = known_eighths_; !moving_.empty() && !is_carried(eighths, session);) --eighths;
      moving_ = {};
    }
    if constexpr (requires { largest_of_shapes(*detector_); })
      motion_.set_surface_size(largest_of_shapes(*detector_));
    if (!motion_.begin(goal)) return motion_.state();
    work_ = coupling().max_work > 0 ? limited_work(session) : nullptr;
    if (work_ != nullptr) {
      const std::uint64_t before = work_->spent();
      work_->limit = before + std::min(coupling().max_work, LimitedWork::unlimited - before);
      work_->undecided = false;
    }
    if (choose_kept(session)) slide(session);
    const bool is_unfinished = is_undecided();
    if (work_ != nullptr) work_->limit = LimitedWork::unlimited;
    return motion_.end(is_unfinished);
  }

  /// Sets Coupling::max_work for the steps to come: a loop may spend what it has left.
  void limit_work(std::uint64_t max_work) noexcept { motion_.limit_work(max_work); }
  /// Returns the force on a device that has gone on to `goal` since the last step, by the planes that held
  /// the proxy then. It asks the detector nothing, and the proxy stays.
  Vec3 force_now(const Vec3& goal) const noexcept { return planes().force(goal); }
  /// Returns what force_now goes by, for another thread.
  ForcePlanes planes() const noexcept { return motion_.planes(); }

  const ProxyState& state() const noexcept { return motion_.state(); }
  const Coupling& coupling() const noexcept { return motion_.coupling(); }

 private:
  /// Null where the detector keeps to no limit.
  LimitedWork* limited_work(typename D::Session& session) const noexcept {
    if constexpr (KeepsToLimit<D>)
      return &session.work;
    else if constexpr (requires { detector_->limited_work(session); })
      return detector_->limited_work(session);
    else
      return nullptr;
  }
  /// Returns true if a question of this step has remained open.
  bool is_undecided() const noexcept { return work_ != nullptr && work_->undecided; }

  bool touches(double distance, typename D::Session& session) const noexcept {
    return detector_->touches({motion_.position(), distance}, session);
  }
  std::optional<Impact> first_hit(const Vec3& to, typename D::Session& session,
                                  double margin = 0) const noexcept {
    return detector_->first_hit({motion_.position(), to, motion_.kept() + margin}, session);
  }

  /// Chooses the distance that this tick keeps: the radius, or where that is not free the largest of a few
  /// shares of it that is. What the last tick kept is still free. Returns false on the surface itself, and
  /// where none is known to be free.
  bool choose_kept(typename D::Session& session) noexcept {
    const double radius = motion_.coupling().radius;
    motion_.keep(radius);
    if (!motion_.may_touch()) return true;
    std::optional<int> eighths = motion_.free_eighths();
    if (eighths) {
      while (*eighths < 8 && !touches(radius * (*eighths + 1) / 8, session)) ++*eighths;
    } else {
      eighths = 8;
      while (touches(motion_.kept(), session)) {
        if (is_undecided() || --*eighths < 0 || !(motion_.kept() > 0)) return false;
        motion_.keep(radius * *eighths / 8);
      }
    }
    motion_.is_free_by(*eighths);
    return true;
  }

  /// Goes to a place if nothing is met on the way there while the mesh moves.
  bool is_pushed_to(const Sweep& sweep, const MeshMotion& motion, std::optional<Impact>& met,
                    typename D::Session& session) noexcept {
    met = detector_->first_hit_moving(sweep, motion, session);
    if (met) return false;
    is_pushed_ = sweep.to != sweep.from;
    if (is_pushed_) motion_.carry(sweep.to, {0, 0, 1});
    return true;
  }
  /// Tries ways to the nearest places that are off what was met on those before, where that is after the
  /// tick. Then it goes ahead of what it is met by first, ever faster.
  bool is_pushed(const MeshMotion& motion, int known, int eighths, typename D::Session& session) noexcept {
    constexpr double first_share = 0x1p-8;  // of the surface's way, to stay off besides
    const double eighth = motion_.coupling().radius / 8;
    const double longest = motion.max_shift() + 2 * motion_.coupling().radius;
    const Vec3 start = motion_.position();
    Sweep sweep{start, start, eighth * std::max(eighths - 0.5, 0.0)};
    std::optional<Impact> met;
    ContactPlanes planes;
    Vec3 ahead = Vec3::Zero();
    double beyond = 0;
    for (int round = 0; round < 8 && (sweep.to - start).norm() <= longest; ++round) {
      if (is_pushed_to(sweep, motion, met, session)) return true;
      const Contact& contact = met->contact;
      const Contact after = motion.carried(contact, met->fraction);
      if (round == 0) ahead = after.point - contact.point;
      // The surface comes from behind what it pushes.
      const Vec3 coming = after.point - contact.point - (1 - met->fraction) * (sweep.to - start);
      const bool is_turned = !(sweep.radius > 0) && after.normal.dot(coming) < 0;
      const ContactPlane plane{is_turned ? Vec3(-after.normal) : after.normal, after.point, 0,
                               contact.triangle};
      planes.add(plane);
      beyond = std::max(beyond, std::ldexp(first_share, round) * after.distance);
      const double off = eighth * known + beyond;
      const Vec3 above = sweep.to + std::max(off - plane.height(sweep.to), 0.0) * plane.normal;
      sweep.to = planes.nearest_to(start, above, off, beyond / 8);
    }
    for (double share = first_share; share <= 2; share *= 2) {
      sweep.to = start + (1 + share) * ahead;
      if (is_pushed_to(sweep, motion, met, session)) return true;
    }
    return false;
  }

  /// Rests until a body comes as near as so many eighths of the radius, and rests in that body's frame from
  /// then on, where all others stay off by half an eighth less; one that does not carries it on, and that is
  /// half an eighth less again. Returns false, and stays, where that is not free, but for 0 eighths.
  bool is_carried(int eighths, typename D::Session& session) noexcept {
    const double eighth = motion_.coupling().radius / 8, all = eighth * eighths;
    const bool at_any_price = !(all > 0);
    const Vec3 start = motion_.position();
    const auto body_of = [&](const auto& hit) {
      return std::ranges::find_if(moving_, [&](const auto& m) { return m.body() == hit->body; });
    };
    const auto met = detector_->first_hit_moving({start, start, all}, moving_, session);
    if (!met) return true;
    auto carrier = body_of(met);
    if (carrier == moving_.end()) return at_any_price;
    double begin = met->impact.fraction, time = begin;
    Vec3 at = start;
    const auto carry_to = [&](double end) {
      at = carrier->carried(at, {time, end});
      time = end;
    };
    const auto note_carry = [&] {
      motion_.carry(at, {static_cast<std::size_t>(carrier - moving_.begin()), begin, time});
    };
    while (time < 1) {
      const std::size_t count = motion_.state().carried;
      const double end = std::min(time + carried_part(*carrier, at), 1.0);
      const double kept = std::max(all - eighth * static_cast<double>(1 + count) / 2, 0.0);
      const Sweep chord{at, carrier->carried(at, {time, end}), kept + carrier->sagitta(at, {time, end})};
      const auto hit = detector_->first_hit_moving(chord, moving_, session, {time, end}, &*carrier);
      const auto next = hit ? body_of(hit) : moving_.end();
      if (!hit || next == moving_.end() || count + 1 == ProxyState::max_carries) {
        carry_to(end);
        if (!hit || at_any_price) continue;
        motion_.begin_way(start);
        return false;
      }
      carry_to(time + hit->impact.fraction * (end - time));
      note_carry();
      begin = time;
      carrier = next;
    }
    note_carry();
    return true;
  }

  /// Returns how long a part of the tick may be in which the way of what is carried is nearly straight.
  template <class Moving>
  double carried_part(const Moving& carrier, const Vec3& at) const noexcept {
    const double bend = carrier.sagitta(at, {0, 1}), slack = motion_.coupling().radius / 64;
    return bend > slack ? std::max(std::sqrt(slack / bend), 1.0 / 16) : 1;
  }

  void slide(typename D::Session& session) noexcept {
    while (const std::optional<Vec3> target = motion_.next_target()) {
      double margin = motion_.margin(*target);
      std::optional<Impact> impact = first_hit(*target, session, margin);
      // It stands within the margin: without one, the sweep may still be free.
      if (margin > 0 && impact && impact->fraction == 0) {
        margin = 0;
        impact = first_hit(*target, session);
      }
      if (is_undecided()) return;
      if (!impact) {
        motion_.go(*target);
        if (motion_.is_at_goal()) return;
        look_around(session);
        continue;
      }
      for (int retreat = 0; retreat < ProxyMotion::max_retreats; ++retreat) {
        const std::optional<Vec3> to = motion_.approach(*target, *impact, retreat);
        if (!to) break;
        if (margin == 0 && first_hit(*to, session)) continue;
        motion_.go(*to);
        look_around(session);
        break;
      }
      motion_.meet(*impact, *target);
    }
  }

  void look_around(typename D::Session& session) noexcept {
    std::array<Contact, ProxyMotion::max_contacts> around;
    const Probe here{motion_.position(), 0};
    std::size_t count = 0;
    if constexpr (AnswersNearestContacts<D>)
      count = detector_->nearest_contacts(here, motion_.look(), session, around);
    else
      count = detector_->contacts(here, motion_.look(), session, around);
    motion_.look_around(std::span(around).first(count < around.size() ? count : around.size()));
  }

  const D* detector_;
  ProxyMotion motion_;
  LimitedWork* work_ = nullptr;                         ///< This step's, where it is limited.
  std::span<const typename MovingOf<D>::Type> moving_;  ///< what the next step has to follow
  bool is_pushed_ = false;                              ///< the way of the next step has begun
  int known_eighths_ = 8;  ///< how many eighths of the radius were free before that
};

}  // namespace touchmark
