/// What bodies are made of: a built detector and the mesh that it was built of, or a source of both that is
/// asked when a probe first comes near.
#pragma once

#include <functional>
#include <limits>
#include <memory>
#include <utility>
#include <vector>

#include "core/aabb.h"
#include "core/detector.h"
#include "core/scene/pose.h"
#include "core/scene/round/primitives.h"
#include "core/triangle_mesh.h"

namespace touchmark {

/// A mesh in its own frame with a detector over it. The mesh is kept, since what is decided exactly is
/// decided on its stored vertices. Or a round shape, whose mesh is one triangle without area, its axis.
template <Detector D>
struct Shape {
  std::shared_ptr<const D> detector;  ///< null for a round shape
  std::shared_ptr<const TriangleMesh> mesh;
  double radius = 0;  ///< 0, or a round shape's, whose surface is all that is so far from its axis

  /// Throws what D::build throws.
  static Shape build(TriangleMesh mesh, const typename D::Options& options) {
    auto shared = std::make_shared<const TriangleMesh>(std::move(mesh));
    return {std::make_shared<const D>(D::build(*shared, options)), shared};
  }
  static Shape build(TriangleMesh mesh) { return build(std::move(mesh), typename D::Options()); }
  /// Returns a capsule about the segment, or a sphere where its ends are one point. Throws MeshError for an
  /// end that is not finite; Scene::add_shape refuses a radius that is not positive and finite.
  static Shape round(const Vec3& from, const Vec3& to, double radius) {
    return {nullptr,
            std::make_shared<const TriangleMesh>(std::vector<Vec3>{from, to},
                                                 std::vector<TriangleMesh::Corners>{{0, 1, 1}}),
            radius};
  }
  // The primitives of primitives.h. Each throws SceneError for a size that is out of range.
  static Shape plane(double size_x, double size_y) { return build(plane_mesh(size_x, size_y)); }
  static Shape box(const Vec3& size) { return build(box_mesh(size)); }
  static Shape sphere(double radius) {
    expect_primitive_size("sphere", "radius", radius);
    return round(Vec3::Zero(), Vec3::Zero(), radius);
  }
  /// Returns all points so far from the segment of this length along z about the origin.
  static Shape capsule(double radius, double length) {
    expect_primitive_size("capsule", "radius", radius);
    expect_primitive_size("capsule", "length", length);
    return round({0, 0, -0.5 * length}, {0, 0, 0.5 * length}, radius);
  }

  bool is_round() const noexcept { return radius != 0; }
  /// Returns the box that holds the mesh, or the round surface under whatever counts as a rotation.
  Aabb bounds() const noexcept {
    const Aabb& box = mesh->bounds();
    if (!is_round()) return box;
    const double largest = box.min.cwiseAbs().cwiseMax(box.max.cwiseAbs()).maxCoeff();
    return box.padded(radius * (1 + 2 * max_rigid_error) +
                      4 * std::numeric_limits<double>::epsilon() * largest);
  }
};

/// A shape that is made when a probe first comes near one of its bodies.
template <Detector D>
struct ShapeSource {
  Aabb bounds;                     ///< holds the mesh; nothing else of it is known before it is made
  std::function<Shape<D>()> make;  ///< called once at most; what it throws is thrown by Scene::build_near
};

}  // namespace touchmark
