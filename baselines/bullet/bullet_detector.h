/// The rival Bullet 3.24: a mesh as btBvhTriangleMeshShape, the probe as btSphereShape. README.md states the
/// decisions made for it. This class exists twice, over Bullet's float library and over its double library,
/// in two libraries that never meet in one program.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>

#include "baselines/rival.h"

namespace touchmark::baselines {

class BulletDetector {
 public:
  /// The precision of Bullet's numbers, as the linked library was built.
  enum class Precision { single_precision, double_precision };
  /// contact: Bullet's own contact test of two objects and its convex sweep. callback: Bullet's hierarchy of
  /// quantised boxes, and this project's kernel for the triangles it reports.
  enum class Method { contact, callback };
  /// mesh: coordinates as they are. fitted: box centre at the origin, mean edge length 1, which is the size
  /// that Bullet is written for; the results are brought back.
  enum class Frame { mesh, fitted };

  struct Options {
    Method method = Method::contact;
    Frame frame = Frame::mesh;
    Asking query = Asking::checked;
  };

  struct State;
  /// work.triangles: those Bullet reports. It does not tell how many boxes it looks at.
  using Session = StatefulSession<State>;

  static Precision precision() noexcept;

  /// Throws MeshError for more than 2^31 - 1 triangles or vertices.
  static BulletDetector build(const TriangleMesh& mesh, const Options& options);
  static BulletDetector build(const TriangleMesh& mesh) { return build(mesh, Options{}); }
  /// See the concept Updates. Bullet refits its hierarchy; with frame fitted the one fitted first stays.
  void update(const TriangleMesh& mesh);

  bool touches(const Probe& probe, Session& session) const noexcept;
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept;
  std::optional<Impact> first_hit(const Sweep& sweep, Session& session) const noexcept;

  /// The hierarchy as Bullet would write it to a file, vertices and indices, and the prepared triangles.
  std::size_t bytes() const noexcept;
  Accuracy accuracy() const noexcept;

 private:
  struct Model;
  struct Queries;
  explicit BulletDetector(Hidden<Model> model) noexcept : model_(std::move(model)) {}
  State& state(Session& session) const;

  Hidden<Model> model_;
};

}  // namespace touchmark::baselines
