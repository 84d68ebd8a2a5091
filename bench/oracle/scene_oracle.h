/// What the right answers are about a scene of bodies as it stands: on the images of the stored triangles
/// under the stored poses, or so far from an axis, in exact arithmetic. Doubles only choose which triangles
/// are looked at, by bounds that hold whatever was rounded.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <utility>
#include <vector>

#include "bench/oracle/reference.h"
#include "core/scene/pose.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::oracle {

class SceneOracle final : public Reference {
 public:
  struct Body {
    std::uint32_t shape = 0;
    Pose pose;
    double radius = 0;  ///< a round body's, whose shape is its axis: core/scene/shape.h
  };

  /// Throws std::invalid_argument for 2^32 triangles or more in all bodies together.
  SceneOracle(std::vector<std::shared_ptr<const TriangleMesh>> shapes, std::vector<Body> bodies);
  ~SceneOracle() override;
  SceneOracle(SceneOracle&&) noexcept;
  SceneOracle& operator=(SceneOracle&&) noexcept;

  /// Puts a body elsewhere. Truths of before are no longer of this scene.
  void place(std::uint32_t body, const Pose& pose);
  const Pose& pose(std::uint32_t body) const;

  using Reference::solve;
  GroundTruth solve(const Vec3& center) const override;
  GroundTruth solve(const Vec3& center, std::uint32_t triangle) const override;
  bool within(const GroundTruth& truth, const Vec3& center, double radius) const override;
  bool within(std::uint32_t triangle, const Vec3& center, double radius) const override;
  std::vector<std::uint32_t> all_within(const Vec3& center, double radius) const override;
  bool segment_within(const Vec3& from, const Vec3& to, double radius) const override;
  bool segment_nearer(const Vec3& from, const Vec3& to, double radius) const override;
  bool touches_before(const Sweep& sweep, double fraction) const override;
  bool touches_soon_after(const Sweep& sweep, double fraction, double radius) const override;
  bool surely_crosses(const Vec3& from, const Vec3& to, double margin) const override;
  /// Nothing: a scene is not asked for sides.
  std::optional<Side> side(const Vec3&) const override { return std::nullopt; }
  std::pair<std::size_t, std::size_t> named_by(const workload::Answer& answer) const override;
  bool names_first(const GroundTruth& truth, const workload::Answer& answer) const override;
  double largest_difference(const Vec3& center, std::uint32_t triangle) const override;
  Interval distance_bounds(const Vec3& point, std::uint32_t triangle) const override;
  /// The box of the bodies where they were when it was made: judges measure in it.
  Box bounds() const override;

  /// Returns the body of a triangle, and the id of the triangle in that body's mesh.
  std::pair<std::uint32_t, TriangleId> name_of(std::uint32_t triangle) const;

 private:
  struct Structure;
  std::unique_ptr<Structure> structure_;
};

}  // namespace touchmark::bench::oracle
