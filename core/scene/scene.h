/// Many bodies that move, asked as one: each a shape in a pose.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "core/detector.h"
#include "core/scene/body.h"
#include "core/scene/pose.h"
#include "core/scene/shape.h"

namespace touchmark {

/// A scene of bodies whose shapes are detectors D; satisfies Detector and the queries that D answers.
/// Bodies are added, moved and removed between queries, never meanwhile.
template <Detector D>
class Scene {
 public:
  using Options = typename D::Options;
  /// What one haptic point remembers between ticks.
  struct Session {
    Work work;
    std::array<typename D::Session, 1> sessions;
  };

  Scene() = default;
  /// A scene of one body, which stands where the mesh is.
  static Scene build(const TriangleMesh& mesh, const Options& options) {
    Scene scene;
    scene.add(scene.add_shape(Shape<D>::build(mesh, options)), Pose());
    return scene;
  }
  static Scene build(const TriangleMesh& mesh) { return build(mesh, Options()); }

  /// Any number of bodies may have it.
  ShapeId add_shape(Shape<D> shape) {
    shapes_.push_back({{}, std::move(shape)});
    return {static_cast<std::uint32_t>(shapes_.size() - 1)};
  }
  /// The shape is made when it is first needed.
  ShapeId add_shape(ShapeSource<D> source) {
    shapes_.push_back({std::move(source), {}});
    return {static_cast<std::uint32_t>(shapes_.size() - 1)};
  }

  /// Throws PoseError for a pose that is not rigid, SceneError for a shape of another scene.
  BodyId add(ShapeId shape, const Pose& pose) {
    if (shape.index >= shapes_.size())
      throw SceneError("there is no shape " + std::to_string(shape.index) + " of " +
                       std::to_string(shapes_.size()));
    expect_rigid(pose);
    std::uint32_t index = 0;
    if (free_.empty()) {
      index = static_cast<std::uint32_t>(bodies_.size());
      bodies_.emplace_back();
    } else {
      index = free_.back();
      free_.pop_back();
    }
    Body& body = bodies_[index];
    body.pose = pose;
    body.shape = shape.index;
    body.exists = true;
    ++count_;
    return {index, body.generation};
  }
  /// Throws PoseError and SceneError.
  void move(BodyId id, const Pose& pose) {
    expect_rigid(pose);
    expect(id).pose = pose;
  }
  /// Throws SceneError.
  void remove(BodyId id) {
    Body& body = expect(id);
    body.exists = false;
    ++body.generation;
    --count_;
    free_.push_back(id.index);
    std::ranges::sort(free_, std::greater<>());
  }
  /// Is it a body of the scene, and not removed?
  bool has(BodyId id) const noexcept {
    return id.index < bodies_.size() && bodies_[id.index].exists &&
           bodies_[id.index].generation == id.generation;
  }
  /// Throws SceneError.
  const Pose& pose(BodyId id) const { return expect(id).pose; }
  std::size_t size() const noexcept { return count_; }

  bool touches(const Probe& probe, Session& session) const noexcept requires AnswersNearest<D> {
    return nearest_body(probe, probe.radius, session).has_value();
  }
  std::optional<Contact> nearest(const Probe& probe, double reach,
                                 Session& session) const noexcept requires AnswersNearest<D> {
    const std::optional<BodyContact> found = nearest_body(probe, reach, session);
    return found ? std::optional(found->contact) : std::nullopt;
  }
  std::optional<Impact> first_hit(const Sweep& sweep,
                                  Session& session) const noexcept requires AnswersSweep<D> {
    const std::optional<BodyImpact> found = first_hit_body(sweep, session);
    return found ? std::optional(found->impact) : std::nullopt;
  }

  /// The contact of the nearest triangle of all bodies: of several as far the lowest body's lowest triangle.
  std::optional<BodyContact> nearest_body(const Probe& probe, double reach,
                                          Session& session) const noexcept requires AnswersNearest<D> {
    std::optional<BodyContact> best;
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
      const Body& body = bodies_[i];
      if (!body.exists) continue;
      typename D::Session fresh;
      const Probe seen{in_frame(body.pose, probe.center), probe.radius};
      std::optional<Contact> found = shape(body).detector->nearest(seen, reach, fresh);
      session.work += fresh.work;
      if (found && (!best || found->distance < best->contact.distance))
        best = {{i, body.generation}, in_scene(body.pose, *found)};
    }
    return best;
  }
  /// The first touch of the probe on its way, the bodies standing as they are.
  std::optional<BodyImpact> first_hit_body(const Sweep& sweep,
                                           Session& session) const noexcept requires AnswersSweep<D> {
    std::optional<BodyImpact> best;
    for (std::uint32_t i = 0; i < bodies_.size(); ++i) {
      const Body& body = bodies_[i];
      if (!body.exists) continue;
      typename D::Session fresh;
      const Sweep seen{in_frame(body.pose, sweep.from), in_frame(body.pose, sweep.to), sweep.radius};
      std::optional<Impact> found = shape(body).detector->first_hit(seen, fresh);
      session.work += fresh.work;
      if (!found || (best && !(found->fraction < best->impact.fraction))) continue;
      best = {{i, body.generation}, {found->fraction, in_scene(body.pose, found->contact)}};
    }
    return best;
  }

  std::size_t bytes() const noexcept {
    std::size_t bytes = bodies_.capacity() * sizeof(Body);
    for (const Made& made : shapes_)
      if (made.shape.detector) bytes += made.shape.detector->bytes();
    return bytes;
  }
  Accuracy accuracy() const noexcept {
    for (const Made& made : shapes_)
      if (made.shape.detector) return made.shape.detector->accuracy();
    return uncertified;
  }

 private:
  struct Body {
    Pose pose;
    std::uint32_t shape = 0;
    std::uint32_t generation = 0;
    bool exists = false;
  };
  struct Made {
    ShapeSource<D> source;
    mutable Shape<D> shape;
  };

  const Body& expect(BodyId id) const {
    if (!has(id))
      throw SceneError("there is no body " + std::to_string(id.index) + " of generation " +
                       std::to_string(id.generation));
    return bodies_[id.index];
  }
  Body& expect(BodyId id) { return const_cast<Body&>(std::as_const(*this).expect(id)); }
  const Shape<D>& shape(const Body& body) const noexcept {
    const Made& made = shapes_[body.shape];
    if (!made.shape.detector) made.shape = made.source.make();
    return made.shape;
  }
  static Contact in_scene(const Pose& pose, Contact contact) noexcept {
    contact.point = image(pose, contact.point);
    contact.normal = (pose.rotation * contact.normal).eval();
    return contact;
  }

  std::vector<Made> shapes_;
  std::vector<Body> bodies_;
  std::vector<std::uint32_t> free_;
  std::size_t count_ = 0;
};

}  // namespace touchmark
