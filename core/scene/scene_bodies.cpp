#include "core/scene/scene_bodies.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <string>

#include "core/float_limits.h"

namespace touchmark {
namespace {

/// Returns a float that is no less than x, which is far from where floats underflow: two of its roundings
/// more.
float raised_to_float(double x) noexcept { return static_cast<float>(x * (1 + 0x1p-22)); }

/// Returns a float that is no more than x, which is at least 0; 0 where x is no number.
float lowered_to_float(double x) noexcept {
  const double lowered = x * (1 - 0x1p-22);
  return lowered > 0x1p-100 ? static_cast<float>(std::min(lowered, 0x1p100)) : 0;
}

/// Takes numbers that are at least 0. A double times 1 + 2^-52 is the next one at least, and sums that
/// underflow are exact.
double sum_rounded_up(double a, double b) noexcept { return (a + b) * (1 + 0x1p-52); }

}  // namespace

ShapeId SceneBodies::add_shape(const Aabb& bounds, std::span<const Vec3> vertices, double beyond) {
  const auto index = static_cast<std::uint32_t>(shapes_.size());
  if (bounds.empty() || !bounds.min.allFinite() || !bounds.max.allFinite())
    throw SceneError("shape " + std::to_string(index) + " has no finite bounds");
  const Vec3 center = bounds.center();
  // Both differences count, since the centre is rounded.
  const Vec3 half = (bounds.max - center).cwiseMax(center - bounds.min) * (1 + 4 * unit_roundoff);
  ShapeBounds shape{
      bounds, {center, half.norm() * (1 + 4 * unit_roundoff), center.cwiseAbs().sum()}, half, nullptr};
  if (!vertices.empty())
    shape.support = std::make_shared<const SupportTable>(vertices, center, shape.ball.radius, beyond);
  shapes_.push_back(shape);
  const double largest = std::max(bounds.min.cwiseAbs().maxCoeff(), bounds.max.cwiseAbs().maxCoeff());
  largest_of_shapes_ = std::max(largest_of_shapes_, largest);
  return {index};
}

BodyId SceneBodies::add(ShapeId shape, const Pose& pose) {
  if (shape.index >= shapes_.size())
    throw SceneError("there is no shape " + std::to_string(shape.index) + ": the scene has " +
                     std::to_string(shapes_.size()));
  const double rigid = expect_rigid(pose);
  std::uint32_t index = 0;
  if (free_.empty()) {
    index = static_cast<std::uint32_t>(bodies_.size());
    // Room grows by a sixteenth only, since memory counts more than the time of adding. There is room in
    // free_, too, so that remove takes none.
    if (bodies_.size() == bodies_.capacity()) reserve(bodies_.size() + bodies_.size() / 16 + 4);
    bodies_.emplace_back();
  } else {
    std::ranges::pop_heap(free_, std::greater<>());
    index = free_.back();
    free_.pop_back();
  }
  PlacedBody& body = bodies_[index];
  body.pose = pose;
  body.rigid = raised_to_float(rigid);
  body.shape = shape.index;
  body.moved_in_span = 0;
  // A body that stands needs no room: one that moves gets it with its first move.
  put_into_tree(index, bounds_in_scene(shapes_[shape.index], pose), 0);
  ++count_;
  ++additions_;
  return {index, body.generation};
}

void SceneBodies::move(BodyId id, const Pose& pose) {
  if (!has(id)) expect(id);  // which is long, and has is inlined
  PlacedBody& body = bodies_[id.index];
  const PoseChange change = pose_change(body.pose, pose, shapes_[body.shape].ball, simd_);
  const double rigid = change.is_rigid ? change.rigid : expect_rigid(pose), motion = change.motion;
  body.pose = pose;
  body.rigid = raised_to_float(rigid);
  count_motion(body, motion);
  // The difference is off by one rounding of itself, and as a float by another.
  const double room = (double{body.room} - motion) * (1 - 0x1p-20);
  if (room > 0x1p-100)
    body.room = static_cast<float>(room);
  else
    fit_box(id.index, motion);
}

void SceneBodies::put_into_tree(std::uint32_t index, const Aabb& bounds, double margin) {
  tree_.insert(index, bounds, margin);
  ++bodies_[index].placed;
  bodies_[index].room = lowered_to_float(tree_.room(index, bounds));
}

void SceneBodies::fit_box(std::uint32_t index, double motion) {
  PlacedBody& body = bodies_[index];
  const ShapeBounds& shape = shapes_[body.shape];
  const Aabb bounds = bounds_in_scene(shape, body.pose);
  const double room = tree_.room(index, bounds);
  if (room >= 0) {
    body.room = lowered_to_float(room);
    return;
  }
  tree_.remove(index);
  // Room for some more moves like this one, but not for a jump's.
  put_into_tree(index, bounds, 0.05 * shape.ball.radius + std::min(16 * motion, 2 * shape.ball.radius));
}

void SceneBodies::remove(BodyId id) {
  expect(id);
  PlacedBody& body = bodies_[id.index];
  tree_.remove(id.index);
  body.shape = PlacedBody::no_shape;
  ++body.generation;
  --count_;
  ++removals_;
  free_.push_back(id.index);
  std::ranges::push_heap(free_, std::greater<>());
}

void SceneBodies::reserve(std::size_t bodies) {
  bodies_.reserve(bodies);
  free_.reserve(bodies);
  tree_.reserve(bodies);
}

void SceneBodies::follow(const SceneBodies& other, std::span<const std::uint32_t> changed) {
  shapes_.insert(shapes_.end(), other.shapes_.begin() + static_cast<std::ptrdiff_t>(shapes_.size()),
                 other.shapes_.end());
  largest_of_shapes_ = other.largest_of_shapes_;
  if (bodies_.size() < other.bodies_.size()) bodies_.resize(other.bodies_.size());
  for (const std::uint32_t index : changed) {
    PlacedBody& own = bodies_[index];
    const PlacedBody& theirs = other.bodies_[index];
    const bool was = own.shape != PlacedBody::no_shape, is = theirs.shape != PlacedBody::no_shape;
    const bool stays = was && is && own.placed == theirs.placed;
    if (was && !stays) tree_.remove(index);
    if (is && !stays) tree_.insert_as_in(index, other.tree_);
    own = theirs;
  }
  if (free_ != other.free_) free_ = other.free_;
  count_ = other.count_;
  additions_ = other.additions_;
  removals_ = other.removals_;
  moves_ = other.moves_;
  motion_ = other.motion_;
  motion_before_span_ = other.motion_before_span_;
  span_ = other.span_;
}

bool SceneBodies::has(BodyId id) const noexcept {
  return id.index < bodies_.size() && bodies_[id.index].shape != PlacedBody::no_shape &&
         bodies_[id.index].generation == id.generation;
}

const PlacedBody& SceneBodies::expect(BodyId id) const {
  if (!has(id))
    throw SceneError("there is no body " + std::to_string(id.index) + " of generation " +
                     std::to_string(id.generation));
  return bodies_[id.index];
}

std::size_t SceneBodies::bytes() const noexcept {
  return shapes_.capacity() * (sizeof(ShapeBounds) + sizeof(SupportTable)) +
         bodies_.capacity() * sizeof(PlacedBody) + free_.capacity() * sizeof(std::uint32_t) + tree_.bytes();
}

/// The box about the image of the bounds' centre that reaches as far in each direction as the rotation takes
/// their half extents, or the shape's vertices, if that is less.
Aabb SceneBodies::bounds_in_scene(const ShapeBounds& shape, const Pose& pose) const noexcept {
  const Vec3 center = image(pose, shape.ball.center);
  const Vec3 half = pose.rotation.cwiseAbs() * shape.half;
  // No entry of a rotation is above 1 by more than the 2^-32 that it may be off.
  const Vec3 rounding = 8 * unit_roundoff *
                        (Vec3::Constant(1.01 * shape.ball.center_size) + pose.translation.cwiseAbs() + half);
  Vec3 below = half, above = half;
  if (shape.support) {
    for (int k = 0; k < 3; ++k) {
      const Vec3 row = pose.rotation.row(k);
      above[k] = std::min(half[k], shape.support->along(row));
      below[k] = std::min(half[k], shape.support->along(-row));
    }
  }
  const Vec3 more = rounding * (1 + 4 * unit_roundoff);
  return {center - (below + more), center + (above + more)};
}

void SceneBodies::count_motion(PlacedBody& body, double motion) noexcept {
  if (body.moved_in_span == span_) end_span();
  ++moves_;
  body.moved_in_span = span_;
  motion_ = std::max(motion_, sum_rounded_up(motion_before_span_, motion));
}

}  // namespace touchmark
