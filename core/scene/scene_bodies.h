/// Which bodies a scene has and where they are: what is the same for every kind of shape.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <memory>
#include <span>
#include <vector>

#include "core/aabb.h"
#include "core/scene/body.h"
#include "core/scene/body_tree/body_tree.h"
#include "core/scene/pose.h"
#include "core/scene/pose_change.h"
#include "core/scene/round/support_table.h"
#include "core/scene/seen_body.h"
#include "core/search/memory/epoch.h"
#include "core/simd/dispatch.h"

namespace touchmark {

/// One body of a scene.
struct PlacedBody {
  static constexpr std::uint32_t no_shape = std::numeric_limits<std::uint32_t>::max();

  Pose pose;
  float rigid = 0;                  ///< at least rigid_error(pose.rotation)
  std::uint32_t shape = no_shape;   ///< no_shape: there is no such body
  std::uint32_t generation = 0;     ///< how many bodies had this index before
  std::uint32_t moved_in_span = 0;  ///< the last span of moves in which it was moved: see SceneBodies::motion
  float room = 0;                   ///< it may move so far before it may leave its box in the tree
  std::uint32_t placed = 0;         ///< how often a body of this index was put into the tree
};

class SceneBodies {
 public:
  /// Adds a shape whose mesh is within these bounds. Where its vertices are known, the shape being all that
  /// is within `beyond` of their hull, boxes of its bodies fit more closely. Throws SceneError for bounds
  /// that are empty or not finite.
  ShapeId add_shape(const Aabb& bounds, std::span<const Vec3> vertices = {}, double beyond = 0);
  /// Throws SceneError for a shape that does not exist, PoseError for a pose that is not rigid.
  BodyId add(ShapeId shape, const Pose& pose);
  /// Throws SceneError for a body that does not exist, PoseError.
  void move(BodyId id, const Pose& pose);
  /// Throws SceneError.
  void remove(BodyId id);
  void reserve(std::size_t bodies);
  /// Becomes as the other is, from which it differs in these bodies and in shapes that were added.
  void follow(const SceneBodies& other, std::span<const std::uint32_t> changed);

  bool has(BodyId id) const noexcept;
  /// Throws SceneError.
  const PlacedBody& expect(BodyId id) const;
  const PlacedBody& operator[](std::uint32_t index) const noexcept { return bodies_[index]; }
  BodyId id(std::uint32_t index) const noexcept { return {index, bodies_[index].generation}; }
  /// Returns how the body is seen from a point, which outlives it.
  SeenBody seen_from(std::uint32_t body, const Vec3& point) const noexcept {
    return {bodies_[body].pose, double{bodies_[body].rigid}, point};
  }
  const Aabb& bounds_of(const PlacedBody& body) const noexcept { return shapes_[body.shape].bounds; }
  std::size_t size() const noexcept { return count_; }
  std::size_t shapes() const noexcept { return shapes_.size(); }
  /// Returns the largest coordinate of all shapes, each in its own frame.
  double largest_of_shapes() const noexcept { return largest_of_shapes_; }
  const BodyTree& tree() const noexcept { return tree_; }
  std::size_t bytes() const noexcept;

  /// Grows with the moves, which count together in spans: in a span no body is moved twice, and only its
  /// widest move counts. How far any point of any body has moved since a reading is bounded by this, less
  /// what motion_before_span() was then. Two readings of this alone bound nothing, as a span may go on.
  double motion() const noexcept { return motion_; }
  double motion_before_span() const noexcept { return motion_before_span_; }
  /// Returns how many moves there were.
  std::uint64_t moves() const noexcept { return moves_; }
  /// Lets the moves from now on count as of another span.
  void end_span() noexcept {
    ++span_;
    motion_before_span_ = motion_;
  }
  /// How many bodies were ever added.
  std::uint64_t additions() const noexcept { return additions_; }
  /// How many bodies were ever removed.
  std::uint64_t removals() const noexcept { return removals_; }
  /// Tells scenes apart.
  const Epoch& epoch() const noexcept { return epoch_; }

 private:
  struct ShapeBounds {
    Aabb bounds;
    ShapeBall ball;                               ///< about the bounds' centre, holds the bounds
    Vec3 half;                                    ///< the bounds' extent from there
    std::shared_ptr<const SupportTable> support;  ///< about the centre; null where vertices are not known
  };

  Aabb bounds_in_scene(const ShapeBounds& shape, const Pose& pose) const noexcept;
  void count_motion(PlacedBody& body, double motion) noexcept;
  /// Puts the body into the tree, with so much room about it.
  void put_into_tree(std::uint32_t index, const Aabb& bounds, double margin);
  /// Looks whether a body that was moved by so much is still in its box, and gives it another one if not.
  void fit_box(std::uint32_t index, double motion);

  std::vector<ShapeBounds> shapes_;
  std::vector<PlacedBody> bodies_;
  std::vector<std::uint32_t> free_;  ///< a heap, the lowest on top
  BodyTree tree_;
  double largest_of_shapes_ = 0;
  std::size_t count_ = 0;
  std::uint64_t additions_ = 0, removals_ = 0, moves_ = 0;
  double motion_ = 0;
  double motion_before_span_ = 0;
  std::uint32_t span_ = 1;
  Simd simd_ = widest_simd();
  Epoch epoch_ = Epoch::next();
};

}  // namespace touchmark
