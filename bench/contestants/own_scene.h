/// Our scenes of bodies over our own detectors: core/scene, and what it is compared with.
#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <utility>
#include <vector>

#include <fmt/format.h>

#include "bench/contestants/build_notes.h"
#include "bench/contestants/scene_player.h"
#include "core/scene/scene.h"

namespace touchmark::bench::contestants {

/// core/scene/scene.h.
template <Detector D>
class OwnScene {
 public:
  using Session = typename Scene<D>::Session;

  /// Builds the shapes of which a body is ever near a probe. Should a query need another one, it builds it.
  OwnScene(const scenes::PlacedScene& placed, const OptionValues& values, const OptionsOf<D>& options) {
    std::vector<ShapeId> shapes;
    std::size_t meshes = 0, built = 0;
    for (std::size_t i = 0; i < placed.shapes.size(); ++i) {
      const auto& mesh = placed.shapes[i];
      if (const double radius = placed.radius_of(i); radius > 0) {
        shapes.push_back(scene_.add_shape({nullptr, mesh, radius}));
        continue;
      }
      const auto make = [=] {
        return Shape<D>{std::make_shared<const D>(D::build(*mesh, options(*mesh, values))), mesh};
      };
      ++meshes;
      built += placed.is_near(i) ? 1 : 0;
      shapes.push_back(placed.is_near(i) ? scene_.add_shape(make())
                                         : scene_.add_shape(ShapeSource<D>{mesh->bounds(), make}));
    }
    if (built < meshes)
      remark(fmt::format("{} of {} shapes are built: no probe comes near a body of another", built, meshes));
    for (const scenes::PlacedScene::PlacedBody& body : placed.bodies)
      ids_.push_back(scene_.add(shapes[body.shape], body.start));
  }

  void place(std::uint32_t body, const Pose& pose) { scene_.move(ids_[body], pose); }
  std::optional<BodyContact> nearest_body(const Probe& probe, double reach, Session& session) const noexcept {
    return scene_.nearest_body(probe, reach, session);
  }
  std::optional<BodyImpact> first_hit_body(const Sweep& sweep,
                                           Session& session) const noexcept requires AnswersSweep<D> {
    return scene_.first_hit_body(sweep, session);
  }
  /// Throws PoseError.
  MovingBody moving(std::uint32_t body, const Pose& after) const {
    return {ids_[body], scene_.pose(ids_[body]), after};
  }
  std::optional<BodyImpact> first_hit_moving(const Sweep& sweep, std::span<const MovingBody> moving,
                                             Session& session) const noexcept requires AnswersSweep<D> {
    return scene_.first_hit_moving(sweep, moving, session);
  }
  bool touches(const Probe& probe, Session& session) const noexcept { return scene_.touches(probe, session); }
  std::size_t contacts(const Probe& probe, double reach, Session& session,
                       std::span<Contact> into) const noexcept {
    return scene_.contacts(probe, reach, session, into);
  }
  void prepare(Session& session) const noexcept requires Prepares<D> { scene_.prepare(session); }
  std::size_t bytes() const noexcept { return scene_.bytes(); }
  Accuracy accuracy() const noexcept { return scene_.accuracy(); }

 private:
  Scene<D> scene_;
  std::vector<BodyId> ids_;
};

template <Detector D>
BuildSceneContestant build_own_scene(OptionsOf<D> options) {
  return [options = std::move(options)](const scenes::PlacedScene& placed, const OptionValues& values) {
    expect_options_of_scenes(values);
    return scene_contestant(
        placed, [&](const scenes::PlacedScene& one) { return OwnScene<D>(one, values, options); });
  };
}

}  // namespace touchmark::bench::contestants
