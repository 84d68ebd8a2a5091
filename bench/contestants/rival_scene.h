/// Scenes of bodies over another project's library: what a rival's entry builds one with.
#pragma once

#include "baselines/posed.h"
#include "bench/contestants/scene_player.h"

namespace touchmark::bench::contestants {

/// Throws std::invalid_argument for round bodies.
inline baselines::PosedScene posed(const scenes::PlacedScene& placed) {
  expect_triangles(placed);
  baselines::PosedScene scene{placed.shapes, {}};
  scene.bodies.reserve(placed.bodies.size());
  for (const scenes::PlacedScene::PlacedBody& body : placed.bodies)
    scene.bodies.push_back({body.shape, body.start});
  return scene;
}

/// `options_of(values)` returns what each shape of the scene S is built with.
template <PlayableScene S, class OptionsOfValues>
BuildSceneContestant build_rival_scene(OptionsOfValues options_of) {
  return [options_of](const scenes::PlacedScene& placed, const OptionValues& values) {
    expect_options_of_scenes(values);
    return scene_contestant(
        placed, [&](const scenes::PlacedScene& one) { return S(posed(one), options_of(values)); });
  };
}

}  // namespace touchmark::bench::contestants
