/// Scenes of bodies as detectors, so that they are replayed, timed and judged as those of one mesh are.
#pragma once

#include <algorithm>
#include <cassert>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "bench/contestants/entry.h"
#include "bench/scenes/schedule.h"
#include "core/scene/body.h"
#include "core/scene/moving/moving_body.h"

namespace touchmark::bench::contestants {

/// What the player plays: a scene whose bodies are numbered as the given one's, from 0. `place` puts a body
/// elsewhere; queries answer as core/scene/scene.h says. One that has `publish()` is told so when all bodies
/// of a step are placed, before it is asked.
template <class S>
concept PlayableScene = std::movable<S> &&
    requires(S& scene, const S& asked, std::uint32_t body, const Pose& pose, const Probe& probe, double reach,
             typename S::Session& session) {
  requires std::default_initializable<typename S::Session>;
  { session.work } -> std::convertible_to<Work&>;
  { scene.place(body, pose) } -> std::same_as<void>;
  { asked.nearest_body(probe, reach, session) } -> std::same_as<std::optional<BodyContact>>;
  { asked.bytes() } -> std::same_as<std::size_t>;
  { asked.accuracy() } -> std::same_as<Accuracy>;
};

template <class S>
concept SweepsScene = PlayableScene<S> &&
    requires(const S& scene, const Sweep& sweep, typename S::Session& session) {
  { scene.first_hit_body(sweep, session) } -> std::same_as<std::optional<BodyImpact>>;
};

/// One that answers among bodies that move: `moving` is a body's way to a pose.
template <class S>
concept SweepsMovingScene = SweepsScene<S> && requires(const S& scene, std::uint32_t body, const Pose& pose) {
  { scene.moving(body, pose) } -> std::same_as<MovingBody>;
};

template <class S>
concept GuidesProxyInScene = SweepsScene<S> &&
    requires(const S& scene, const Probe& probe, double reach, typename S::Session& session,
             std::span<Contact> into) {
  { scene.touches(probe, session) }
  noexcept->std::same_as<bool>;
  { scene.contacts(probe, reach, session, into) }
  noexcept->std::same_as<std::size_t>;
};

template <class S>
concept PreparesScene = PlayableScene<S> && requires(const S& scene, typename S::Session& session) {
  { scene.prepare(session) }
  noexcept->std::same_as<void>;
};

template <PlayableScene S>
class ScenePlayer {
 public:
  struct Options {
    std::function<S(const scenes::PlacedScene&)> make;
  };
  struct Session : S::Session {
    std::uint32_t body = 0;  ///< the one that the last contact is on
  };

  ScenePlayer(const scenes::PlacedScene& placed, const Options& options) : scene_(options.make(placed)) {
    for (const scenes::PlacedScene::PlacedBody& body : placed.bodies) starts_.push_back(body.start);
  }
  /// Builds a scene of one body, which is the mesh where it stands.
  static ScenePlayer build(const TriangleMesh& mesh, const Options& options) {
    return {{{std::make_shared<const TriangleMesh>(mesh)}, {{0, Pose()}}}, options};
  }

  /// Returns true if bodies were moved.
  bool stand_at(const scenes::ScheduleView* schedule, std::size_t step) {
    bool moved = false;
    moved_in_ = nullptr;
    const auto place = [&](std::uint32_t body, const Pose& pose) {
      scene_.place(body, pose);
      moved = true;
    };
    follower_.stand_at(schedule, step, place, [&](std::uint32_t body) { return starts_[body]; });
    if constexpr (requires { scene_.publish(); })
      if (moved) scene_.publish();
    return moved;
  }

  /// As stand_at, and remembers how bodies came there from the step before.
  bool move_to(const scenes::ScheduleView* schedule, std::size_t step) requires SweepsMovingScene<S> {
    if (schedule == moved_in_ && step == moved_to_) return false;
    const bool moved = stand_at(schedule, step > 0 ? step - 1 : 0);
    moving_.clear();
    follower_.stand_at(
        schedule, step,
        [&](std::uint32_t body, const Pose& pose) {
          moving_.push_back(scene_.moving(body, pose));
          scene_.place(body, pose);
        },
        [&](std::uint32_t body) { return starts_[body]; });
    moved_in_ = schedule;
    moved_to_ = step;
    return moved || !moving_.empty();
  }

  /// The contact that decides is told, too: the body of a touch is the nearest one.
  bool touches(const Probe& probe, Session& session) const noexcept {
    return nearest(probe, probe.radius, session).has_value();
  }
  /// As a proxy asks: the body is not told.
  bool touches_some(const Probe& probe, Session& session) const noexcept requires GuidesProxyInScene<S> {
    return scene_.touches(probe, session);
  }
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept {
    const std::optional<BodyContact> found = scene_.nearest_body(probe, reach, session);
    if (!found) return std::nullopt;
    session.body = found->body.index;
    return found->contact;
  }
  std::optional<Impact> first_hit(const Sweep& sweep,
                                  Session& session) const noexcept requires SweepsScene<S> {
    const std::optional<BodyImpact> found = scene_.first_hit_body(sweep, session);
    if (!found) return std::nullopt;
    session.body = found->body.index;
    return found->impact;
  }

  std::optional<Impact> first_hit_moving(const Sweep& sweep,
                                         Session& session) const noexcept requires SweepsMovingScene<S> {
    const std::optional<BodyImpact> found = scene_.first_hit_moving(sweep, moving_, session);
    if (!found) return std::nullopt;
    session.body = found->body.index;
    return found->impact;
  }

  std::size_t contacts(const Probe& probe, double reach, Session& session,
                       std::span<Contact> into) const noexcept requires GuidesProxyInScene<S> {
    return scene_.contacts(probe, reach, session, into);
  }

  void prepare(Session& session) const noexcept requires PreparesScene<S> { scene_.prepare(session); }

  std::size_t bytes() const noexcept { return scene_.bytes(); }
  Accuracy accuracy() const noexcept { return scene_.accuracy(); }

 private:
  S scene_;
  std::vector<Pose> starts_;
  scenes::ScheduleFollower follower_;
  std::vector<MovingBody> moving_;  ///< from the step before `moved_to_`
  const scenes::ScheduleView* moved_in_ = nullptr;
  std::size_t moved_to_ = 0;
};

/// Throws std::invalid_argument for options that are of one mesh.
inline void expect_options_of_scenes(const OptionValues& values) {
  if (asks_for_side(values)) throw std::invalid_argument("a scene of bodies tells no side");
  if (is_updated(values))
    throw std::invalid_argument("updated=true is of one mesh, not of a scene of bodies");
  const auto prepare = values.all().find("prepare");
  if (prepare != values.all().end() && prepare->second == "true")
    throw std::invalid_argument("prepare=true is of one mesh, not of a scene of bodies");
}

/// Throws std::invalid_argument for a scene with round bodies, of which a contestant does not know.
inline void expect_triangles(const scenes::PlacedScene& placed) {
  if (!placed.radii.empty())
    throw std::invalid_argument("it takes triangles alone, and the scene has spheres or capsules");
}

/// `make(placed)` returns the scene that is played.
template <class Make>
std::unique_ptr<Contestant> scene_contestant(const scenes::PlacedScene& placed, const Make& make) {
  using Player = ScenePlayer<decltype(make(placed))>;
  return std::make_unique<ContestantOf<Player>>(Player(placed, {make}));
}

/// Makes each shape's options of its mesh and of what was chosen.
template <class D>
using OptionsOf = std::function<typename D::Options(const TriangleMesh&, const OptionValues&)>;

}  // namespace touchmark::bench::contestants
