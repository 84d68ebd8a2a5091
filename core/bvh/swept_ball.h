/// Eight triangles and a moving ball in single precision, so that planes tell at once which of them the ball
/// does not come near.
#pragma once

#include <array>

#include "core/bvh/node.h"
#include "core/probe.h"

namespace touchmark::bvh {

/// A ball that moves straight; lengths are in the tree's frame, but for where it starts.
struct SweptBall {
  Vec3 from;
  double scale;   ///< the frame's
  float x, y, z;  ///< its way
  float radius;
  float until;     ///< the part of the way that is asked about
  float rounding;  ///< as a share of the lengths that are compared: docs/exactness.md, E18

  SweptBall(const Sweep& sweep, double part, double frame_scale) noexcept
      : from(sweep.from),
        scale(frame_scale),
        x(static_cast<float>((sweep.to.x() - from.x()) * scale)),
        y(static_cast<float>((sweep.to.y() - from.y()) * scale)),
        z(static_cast<float>((sweep.to.z() - from.z()) * scale)),
        radius(static_cast<float>(sweep.radius * scale)),
        until(static_cast<float>(part)),
        rounding(0x1p-18F) {}
};

/// So many triangles are worth a look at eight at once.
inline constexpr std::uint32_t min_at_once = 3;

/// Vectors from the corners of eight triangles to where the ball starts.
struct EightTriangles {
  alignas(64) float to[9][width];  ///< x, y, z of the first corner, of the second, of the third
};

/// What keeps triangles apart: unit normals towards the ball, and how far above the highest corner along its
/// normal the ball's centre starts, rounded down.
struct EightPlanes {
  alignas(64) std::array<float, width> x, y, z, height;
};

}  // namespace touchmark::bvh
