/// Batches of questions to a scene of bodies that move. Nothing here knows Python.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <shared_mutex>

#include "python/batch.h"
#include "python/detector.h"

#include "core/scene/scene.h"
#include "core/scene/shape.h"
#include "core/sphere_cluster/sphere_cluster.h"
#include "core/triangle_mesh.h"

namespace touchmark::python {

/// A scene whose shapes are sphere clusters. Any thread may ask and change it: a change waits for the batches
/// that run, and a batch for a change.
///
/// A body is a number: 0 for the first, and never one that a removed body had.
class BatchScene {
 public:
  // Each returns the number of the shape, and throws SceneError for a size that is out of range.
  std::size_t add_mesh(const TriangleMesh& mesh);
  std::size_t add_plane(double size_x, double size_y);
  std::size_t add_box(double size_x, double size_y, double size_z);
  std::size_t add_sphere(double radius);
  std::size_t add_capsule(double radius, double length);
  /// These throw SceneError and PoseError.
  std::int64_t add(std::size_t shape, const Pose& pose);
  void move(std::int64_t body, const Pose& pose);
  void remove(std::int64_t body);
  Pose pose(std::int64_t body) const;
  std::size_t size() const;
  std::size_t bytes() const;

  // Each returns false where it was interrupted. A body is -1 where nothing is found.
  bool touches(Points centers, Sizes radii, bool* touching, const Effort& effort) const;
  bool nearest(Points centers, Sizes reaches, ContactArrays contacts, std::int64_t* body,
               const Effort& effort) const;
  bool first_hit(Points from, Points to, Sizes radii, double* fraction, ContactArrays contacts,
                 std::int64_t* body, const Effort& effort) const;

 private:
  using Bodies = Scene<SphereCluster>;
  std::size_t add_shape(Shape<SphereCluster> shape);
  template <class Ask>
  bool ask_all(std::size_t count, const Effort& effort, const Ask& ask) const;

  Bodies scene_;
  std::size_t shapes_ = 0;
  mutable std::shared_mutex lock_;
};

}  // namespace touchmark::python
