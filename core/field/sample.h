/// What a sampled field is made from.
#pragma once

#include <cstdint>
#include <functional>

#include "core/probe.h"

namespace touchmark::field {

/// What is known of one point: its distance from the mesh, and where and in which triangle that is.
struct Sample {
  double distance = 0;  ///< infinity where nothing is within the reach, and then no more is known
  Vec3 nearest = Vec3::Zero();
  std::uint32_t triangle = 0;  ///< position in the mesh
};

/// Takes samples within a reach one after the other; each thread has its own.
using Sampler = std::function<Sample(const Vec3&, double reach)>;

}  // namespace touchmark::field
