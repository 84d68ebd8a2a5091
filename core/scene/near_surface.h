/// The triangles of standing bodies around a haptic point, as the scene has them: what a query of a scene
/// that stands looks at is then these, and no body. docs/exactness.md, E32.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>

#include "core/detector.h"
#include "core/geometry/point_triangle.h"
#include "core/probe.h"
#include "core/scene/body.h"
#include "core/scene/nearest_image.h"
#include "core/scene/scene_bodies.h"
#include "core/scene/seen_body.h"
#include "core/search/around.h"
#include "core/search/memory/backoff.h"
#include "core/search/memory/epoch.h"
#include "core/search/memory/last_question.h"
#include "core/triangle_mesh.h"

namespace touchmark {

/// A scene between two of its changes.
struct SceneState {
  Epoch epoch;
  std::uint64_t moves = 0, additions = 0, removals = 0;

  static SceneState of(const SceneBodies& bodies) noexcept {
    return {bodies.epoch(), bodies.moves(), bodies.additions(), bodies.removals()};
  }
  friend bool operator==(const SceneState&, const SceneState&) = default;
};

/// What was asked last where a body may be near, and where. A sweep ends at the point.
struct SceneQuestion {
  LastQuestion question;
  Vec3 point = Vec3::Zero(), way = Vec3::Zero();  ///< the way leads from the place before to the point
  SceneState scene;

  void note(const LastQuestion& asked, const Vec3& now, const SceneBodies& bodies) noexcept {
    using enum LastQuestion::Query;
    // Contacts are asked for where a sweep has ended, or was stopped.
    const bool goes_on = asked.query == contacts && question.query == sweep;
    if (!goes_on) way = question.query == none ? Vec3(Vec3::Zero()) : Vec3(now - point);
    question = asked;
    point = now;
    scene = SceneState::of(bodies);
  }
};

/// Triangles around a place, each behind a plane that bounds its distance all around.
class SurfaceList {
 public:
  static constexpr std::uint32_t capacity = ListedTriangles::capacity;
  static constexpr std::size_t max_bodies = 16;
  using Bits = std::array<std::uint64_t, capacity / 64>;

  /// From the place to a point.
  struct Move {
    Vec3 way;
    double length;
    float x, y, z;
  };
  struct Body {
    std::uint32_t index = 0;
    const TriangleMesh* mesh = nullptr;
    Vec3 center = Vec3::Zero();  ///< the place in the body's frame
  };

  /// Lists nothing yet, about this place, and is to be complete up to `covered` from there.
  void start(const Vec3& center, double covered) noexcept;
  /// Adds what a body's detector listed about the place in its frame. Returns false where there is no room,
  /// or where numbers leave the range of single precision.
  bool add(std::uint32_t body, const SeenBody& seen, const TriangleMesh& mesh,
           const ListedTriangles& listed) noexcept;
  /// Triangles no nearer than this are not listed.
  void leave_out(double lower) noexcept;

  std::uint32_t count() const noexcept { return count_; }
  const Body& body_of(std::uint32_t place) const noexcept { return bodies_[body_[place]]; }
  std::uint32_t triangle(std::uint32_t place) const noexcept { return triangle_[place]->index; }
  double covered() const noexcept { return covered_; }
  /// Bounds what a measured distance may be off by.
  double error() const noexcept { return error_; }

  Move move_to(const Vec3& point) const noexcept;
  /// Is everything within the limit of there listed?
  bool covers(double limit, const Move& move) const noexcept;
  /// Returns those that may be within the limit.
  Bits within(const Move& move, double limit) const noexcept;
  bool may_be_within(std::uint32_t place, const Move& move, double limit) const noexcept;
  /// Nothing is nearer than this, listed or not.
  double clearance(const Move& move) const noexcept;
  /// A point in the frames of bodies, of those that it was asked for.
  class InFrames {
   public:
    InFrames(const Vec3& point, const SceneBodies& bodies) noexcept : point_(point), bodies_(bodies) {}
    const Vec3& of(std::uint8_t slot, const Body& body) noexcept;
    const Pose& pose(const Body& body) const noexcept { return bodies_[body.index].pose; }
    const Vec3& point() const noexcept { return point_; }

   private:
    const Vec3& point_;
    const SceneBodies& bodies_;
    std::uint32_t known_ = 0;
    std::array<Vec3, max_bodies> seen_;
  };
  /// Measures one; where it is farther than the limit its plane is turned towards the point.
  double measure(std::uint32_t place, double limit, InFrames& point) noexcept;
  /// Returns the images of the corners of this one's body as seen from the point.
  SeenCorners corners(std::uint32_t place, InFrames& point) const noexcept {
    const Body& body = body_of(place);
    return {point.pose(body), point.of(body_[place], body), point.point()};
  }

 private:
  float padded(double limit, const Move& move) const noexcept;
  Bits within_by_eights(const Move& move, float farthest) const noexcept;
  void turn(std::uint32_t place, const Pose& pose) noexcept;

  Vec3 center_ = Vec3::Zero();
  double covered_ = -1;
  double error_ = 0, plane_error_ = 0;
  std::uint32_t count_ = 0;
  std::size_t bodies_count_ = 0;
  std::array<Body, max_bodies> bodies_;
  std::array<std::uint8_t, capacity> body_;
  std::array<const PreparedTriangle*, capacity> triangle_;
  struct Planes {
    alignas(16) std::array<float, capacity> bound, x, y, z;
  } plane_;
};

/// Forgetting it changes the cost of the next answer, never the answer.
class NearSurface {
 public:
  enum class Found {
    unknown,  ///< the list cannot tell
    nothing,
    contact
  };
  Found nearest(const Vec3& point, double reach, const SceneBodies& bodies, BodyContact& contact,
                Work& work) noexcept;
  /// Found::contact says that a body is within the radius.
  Found touches(const Vec3& point, double radius, const SceneBodies& bodies, Work& work) noexcept;
  /// Nothing is nearer than this to the point of the last query, which found nothing.
  double clearance() const noexcept { return clearance_; }

  /// Notes how far the nearest was in an answer that the list did not give; the reach where nothing was.
  void remember(const Vec3& point, double distance, const SceneBodies& bodies) noexcept;
  /// Begins a list for the queries to come where that may pay. Returns how far it is to be complete.
  std::optional<double> start(const Vec3& point, double reach, const SceneBodies& bodies) noexcept;
  /// May the list still serve the query that it is made for?
  bool is_complete() const noexcept { return list_.covered() > needed_; }
  void finish(const SceneBodies& bodies) noexcept;
  const Vec3& center() const noexcept { return center_; }
  SurfaceList& list() noexcept { return list_; }

 private:
  struct Measured {
    std::uint32_t place;
    double distance;
  };
  bool is_about(const SceneBodies& bodies) const noexcept { return listed_ == SceneState::of(bodies); }
  Found nothing(const SurfaceList::Move& move) noexcept;
  /// Leaves the first ones, no farther than the limit, and returns them.
  std::span<Measured> closest(double limit) noexcept;
  ImageCandidate candidate(const Measured& measured, const SeenCorners& corners,
                           const Pose& pose) const noexcept;
  bool touches_exactly(std::span<const Measured> close, SurfaceList::InFrames& point, double radius,
                       Work& work) const noexcept;
  std::optional<BodyContact> contact_of(std::span<const Measured> close, SurfaceList::InFrames& point,
                                        double reach, const SceneBodies& bodies, Work& work) const noexcept;

  SurfaceList list_;
  SceneState listed_;      ///< when the list was made
  SceneState remembered_;  ///< when `upper_` was found
  Vec3 center_ = Vec3::Zero(), point_ = Vec3::Zero();
  double upper_ = 0;  ///< distance of the nearest from `point_`, where the scene still is as remembered
  double clearance_ = 0, needed_ = 0;
  double steps_ahead_ = 16;  ///< how far beyond what is asked to list
  std::uint32_t last_ = 0, served_ = 0;
  Backoff<std::uint32_t, 255> backoff_;  ///< lists wait after one that did not serve
  std::uint32_t measured_count_ = 0;
  std::array<Measured, SurfaceList::capacity> measured_;
};

}  // namespace touchmark
