/// The rival FCL with many bodies: its DynamicAABBTreeCollisionManager finds the bodies, FclDetector asks
/// each. README.md states the decisions made for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "baselines/fcl/fcl_detector.h"
#include "baselines/hidden.h"
#include "baselines/posed.h"

namespace touchmark::baselines {

class FclScene {
 public:
  using Session = PosedShapes<FclDetector>::Session;

  /// Throws what FclDetector::build throws.
  FclScene(const PosedScene& scene, const FclDetector::Options& options);
  /// Takes effect with publish().
  void place(std::uint32_t body, const Pose& pose);
  void publish();
  std::optional<BodyContact> nearest_body(const Probe& probe, double reach, Session& session) const noexcept;

  /// The bodies' shapes, and FCL's objects and nodes by their sizes.
  std::size_t bytes() const noexcept;
  Accuracy accuracy() const noexcept;

 private:
  struct World;

  Hidden<World> world_;
};

}  // namespace touchmark::baselines
