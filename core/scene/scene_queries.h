/// The queries of a scene: docs/library-scenes.md describes their stages. Included by scene.h.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <tuple>

#include "core/scene/scene.h"

namespace touchmark {

template <BodyDetector D>
template <class Ask>
void Scene<D>::ask_listed(const Vec3& from, double length, const double& limit, Session& session,
                          std::span<const BodyId> done, const Ask& ask) const noexcept {
  for (NearBodies::Entry& entry : session.near.near()) {
    if (entry.lower > limit + length || std::ranges::find(done, entry.id) != done.end()) continue;
    const SeenBody seen = bodies_.seen_from(entry.id.index, from);
    entry.raise(from, this->ask(entry.slot, entry.id.index, seen, session, ask), bodies_);
  }
}

template <BodyDetector D>
template <class LeftOut, class Ask>
void Scene<D>::ask_unlisted(const Vec3& from, const Vec3& to, double length, const double& limit,
                            Session& session, const LeftOut& is_left_out, const Ask& ask) const noexcept {
  auto visit = [&](std::uint32_t body) {
    if (session.work.undecided) return unknown;  // which ends it
    if (is_left_out(body)) return limit;
    ++session.work.bodies;
    const PlacedBody& placed = bodies_[body];
    const SeenBody seen = bodies_.seen_from(body, from);
    if (lower_distance(bodies_.bounds_of(placed), seen) <= limit + length)
      this->ask(NearBodies::room + placed.shape % NearBodies::unlisted_room, body, seen, session, ask);
    return limit;
  };
  if (&from == &to) {
    session.work.boxes += bodies_.tree().for_each_within(from, limit, visit);
    return;
  }
  Aabb region;
  region.extend(from);
  region.extend(to);
  session.work.boxes += bodies_.tree().for_each_within(region, limit, visit);
}

template <BodyDetector D>
template <class Ask>
void Scene<D>::ask_near(const Vec3& from, const Vec3& to, const double& limit, bool was_compared,
                        Session& session, const Ask& ask) const noexcept {
  NearBodies& near = session.near;
  const double length = &from == &to ? 0 : path_length(from, to);  // a probe's way is one point
  // 1. Free space: every body is surely farther.
  if (!was_compared && near.all_are_beyond(from, limit + length, bodies_)) return;
  // 2. Jumps: all that can be within reach, of which nothing is remembered.
  if (!near.pays_to_list(from)) {
    ask_unlisted(
        from, to, length, limit, session, [](std::uint32_t) { return false; }, ask);
    return;
  }
  // 3. The nearest few as they were last listed.
  std::array<BodyId, NearBodies::room> done;
  std::size_t done_count = 0;
  session.work.bodies += near.look_again(from, limit + length, bodies_);
  ask_listed(from, length, limit, session, {}, ask);
  // 4. The nearest few of now, where others may have come as near.
  if (limit >= 0 && !near.others_are_beyond(from, limit + length, bodies_)) {
    for (const NearBodies::Entry& entry : near.near())
      if (entry.lower <= limit + length) done[done_count++] = entry.id;
    const NearBodies::Looked looked = near.list(from, limit + length, bodies_);
    session.work.bodies += looked.bodies;
    session.work.boxes += looked.boxes;
    ask_listed(from, length, limit, session, std::span(done).first(done_count), ask);
    near.learn_gap(std::max(limit, 0.0) + length);
  }
  // 5. All, where those are not all that are near.
  if (limit >= 0 && !near.others_are_beyond(from, limit + length, bodies_))
    ask_unlisted(
        from, to, length, limit, session,
        [&](std::uint32_t body) { return near.slot_of(bodies_.id(body)) < NearBodies::room; }, ask);
  near.conclude(from, bodies_);
}

template <BodyDetector D>
template <class Ask>
double Scene<D>::with_query(const Shape<D>& shape, std::uint32_t body, const SeenBody& seen,
                            typename D::Session& own, const Ask& ask) const noexcept {
  if (shape.is_round()) return ask(RoundBody(shape, bodies_[body], body, seen.point()));
  return ask(BodyQuery<D>(shape, seen, body, own));
}

template <BodyDetector D>
bool Scene<D>::touches(const Probe& probe, Session& session) const noexcept {
  if (!(probe.radius >= 0) || !probe.center.allFinite()) return false;
  const NearSurface::Found answer = ask_surface(
      probe.center, {LastQuestion::Query::touches, probe.radius}, session, [&](NearSurface& surface) {
        return surface.touches(probe.center, probe.radius, bodies_, session.work);
      });
  if (answer != NearSurface::Found::unknown) return answer == NearSurface::Found::contact;
  bool touching = false;
  double limit = probe.radius;
  ask_near(probe.center, probe.center, limit, ListsTriangles<D>, session,
           [&](const Shape<D>& shape, std::uint32_t body, const SeenBody& seen, typename D::Session& own) {
             const auto found = [&](const auto& query) {
               if (touching || !query.touches(probe.radius, session.work)) return query.clearance();
               touching = true;
               limit = -std::numeric_limits<double>::infinity();
               return unknown;
             };
             return with_query(shape, body, seen, own, found);
           });
  session.surface.remember(probe.center, probe.radius, bodies_);
  return touching || session.work.undecided;
}

template <BodyDetector D>
std::optional<BodyContact> Scene<D>::nearest_body(const Probe& probe, double reach,
                                                  Session& session) const noexcept {
  if (!(reach >= 0) || !probe.center.allFinite()) return std::nullopt;
  BodyContact listed;
  const NearSurface::Found answer =
      ask_surface(probe.center, {LastQuestion::Query::nearest, reach}, session, [&](NearSurface& surface) {
        return surface.nearest(probe.center, reach, bodies_, listed, session.work);
      });
  if (answer != NearSurface::Found::unknown)
    return answer == NearSurface::Found::contact ? std::optional(listed) : std::nullopt;
  NearestImage nearest(probe.center);
  double limit = reach;
  // Somewhat farther, so that a body need not be asked again while the point stays about there.
  constexpr double ahead = 0.1;
  ask_near(probe.center, probe.center, limit, ListsTriangles<D>, session,
           [&](const Shape<D>& shape, std::uint32_t body, const SeenBody& seen, typename D::Session& own) {
             return with_query(shape, body, seen, own, [&](const auto& query) {
               query.nearest(nearest, limit, session.near.is_jumping() ? 0 : ahead, session.work);
               limit = std::min(limit, nearest.upper());
               return query.clearance();
             });
           });
  const std::optional<Contact> contact = nearest.contact(reach, session.work.exact_decisions);
  session.surface.remember(probe.center, contact ? contact->distance : reach, bodies_);
  if (!contact) return std::nullopt;
  return BodyContact{bodies_.id(nearest.best()->body), *contact};
}

template <BodyDetector D>
template <class LeftOut>
typename Scene<D>::FirstImpact Scene<D>::first_of_standing(const Sweep& sweep, const LeftOut& is_left_out,
                                                           Session& session) const noexcept requires
    AnswersSweep<D> {
  FirstImpact first;
  const double limit = sweep.radius;
  session.last = {
      {LastQuestion::Query::sweep, limit}, sweep.to, sweep.to - sweep.from, SceneState::of(bodies_)};
  ask_near(
      sweep.from, sweep.to, limit, true, session,
      [&](const Shape<D>& shape, std::uint32_t body, const SeenBody& /*seen*/, typename D::Session& own) {
        if (is_left_out(body)) return unknown;
        const std::optional<Impact> hit =
            shape.is_round()
                ? RoundBody(shape, bodies_[body], body, sweep.from).first_hit(sweep, session.work)
                : BodySweep<D>(shape, bodies_[body], body, sweep, own).first_hit(session.work);
        if (hit) first.take(*hit, body);
        return unknown;
      });
  return first;
}

template <BodyDetector D>
std::optional<BodyImpact> Scene<D>::first_hit_body(const Sweep& sweep,
                                                   Session& session) const noexcept requires AnswersSweep<D> {
  if (!(sweep.radius >= 0) || !sweep.from.allFinite() || !sweep.to.allFinite()) return std::nullopt;
  if (is_clear_of_all(sweep, session)) return std::nullopt;
  auto [first, whose] = first_of_standing(
      sweep, [](std::uint32_t) { return false; }, session);
  if (session.work.undecided) return BodyImpact();
  if (!first) return std::nullopt;
  if (first->fraction == 0) {
    if (const auto start = nearest_body({sweep.from, sweep.radius}, sweep.radius, session))
      return BodyImpact{start->body, {0, start->contact}};
    if (session.work.undecided) return BodyImpact();
    first->fraction = std::numeric_limits<double>::denorm_min();
  }
  return BodyImpact{bodies_.id(whose), *first};
}

/// Keeps the first of all that are shown, and sorts them at the end. What is equal in every number may be
/// either.
template <class Answer>
class FirstOfContacts {
 public:
  explicit FirstOfContacts(std::span<Answer> into) noexcept : into_(into) {}

  void add(const Answer& answer) noexcept {
    if (count_ < into_.size()) {
      into_[count_] = answer;
    } else if (!into_.empty()) {
      const auto last = std::ranges::max_element(into_, is_before);
      if (is_before(answer, *last)) *last = answer;
    }
    ++count_;
  }
  std::size_t finish() noexcept {
    std::ranges::sort(into_.first(std::min(count_, into_.size())), is_before);
    return count_;
  }

 private:
  static auto key(const Contact& c) noexcept {
    return std::tuple(c.distance, std::uint32_t{0}, c.triangle, c.point.x(), c.point.y(), c.point.z());
  }
  static auto key(const BodyContact& b) noexcept {
    const Contact& c = b.contact;
    return std::tuple(c.distance, b.body.index, c.triangle, c.point.x(), c.point.y(), c.point.z());
  }
  static bool is_before(const Answer& a, const Answer& b) noexcept { return key(a) < key(b); }

  std::span<Answer> into_;
  std::size_t count_ = 0;
};

template <BodyDetector D>
template <class Found>
void Scene<D>::for_each_contact(const Probe& probe, double reach, Session& session,
                                const Found& found) const noexcept {
  if (!(reach >= 0) || !probe.center.allFinite()) return;
  if (session.near.all_are_beyond(probe.center, reach, bodies_)) return;
  session.last.note({LastQuestion::Query::contacts, reach}, probe.center, bodies_);
  ask_near(probe.center, probe.center, reach, true, session,
           [&](const Shape<D>& shape, std::uint32_t body, const SeenBody& seen, typename D::Session& own) {
             return with_query(shape, body, seen, own, [&](const auto& query) {
               query.for_each_within(reach, [&](const ImageCandidate& candidate) {
                 if (is_within(candidate, probe.center, reach, session.work.exact_decisions))
                   found(body, contact_on_image(candidate, probe.center, session.work.exact_decisions));
                 return session.work.exceeds_limit();
               });
               return unknown;
             });
           });
}

template <BodyDetector D>
std::size_t Scene<D>::contacts_of_bodies(const Probe& probe, double reach, Session& session,
                                         std::span<BodyContact> into) const noexcept {
  FirstOfContacts<BodyContact> first(into);
  for_each_contact(probe, reach, session, [&](std::uint32_t body, const Contact& contact) {
    first.add({bodies_.id(body), contact});
  });
  return first.finish();
}

template <BodyDetector D>
std::size_t Scene<D>::contacts(const Probe& probe, double reach, Session& session,
                               std::span<Contact> into) const noexcept {
  FirstOfContacts<Contact> first(into);
  for_each_contact(probe, reach, session, [&](std::uint32_t, const Contact& contact) { first.add(contact); });
  return first.finish();
}

template <BodyDetector D>
void Scene<D>::prepare(Session& session) const noexcept requires Prepares<D> {
  // In free space a query is one comparison, and what it reads is small; but who publishes a frame leaves it
  // and its code outside the caches. To ask again brings them back.
  const Vec3 center = session.near.center_of_all();
  const SceneQuestion last = session.last;
  const bool is_known = last.question.query != LastQuestion::Query::none;
  if (session.near.all_are_beyond(is_known ? last.point : center, last.question.reach, bodies_)) {
    touches({center, 0}, session);
    nearest_body({center, 0}, 0, session);
    if constexpr (AnswersSweep<D>) first_hit_body({center, center, 0}, session);
    return;
  }
  if (ask_again(session)) return;
  for (const NearBodies::Entry& entry : session.near.near().first(session.near.near().empty() ? 0 : 1)) {
    auto& asked = session.asked[entry.slot];
    const Shape<D>* shape =
        bodies_.has(entry.id) && asked.epoch == bodies_.epoch() ? shapes_.built(asked.shape) : nullptr;
    if (shape == nullptr || shape->is_round() || asked.shape != bodies_[entry.id.index].shape) return;
    shape->detector->prepare(asked.session);
    session.take_work(asked.session);
  }
}

template <BodyDetector D>
bool Scene<D>::build_near(const Probe& probe, double distance, Session& session) const {
  const double reach = probe.radius + distance;
  if (!(reach >= 0) || !probe.center.allFinite()) return false;
  double limit = reach;
  std::uint32_t found = PlacedBody::no_shape;
  session.work.boxes += bodies_.tree().for_each_within(probe.center, limit, [&](std::uint32_t body) {
    const std::uint32_t shape = bodies_[body].shape;
    ++session.work.bodies;
    if (shapes_.built(shape) != nullptr || shapes_.has_failed(shape)) return limit;
    const double lower = lower_distance(bodies_, body, probe.center);
    if (lower <= limit) {
      limit = lower;
      found = shape;
    }
    return limit;
  });
  if (found == PlacedBody::no_shape) return false;
  shapes_.make(found);
  return true;
}

}  // namespace touchmark
