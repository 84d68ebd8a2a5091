/// The rival Bullet with many bodies: its dynamic tree finds the bodies, BulletDetector asks each. README.md
/// states the decisions made for it.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "baselines/bullet/bullet_detector.h"
#include "baselines/posed.h"
#include "baselines/rival.h"

namespace touchmark::baselines {

class BulletScene {
 public:
  struct State;
  /// `last` is the body of the last contact.
  using Session = StatefulSession<State>;

  /// Throws what BulletDetector::build throws.
  BulletScene(const PosedScene& scene, const BulletDetector::Options& options);
  void place(std::uint32_t body, const Pose& pose);
  std::optional<BodyContact> nearest_body(const Probe& probe, double reach, Session& session) const noexcept;
  std::optional<BodyImpact> first_hit_body(const Sweep& sweep, Session& session) const noexcept;

  /// The bodies' shapes and the tree's nodes.
  std::size_t bytes() const noexcept;
  Accuracy accuracy() const noexcept;

 private:
  struct World;

  Hidden<World> world_;
};

}  // namespace touchmark::baselines
