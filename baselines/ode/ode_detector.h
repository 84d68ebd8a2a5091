/// The rival ODE (Open Dynamics Engine 0.16): a mesh as a trimesh geometry, the probe as a sphere. README.md
/// states the decisions made for it.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>

#include "baselines/rival.h"

namespace touchmark::baselines {

class OdeDetector {
 public:
  /// front: the mesh as it is, which ODE collides with from the side that its normals point to. both: every
  /// triangle a second time, turned over.
  enum class Sides { front, both };

  struct Options {
    Sides sides = Sides::front;
    Asking query = Asking::checked;
  };

  struct State;
  /// work.triangles: the contacts that ODE reports. It does not tell what it looks at.
  using Session = StatefulSession<State>;

  /// Throws MeshError for more than 2^30 triangles or 2^31 - 1 vertices.
  static OdeDetector build(const TriangleMesh& mesh, const Options& options);
  static OdeDetector build(const TriangleMesh& mesh) { return build(mesh, Options{}); }

  bool touches(const Probe& probe, Session& session) const noexcept;
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept;

  /// Vertices and indices. ODE does not tell what its hierarchy takes; heap_bytes of the results does.
  std::size_t bytes() const noexcept;
  Accuracy accuracy() const noexcept;

 private:
  struct Model;
  explicit OdeDetector(Hidden<Model> model) noexcept : model_(std::move(model)) {}
  std::optional<Contact> nearest_in_ball(const Vec3& center, double radius, Session& session) const noexcept;

  Hidden<Model> model_;
};

}  // namespace touchmark::baselines
