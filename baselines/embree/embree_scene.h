/// The rival Embree with many bodies: instances of scenes, found by its point query through the stack of
/// transforms; this project's kernel is the callback. README.md states the decisions made for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "baselines/embree/embree_detector.h"
#include "baselines/hidden.h"
#include "baselines/posed.h"

namespace touchmark::baselines {

class EmbreeScene {
 public:
  struct Session {
    Work work;  ///< triangles: callbacks. Embree tells neither bodies nor boxes.
    /// The triangle of the last contact, and its body.
    std::uint32_t body = no_triangle, triangle = no_triangle;
  };

  /// With geometry user alone. Throws MeshError when Embree has no memory or cannot be started.
  EmbreeScene(const PosedScene& scene, const EmbreeDetector::Options& options);
  /// Takes effect with publish(), which commits the scene of instances.
  void place(std::uint32_t body, const Pose& pose);
  void publish();
  std::optional<BodyContact> nearest_body(const Probe& probe, double reach, Session& session) const noexcept;

  /// What Embree took, as its memory monitor says, the prepared triangles and the poses.
  std::size_t bytes() const noexcept;
  Accuracy accuracy() const noexcept;

 private:
  friend struct EmbreeSceneCallbacks;
  struct World;

  Hidden<World> world_;
};

}  // namespace touchmark::baselines
