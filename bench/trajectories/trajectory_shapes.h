/// How each generated trajectory moves. One function a trajectory; trajectories.cpp lists them.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "bench/support/random.h"
#include "core/probe.h"
#include "core/triangle_mesh.h"

namespace touchmark::bench::trajectories {

/// In diagonals a tick, where no speed is given: in contact 0.1 m/s on an object of 20 cm, in free motion
/// twice that.
inline constexpr double slide_speed = 0.0005, hover_speed = 0.001;

/// What may follow the name of `hand`, as lists and errors show it.
inline constexpr const char* hand_words =
    "[:contact|free|tap][,speed=F,tremor=F,noise=F,encoder=LENGTH,size=LENGTH]";

/// What all of them are given. `steps` positions come back.
struct Motion {
  const TriangleMesh& mesh;
  std::size_t steps;  ///< at least 1
  support::Random random;
  double diagonal;  ///< the unit of length, > 0: the mesh's diagonal, or a stand-in where that is zero
  double radius;    ///< the probe's, cut to 0.05 diagonal: a larger ball would not follow the surface
  std::optional<double> speed = std::nullopt;  ///< diagonals a tick; nothing: the shape's own
  std::string name = {};  ///< with the words behind it, which a shape with words of its own reads
  double metre = 1;       ///< in mesh units
};

using Positions = std::vector<Vec3>;

Positions slide(Motion motion);
Positions approach(Motion motion);
Positions hover(Motion motion);
Positions jump(Motion motion);
Positions tap(Motion motion);
Positions edge(Motion motion);
Positions cross(Motion motion);
Positions hand(Motion motion);

}  // namespace touchmark::bench::trajectories
