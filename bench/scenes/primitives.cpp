#include "bench/scenes/primitives.h"

#include <cstdint>
#include <utility>

#include "bench/meshes/generated_meshes.h"
#include "bench/meshes/portable_sincos.h"
#include "bench/meshes/surface_builder.h"

namespace touchmark::bench::scenes {

TriangleMesh facets_of(const RoundShape& shape) {
  if (shape.half_length == 0) return meshes::icosphere(3).transformed(shape.radius, Vec3::Zero());
  constexpr std::uint32_t around = 32, quarter = 8, rings = 2 * quarter + 1;
  meshes::Surface surface;
  meshes::add_patch(surface, around, rings, [&](double turn, double along) {
    // The lower hemisphere's rings, then the upper one's.
    const auto ring = static_cast<std::uint32_t>(along * rings + 0.5);
    const bool upper = ring > quarter;
    const double height = static_cast<double>(upper ? ring - quarter - 1 : ring) / quarter - (upper ? 0 : 1);
    const meshes::SinCos across = meshes::portable_sincos(turn), up = meshes::portable_sincos(height / 4);
    return Vec3(shape.radius * up.cos * across.cos, shape.radius * up.cos * across.sin,
                shape.radius * up.sin + (upper ? shape.half_length : -shape.half_length));
  });
  return std::move(surface).mesh();
}

}  // namespace touchmark::bench::scenes
