/// How the bodies of generated scenes move: kinds as in Broadmark (Serpa and Rodrigues, 2020), in closed
/// form, so that a time has one pose whatever was asked before.
#pragma once

#include <optional>
#include <string>

#include "bench/scenes/body_scene.h"

namespace touchmark::bench::scenes {

/// Nothing where the name is of no motion. Lengths are in the diagonal of a body's box, which is 1.
std::optional<BodyMotion> generated_motion(const std::string& name, const BodyScene& scene);

}  // namespace touchmark::bench::scenes
