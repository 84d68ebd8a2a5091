#include "core/scene/round/support_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "core/float_limits.h"
#include "core/geometry/float_rounding.h"

namespace touchmark {

SupportTable::SupportTable(std::span<const Vec3> points, const Vec3& center, double radius, double beyond)
    : pad_(64 * unit_roundoff * (radius + beyond)) {
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    // All places at once for each point, of which there may be many.
    std::array<std::array<double, places>, places> least, greatest;
    for (std::size_t i = 0; i < places; ++i) {
      least[i].fill(std::numeric_limits<double>::infinity());
      greatest[i].fill(-std::numeric_limits<double>::infinity());
    }
    for (const Vec3& point : points) {
      for (std::size_t i = 0; i < places; ++i) {
        const double part = (point[axis] - center[axis]) + coordinate(i) * (point[u] - center[u]);
        for (std::size_t j = 0; j < places; ++j) {
          const double along = part + coordinate(j) * (point[v] - center[v]);
          least[i][j] = std::min(least[i][j], along);
          greatest[i][j] = std::max(greatest[i][j], along);
        }
      }
    }
    auto& [positive, negative] = faces_[static_cast<std::size_t>(axis)];
    for (std::size_t i = 0; i < places; ++i) {
      for (std::size_t j = 0; j < places; ++j) {
        const double a = coordinate(i), b = coordinate(j);
        // The direction is up to 3 long, and the sum off by five roundings.
        const double farther = beyond * std::sqrt(1 + a * a + b * b) + pad_;
        positive[i][j] = rounded_up(greatest[i][j] + farther);
        // The opposite direction's coordinates are the other way round.
        negative[places - 1 - i][places - 1 - j] = rounded_up(-least[i][j] + farther);
      }
    }
  }
}

double SupportTable::along(const Vec3& direction) const noexcept {
  int axis = 0;
  const double length = direction.cwiseAbs().maxCoeff(&axis);
  if (!(length > 0)) return std::numeric_limits<double>::infinity();
  const Face& face = faces_[static_cast<std::size_t>(axis)][direction[axis] > 0 ? 0 : 1];
  const auto cell = [&](int k, std::size_t& first) {
    const double at = (0.5 * static_cast<double>(cells)) * (1 + direction[k] / length);
    first = std::min(static_cast<std::size_t>(at), cells - 1);
    return at - static_cast<double>(first);
  };
  std::size_t i, j;
  const double a = cell((axis + 1) % 3, i), b = cell((axis + 2) % 3, j);
  const auto between = [](double from, double to, double part) { return (1 - part) * from + part * to; };
  const double low = between(face[i][j], face[i][j + 1], b);
  const double high = between(face[i + 1][j], face[i + 1][j + 1], b);
  return length * between(low, high, a) + pad_;
}

}  // namespace touchmark
