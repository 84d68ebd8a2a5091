/// How a scene's queries use the list of triangles around a point. Included by scene.h.
#pragma once

#include <cstdint>
#include <optional>

#include "core/scene/scene.h"
#include "core/scene/seen_body.h"
#include "core/search/around.h"
#include "core/search/memory/last_question.h"

namespace touchmark {

template <BodyDetector D>
bool Scene<D>::list_surface(const Vec3& point, double reach, Session& session) const noexcept {
  const std::optional<double> radius = session.surface.start(point, reach, bodies_);
  if (!radius) return false;
  const Vec3& center = session.surface.center();
  SurfaceList& list = session.surface.list();
  ListedTriangles listed;
  // What is not built yet, round or too much leaves the list less complete.
  const auto add = [&](std::uint32_t body, double lower) {
    const PlacedBody& placed = bodies_[body];
    const Shape<D>* shape = shapes_.built(placed.shape);
    if (shape == nullptr || shape->is_round()) return list.leave_out(lower);
    const SeenBody seen(placed.pose, double{placed.rigid}, center);
    typename D::Session& own =
        session_of(NearBodies::room + placed.shape % NearBodies::unlisted_room, body, session);
    if constexpr (keeps_to_limit) own.work = session.work.rest();
    if (!shape->detector->list_triangles(seen.center(), seen.reach_in_frame(*radius, 0), own, listed) ||
        !list.add(body, seen, *shape->mesh, listed))
      list.leave_out(lower);
    session.take_work(own);
  };
  session.work.boxes += bodies_.tree().for_each_within(center, *radius, [&](std::uint32_t body) {
    ++session.work.bodies;
    const double lower = lower_distance(bodies_, body, center);
    if (lower <= *radius) add(body, lower);
    if (session.surface.is_complete()) return *radius;
    list.leave_out(0);  // the others, which are not looked at any more
    return -1.0;
  });
  session.surface.finish(bodies_);
  return true;
}

template <BodyDetector D>
template <class Ask>
NearSurface::Found Scene<D>::ask_surface(const Vec3& point, const LastQuestion& question, Session& session,
                                         const Ask& ask) const noexcept {
  using Found = NearSurface::Found;
  if constexpr (ListsTriangles<D>) {
    if (session.near.all_are_beyond(point, question.reach, bodies_)) return Found::nothing;
    session.last.note(question, point, bodies_);
    if (session.near.is_jumping()) return Found::unknown;
    Found answer = ask(session.surface);
    if (answer == Found::unknown && list_surface(point, question.reach, session))
      answer = ask(session.surface);
    if (answer != Found::unknown) session.near.was_at(point);
    if (answer == Found::nothing) session.near.know_clear(point, session.surface.clearance(), bodies_);
    return answer;
  }
  return Found::unknown;
}

template <BodyDetector D>
bool Scene<D>::ask_again(Session& session) const noexcept {
  using Query = LastQuestion::Query;
  const SceneQuestion last = session.last;
  const auto [query, reach] = last.question;
  if (query == Query::none || last.scene == SceneState::of(bodies_) || session.near.is_jumping())
    return false;
  // The first answer bounds the second one's distance, without which no list is made. Where it stands a proxy
  // asks first, by what was asked there last.
  const bool is_proxy = query == Query::sweep || query == Query::contacts;
  const Vec3 ahead = last.point + last.way;
  for (const Vec3& point : {is_proxy ? ahead : last.point, is_proxy ? last.point : ahead}) {
    if (query == Query::nearest)
      nearest_body({point, 0}, reach, session);
    else
      touches({point, reach}, session);  // a proxy, too, after a move
    if (query == Query::contacts)
      for_each_contact({point, 0}, reach, session, [](std::uint32_t, const Contact&) {});
    if constexpr (AnswersSweep<D>)
      if (query == Query::sweep) first_hit_body({point - last.way, point, reach}, session);
  }
  session.last = last;
  session.last.scene = SceneState::of(bodies_);
  return true;
}

}  // namespace touchmark
