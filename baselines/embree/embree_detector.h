/// The rival Embree 3.13: its point query over its own hierarchy, with this project's kernel as the callback,
/// which is how Embree means point queries to be used. README.md states the decisions made for it.
#pragma once

#include <cstddef>
#include <memory>
#include <optional>

#include "core/detector.h"

namespace touchmark::baselines {

class EmbreeDetector {
 public:
  /// triangle: Embree's triangle geometry. user: user geometry with boxes of our own, rounded outward.
  enum class Geometry { triangle, user };
  /// Embree's build quality; refit: medium, in a scene of the kind that follows its geometry by refitting.
  enum class Quality { medium, high, refit };

  struct Options {
    Geometry geometry = Geometry::user;
    Quality quality = Quality::medium;
    bool warm = true;  ///< start from the distance of the session's last triangle
  };
  struct Session {
    Work work;  ///< triangles: callbacks. Embree tells no boxes.
    std::uint32_t last = 0;
  };

  /// Throws MeshError when Embree has no memory for the mesh or cannot be started.
  static EmbreeDetector build(const TriangleMesh& mesh, const Options& options);
  static EmbreeDetector build(const TriangleMesh& mesh) { return build(mesh, Options()); }
  /// See the concept Updates. Embree builds its hierarchy anew, or with quality refit refits it.
  void update(const TriangleMesh& mesh);

  EmbreeDetector(EmbreeDetector&&) noexcept;
  EmbreeDetector& operator=(EmbreeDetector&&) noexcept;
  ~EmbreeDetector();

  bool touches(const Probe& probe, Session& session) const noexcept;
  std::optional<Contact> nearest(const Probe& probe, double reach, Session& session) const noexcept;

  /// What Embree took, as its memory monitor says, and the prepared triangles.
  std::size_t bytes() const noexcept;
  Accuracy accuracy() const noexcept;

 private:
  friend struct EmbreeCallbacks;
  struct Model;
  explicit EmbreeDetector(std::unique_ptr<Model> model) noexcept;

  std::unique_ptr<Model> model_;
};

}  // namespace touchmark::baselines
