/// Many bodies that move, asked as one: each a shape in a pose. docs/library-scenes.md describes it.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <limits>
#include <optional>
#include <span>
#include <utility>

#include "core/detector.h"
#include "core/scene/body.h"
#include "core/scene/body_query.h"
#include "core/scene/body_sweep.h"
#include "core/scene/moving/moving_body.h"
#include "core/scene/near_bodies.h"
#include "core/scene/near_surface.h"
#include "core/scene/pose.h"
#include "core/scene/round/round_body.h"
#include "core/scene/scene_bodies.h"
#include "core/scene/shape.h"
#include "core/scene/shape_table.h"

namespace touchmark {

/// A detector that can be the shape of a body.
template <class D>
concept BodyDetector = AnswersNearest<D> && AnswersContacts<D>;

template <BodyDetector D>
class SharedScene;

/// What the answers of a scene keep to: the bound of a distance, exact decisions and names.
inline constexpr Accuracy posed_certified = {
    Guarantee::exact, 32 * (std::numeric_limits<double>::epsilon() / 2), 0, true, true};

/// A scene of bodies whose shapes are exact detectors D; satisfies Detector and every query.
///
/// Contact, the nearest body and its nearest triangle are decided for the exact images of the stored
/// triangles under the stored poses. Shapes and bodies are added, moved and removed between queries, never
/// meanwhile: shared_scene.h is for threads.
template <BodyDetector D>
class Scene {
 public:
  using Options = typename D::Options;
  static constexpr bool keeps_to_limit = KeepsToLimit<D>;
  /// What one haptic point remembers between ticks.
  struct Session {
    using Moving = MovingBody;  ///< what first_hit_moving is told of a body
    LimitedWork work;
    NearBodies near;
    NearSurface surface;
    SceneQuestion last;
    /// What is remembered of one body: its shape, and the session that asks it.
    struct Asked {
      Epoch epoch;
      std::uint32_t shape = PlacedBody::no_shape;
      typename D::Session session;
    };
    std::array<Asked, NearBodies::room + NearBodies::unlisted_room>
        asked;  ///< by slot; the last for what is not listed
    /// Adds what a body's session has counted, and clears that.
    void take_work(typename D::Session& own) noexcept {
      if constexpr (keeps_to_limit)
        work.take(own.work);
      else
        work += own.work;
      own.work = {};
    }
  };

  Scene() = default;
  Scene(Scene&&) noexcept = default;
  Scene& operator=(Scene&&) noexcept = default;
  Scene& operator=(const Scene&) = delete;
  ~Scene() = default;

  /// A scene of one body, which stands where the mesh is.
  static Scene build(const TriangleMesh& mesh, const Options& options) {
    Scene scene;
    scene.add(scene.add_shape(Shape<D>::build(mesh, options)), Pose());
    return scene;
  }
  static Scene build(const TriangleMesh& mesh) { return build(mesh, Options()); }

  /// Any number of bodies may have it. Throws SceneError for a shape that lacks its detector or its mesh, or
  /// whose detector is not exact, and for a round one whose radius is not positive and finite.
  ShapeId add_shape(Shape<D> shape) {
    const Aabb bounds = shape.mesh ? shape.bounds() : Aabb();
    shape = ShapeTable<D>::checked(std::move(shape), bounds);
    const double beyond = shape.radius * (1 + 2 * max_rigid_error);
    const ShapeId id = bodies_.add_shape(bounds, shape.mesh->vertices(), beyond);
    shapes_.add(std::move(shape));
    return id;
  }
  /// The shape is made when it is first needed: see build_near. Throws SceneError for bounds that are empty
  /// or not finite.
  ShapeId add_shape(ShapeSource<D> source) {
    const ShapeId id = bodies_.add_shape(source.bounds);
    shapes_.add(std::move(source));
    return id;
  }
  /// Throws PoseError for a pose that is not rigid, SceneError for a shape that does not exist.
  BodyId add(ShapeId shape, const Pose& pose) { return bodies_.add(shape, pose); }
  /// Throws PoseError, and SceneError for a body that does not exist.
  void move(BodyId id, const Pose& pose) { bodies_.move(id, pose); }
  /// Throws SceneError.
  void remove(BodyId id) { bodies_.remove(id); }
  /// Takes the memory for so many bodies ahead.
  void reserve(std::size_t bodies) { bodies_.reserve(bodies); }

  /// Is it a body of the scene, and not removed?
  bool has(BodyId id) const noexcept { return bodies_.has(id); }
  /// Throws SceneError.
  const Pose& pose(BodyId id) const { return bodies_.expect(id).pose; }
  /// Returns how many bodies there are.
  std::size_t size() const noexcept { return bodies_.size(); }
  /// Returns the largest coordinate of all shapes, each in its own frame: numbers that rounding depends on.
  friend double largest_of_shapes(const Scene& scene) noexcept { return scene.bodies_.largest_of_shapes(); }
  /// Returns how many shapes are built.
  std::size_t shapes_built() const noexcept { return shapes_.count_built(); }

  /// Makes at most one shape: of the bodies within `distance` of the probe's surface, by their bounds, the
  /// nearest one whose shape is not built. Returns whether it made one. A query that needs a shape makes it,
  /// which takes its time and memory; who calls this between ticks, with a distance that no probe goes in a
  /// few of them, never has that happen. Throws what a source throws.
  bool build_near(const Probe& probe, double distance, Session& session) const;
  /// What a source threw when a query needed its shape, or null. Such bodies are left out of answers.
  std::exception_ptr failure() const noexcept { return shapes_.failure(); }

  /// Is a body at most probe.radius away?
  bool touches(const Probe& probe, Session& session) const noexcept;
  /// See nearest_body.
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept {
    const std::optional<BodyContact> found = nearest_body(probe, reach, session);
    return found ? std::optional(found->contact) : std::nullopt;
  }
  /// See first_hit_body.
  std::optional<Impact> first_hit(const Sweep& sweep,
                                  Session& session) const noexcept requires AnswersSweep<D> {
    const std::optional<BodyImpact> found = first_hit_body(sweep, session);
    return found ? std::optional(found->impact) : std::nullopt;
  }

  /// The contact of the nearest triangle of all bodies, or nothing beyond the reach; of several at the same
  /// distance the lowest body's lowest triangle.
  std::optional<BodyContact> nearest_body(const Probe& probe, double reach, Session& session) const noexcept;
  /// The first touch of the probe on its way, the bodies standing where they are; of several at once the
  /// lowest body's.
  std::optional<BodyImpact> first_hit_body(const Sweep& sweep,
                                           Session& session) const noexcept requires AnswersSweep<D>;
  /// The first touch on a way that takes `part` of a tick in which these bodies move, wherever the scene has
  /// them, and all others stand. Never late; early by a bound of the distance there (E33), and 0 where the
  /// probe may touch at the start. `left_out`, one of them, is not looked at.
  std::optional<BodyImpact> first_hit_moving(const Sweep& sweep, std::span<const MovingBody> moving,
                                             Session& session, const TickPart& part = TickPart(),
                                             const MovingBody* left_out = nullptr) const noexcept requires
      AnswersSweep<D>;

  /// One contact for each triangle of a body whose distance is at most the reach, which is decided exactly;
  /// by the distances told, then the lowest body, then the lowest triangle. Writes the first of them into
  /// `into` and returns how many there are.
  std::size_t contacts_of_bodies(const Probe& probe, double reach, Session& session,
                                 std::span<BodyContact> into) const noexcept;
  /// As contacts_of_bodies, without the bodies; of several as far the lowest triangle.
  std::size_t contacts(const Probe& probe, double reach, Session& session,
                       std::span<Contact> into) const noexcept;

  /// Asks the last query again if bodies have moved since, and once more where the probe may be next: the
  /// next query then finds what the move made stale, and the caches as they were before it. Otherwise
  /// prepares what was asked last of the nearest body. Who moves many bodies in a tick's thread calls it
  /// after that.
  void prepare(Session& session) const noexcept requires Prepares<D>;

  std::size_t bytes() const noexcept { return bodies_.bytes() + shapes_.bytes(); }
  /// Returns what the shapes take that are built.
  std::size_t bytes_of_shapes() const noexcept { return shapes_.bytes(); }
  /// Returns what the bodies take beside their shapes.
  std::size_t bytes_of_bodies() const noexcept { return bodies_.bytes(); }
  /// Returns what a session takes, all of it when it is made.
  static constexpr std::size_t bytes_of_session() noexcept { return sizeof(Session); }
  Accuracy accuracy() const noexcept { return posed_certified; }

 private:
  friend class SharedScene<D>;
  Scene(const Scene&) = default;  // of the same bodies with the same shapes
  /// Becomes as the other is, from which it differs in these bodies and in shapes that were added.
  void follow(const Scene& other, std::span<const std::uint32_t> changed) {
    bodies_.follow(other.bodies_, changed);
    shapes_ = other.shapes_;
  }

  /// The detector's memory for a body of this slot.
  typename D::Session& session_of(std::size_t slot, std::uint32_t body, Session& session) const noexcept {
    auto& asked = session.asked[slot];
    const std::uint32_t shape = bodies_[body].shape;
    if (asked.shape != shape || asked.epoch != bodies_.epoch()) {
      if constexpr (requires { asked.session.forget(); })
        asked.session.forget();
      else
        asked.session = {};
      asked.shape = shape;
      asked.epoch = bodies_.epoch();
    }
    return asked.session;
  }
  static constexpr double unknown = -std::numeric_limits<double>::infinity();
  /// Returns what `ask` does, within what is left of the session's limit: a bound of the body's distance, or
  /// `unknown`.
  template <class Ask>
  double ask(std::size_t slot, std::uint32_t body, const SeenBody& seen, Session& session,
             const Ask& ask) const noexcept {
    const Shape<D>* shape = shapes_.needed(bodies_[body].shape);
    if (shape == nullptr || session.work.exceeds_limit()) return unknown;
    typename D::Session& own = session_of(slot, body, session);
    if constexpr (keeps_to_limit) own.work = session.work.rest();
    const double lower = ask(*shape, body, seen, own);
    session.take_work(own);
    return lower;
  }
  template <class Ask>
  void ask_listed(const Vec3& from, double length, const double& limit, Session& session,
                  std::span<const BodyId> done, const Ask& ask) const noexcept;
  template <class LeftOut, class Ask>
  void ask_unlisted(const Vec3& from, const Vec3& to, double length, const double& limit, Session& session,
                    const LeftOut& is_left_out, const Ask& ask) const noexcept;
  /// Calls ask(shape, body, seen from `from`, detector session) for every body that can be within the limit
  /// of the way from `from` to `to`, which ask may lower. It returns a bound of the body's distance from
  /// `from`, or `unknown`. `was_compared` says that these are not all surely beyond, as ask_surface found.
  template <class Ask>
  void ask_near(const Vec3& from, const Vec3& to, const double& limit, bool was_compared, Session& session,
                const Ask& ask) const noexcept;

  struct FirstImpact {
    std::optional<Impact> impact;
    std::uint32_t body = 0;

    void take(const Impact& hit, std::uint32_t whose) noexcept {
      if (impact && std::pair(hit.fraction, whose) > std::pair(impact->fraction, body)) return;
      impact = hit;
      body = whose;
    }
  };
  /// Returns true if all bodies, standing where they are, are surely beyond what the sweep reaches.
  bool is_clear_of_all(const Sweep& sweep, const Session& session) const noexcept {
    const double reach = sweep.radius + path_length(sweep.from, sweep.to);
    return session.near.all_are_beyond(sweep.from, reach, bodies_);
  }
  /// Returns the first touch with bodies that are not left out, standing where they are.
  template <class LeftOut>
  FirstImpact first_of_standing(const Sweep& sweep, const LeftOut& is_left_out,
                                Session& session) const noexcept requires AnswersSweep<D>;

  /// Lists the triangles of bodies around the point for the queries to come, where that may pay.
  bool list_surface(const Vec3& point, double reach, Session& session) const noexcept;
  /// Returns what `ask` does, which asks the list, that is made anew where it cannot tell.
  template <class Ask>
  NearSurface::Found ask_surface(const Vec3& point, const LastQuestion& question, Session& session,
                                 const Ask& ask) const noexcept;
  /// Asks the last question again if bodies have moved since. Returns false where that is of no use.
  bool ask_again(Session& session) const noexcept;

  /// Returns what ask(query) does, the query being one body's about the point that it is seen from.
  template <class Ask>
  double with_query(const Shape<D>& shape, std::uint32_t body, const SeenBody& seen, typename D::Session& own,
                    const Ask& ask) const noexcept;

  /// Calls found(body, contact) for each triangle within the reach.
  template <class Found>
  void for_each_contact(const Probe& probe, double reach, Session& session,
                        const Found& found) const noexcept;

  SceneBodies bodies_;
  ShapeTable<D> shapes_;
};

}  // namespace touchmark

#include "core/scene/moving/moving_sweep.h"  // IWYU pragma: export
#include "core/scene/scene_queries.h"        // IWYU pragma: export
#include "core/scene/surface_queries.h"      // IWYU pragma: export
