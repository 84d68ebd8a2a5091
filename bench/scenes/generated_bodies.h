/// Scenes of bodies that need no file, with their motions. Each is the same bits on every machine: hashed
/// numbers, square roots and plain arithmetic only.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/scenes/body_scene.h"

namespace touchmark::bench::scenes {

struct BodySceneInfo {
  std::string name;         ///< "field:N"
  std::string description;  ///< one line
};

/// Returns the kinds of scenes, and those of motions that they take as ":motion=NAME".
std::vector<BodySceneInfo> body_scenes();
std::vector<BodySceneInfo> body_motions();

struct GeneratedScene {
  BodyScene scene;
  BodyMotion motion;  ///< none moves where it is still
};

/// Returns the scene of "NAME:N[:motion=M]", of 1 to 1,000,000 bodies; nothing where the name is none of
/// these. Throws std::invalid_argument for a number or motion that is none.
std::optional<GeneratedScene> generated_scene(const std::string& what);

}  // namespace touchmark::bench::scenes
