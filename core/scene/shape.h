/// What bodies are made of: a built detector and the mesh that it was built of, or a source of both that is
/// asked when a probe first comes near.
#pragma once

#include <functional>
#include <memory>
#include <utility>

#include "core/aabb.h"
#include "core/detector.h"
#include "core/triangle_mesh.h"

namespace touchmark {

/// A mesh in its own frame with a detector over it. The mesh is kept, since what is decided exactly is
/// decided on its stored vertices.
template <Detector D>
struct Shape {
  std::shared_ptr<const D> detector;
  std::shared_ptr<const TriangleMesh> mesh;

  /// Throws what D::build throws.
  static Shape build(TriangleMesh mesh, const typename D::Options& options) {
    auto shared = std::make_shared<const TriangleMesh>(std::move(mesh));
    return {std::make_shared<const D>(D::build(*shared, options)), shared};
  }
  static Shape build(TriangleMesh mesh) { return build(std::move(mesh), typename D::Options()); }
};

/// A shape that is made when a probe first comes near one of its bodies.
template <Detector D>
struct ShapeSource {
  Aabb bounds;                     ///< holds the mesh; nothing else of it is known before it is made
  std::function<Shape<D>()> make;  ///< called once at most; what it throws is thrown by Scene::build_near
};

}  // namespace touchmark
