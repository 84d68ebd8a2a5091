#include "core/auto/overlap.h"

#include <algorithm>
#include <cstddef>

namespace touchmark {
namespace {

constexpr std::size_t most_boxes = 2048, most_middles = 64;

/// The box of a triangle, closed.
struct TriangleBox {
  TriangleBox(const TriangleMesh& mesh, std::size_t i)
      : min(mesh.corner(i, 0).cwiseMin(mesh.corner(i, 1)).cwiseMin(mesh.corner(i, 2))),
        max(mesh.corner(i, 0).cwiseMax(mesh.corner(i, 1)).cwiseMax(mesh.corner(i, 2))) {}

  bool holds(const Vec3& point) const {
    return (min.array() <= point.array()).all() && (point.array() <= max.array()).all();
  }

  Vec3 min, max;
};

}  // namespace

double overlap_of(const TriangleMesh& mesh) {
  const std::size_t boxes = std::min(mesh.size(), most_boxes), middles = std::min(mesh.size(), most_middles);
  std::size_t held = 0, asked = 0;
  for (std::size_t b = 0; b < boxes; ++b) {
    const std::size_t other = b * mesh.size() / boxes;
    const TriangleBox box(mesh, other);
    for (std::size_t m = 0; m < middles; ++m) {
      const std::size_t one = m * mesh.size() / middles;
      if (one == other) continue;
      ++asked;
      const Vec3 middle = mesh.corner(one, 0) / 3 + mesh.corner(one, 1) / 3 + mesh.corner(one, 2) / 3;
      if (box.holds(middle)) ++held;
    }
  }
  return asked > 0 ? static_cast<double>(held) / static_cast<double>(asked) : 0;
}

}  // namespace touchmark
