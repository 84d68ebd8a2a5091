/// The rival Embree, 3.13 or 4: its point query over its own hierarchy, with this project's kernel as the
/// callback or with its own triangles in single precision. README.md states the decisions made for it.
#pragma once

#include <cstddef>
#include <optional>
#include <utility>

#include "baselines/rival.h"

namespace touchmark::baselines {

class EmbreeDetector {
 public:
  /// user: user geometry with boxes of our own, rounded outward, and our kernel in double. triangle: Embree's
  /// triangle geometry and the closest point of its triangles in single precision, which is an approximation.
  /// triangle_exact: Embree's triangle geometry for its boxes, and our kernel.
  enum class Geometry { user, triangle, triangle_exact };
  /// Embree's build quality; refit: medium, in a scene of the kind that follows its geometry by refitting.
  enum class Quality { medium, high, refit };

  struct Options {
    Geometry geometry = Geometry::user;
    Quality quality = Quality::medium;
    bool warm = true;  ///< `nearest` starts from the distance of the session's last triangle
    Asking query = Asking::checked;
  };
  /// work.triangles: callbacks. Embree tells no boxes.
  using Session = RivalSession;

  /// Throws MeshError when Embree has no memory for the mesh or cannot be started.
  static EmbreeDetector build(const TriangleMesh& mesh, const Options& options);
  static EmbreeDetector build(const TriangleMesh& mesh) { return build(mesh, Options()); }
  /// See the concept Updates. Embree builds its hierarchy anew, or with quality refit refits it.
  void update(const TriangleMesh& mesh);

  bool touches(const Probe& probe, Session& session) const noexcept;
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept;

  /// What Embree took, as its memory monitor says, and the prepared triangles, if any.
  std::size_t bytes() const noexcept;
  Accuracy accuracy() const noexcept;

 private:
  friend struct EmbreeCallbacks;
  struct Model;
  explicit EmbreeDetector(Hidden<Model> model) noexcept : model_(std::move(model)) {}

  Hidden<Model> model_;
};

}  // namespace touchmark::baselines
