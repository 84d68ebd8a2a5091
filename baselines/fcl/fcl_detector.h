/// The rival FCL (Flexible Collision Library 0.7): a mesh as BVHModel, the probe as Sphere. README.md states
/// the decisions made for it.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>

#include "baselines/rival.h"

namespace touchmark::baselines {

class FclDetector {
 public:
  /// The hierarchy's bounding volume.
  enum class Volume { kios, obbrss, obb, rss, aabb };
  /// collide: fcl::collide with a sphere, every contact asked for, the deepest taken: what a user of FCL
  /// writes. traverse: the same traversal and narrow phase without the dispatcher (which copies the whole
  /// mesh a query where the volume is aabb). distance: FCL's best-first distance traversal from a bare point,
  /// bounded by the reach.
  enum class Method { collide, traverse, distance };
  /// fcl: FCL's own sphere and triangle. exact: this project's kernel on the triangles that FCL's traversal
  /// reaches; not with method collide.
  enum class Narrow { fcl, exact };

  struct Options {
    Volume bv = Volume::kios;
    Method method = Method::collide;
    Narrow narrow = Narrow::fcl;
    Asking query = Asking::checked;
  };

  struct State;
  /// work.boxes: FCL's volumes. Method collide tells neither; its triangles are the contacts found.
  using Session = StatefulSession<State>;

  /// Throws std::invalid_argument for a combination that FCL cannot do, MeshError for more than 2^31 - 1
  /// triangles or vertices.
  static FclDetector build(const TriangleMesh& mesh, const Options& options);
  static FclDetector build(const TriangleMesh& mesh) { return build(mesh, Options{}); }
  /// See the concept Updates. FCL replaces its vertices and refits its hierarchy.
  void update(const TriangleMesh& mesh);

  bool touches(const Probe& probe, Session& session) const noexcept;
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept;

  /// FCL's vertices, indices and volumes, and with narrow exact the prepared triangles. FCL's own memUsage()
  /// returns a status code, not bytes.
  std::size_t bytes() const noexcept;
  Accuracy accuracy() const noexcept;

 private:
  struct Model;
  template <class Volume>
  struct ModelOf;
  explicit FclDetector(Hidden<Model> model) noexcept : model_(std::move(model)) {}

  Hidden<Model> model_;
};

}  // namespace touchmark::baselines
