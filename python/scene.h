/// Batches of questions to a scene of bodies that move. Nothing here knows Python.
#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <vector>

#include "python/batch.h"
#include "python/detector.h"
#include "python/fork_safe_lock.h"

#include "core/scene/body.h"
#include "core/scene/pose.h"
#include "core/scene/scene.h"
#include "core/scene/scene_bodies.h"
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
  /// What a shape is made of.
  struct Parts {
    std::shared_ptr<const TriangleMesh> mesh;
    double radius;  ///< 0, or that of a round shape about the mesh, which is a segment
  };
  /// The lower half of a body's number says which place it has. The upper half says how many bodies had the
  /// place before it.
  struct Place {
    static constexpr std::uint32_t no_shape = PlacedBody::no_shape;

    std::uint32_t shape = no_shape;  ///< of the body that has the place
    std::uint32_t before = 0;
    Pose pose;  ///< of that body
  };
  /// All that a scene like this one is made of.
  struct Recipe {
    std::vector<Parts> shapes;
    std::vector<Place> places;
  };

  BatchScene() = default;
  /// Its bodies have the same numbers. Throws SceneError and PoseError.
  explicit BatchScene(const Recipe& recipe);
  Recipe recipe() const;

  // Each returns the number of the shape, and throws SceneError for a size that is out of range.
  std::size_t add_mesh(std::shared_ptr<const TriangleMesh> mesh);
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
  /// What `Place` says, and what the scene calls the body: the recipe's scene may have had others before.
  struct Entry {
    std::uint32_t shape = Place::no_shape;
    std::uint32_t before = 0;
    BodyId body;
  };
  std::size_t add_shape(Shape<SphereCluster> shape);
  std::int64_t number_of(BodyId body) const noexcept;
  /// Throws SceneError.
  std::size_t place_of(std::int64_t body) const;
  template <class Ask>
  bool ask_all(std::size_t count, const Effort& effort, const Ask& ask) const;

  Bodies scene_;
  std::vector<Parts> shapes_;
  std::vector<Entry> places_;
  mutable ForkSafeLock lock_;
};

}  // namespace touchmark::python
