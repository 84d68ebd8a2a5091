#include "core/scene/support_table.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace touchmark {
namespace {

constexpr double unit_roundoff = std::numeric_limits<double>::epsilon() / 2;

/// Returns a float that is no less than x.
float raised_to_float(double x) noexcept {
  const auto near = static_cast<float>(x);
  return static_cast<double>(near) >= x ? near : std::nextafter(near, std::numeric_limits<float>::infinity());
}

}  // namespace

SupportTable::SupportTable(std::span<const Vec3> points, const Vec3& center, double radius, double beyond)
    : pad_(64 * unit_roundoff * (radius + beyond)) {
  for (int axis = 0; axis < 3; ++axis) {
    const int u = (axis + 1) % 3, v = (axis + 2) % 3;
    for (std::size_t i = 0; i < places; ++i) {
      for (std::size_t j = 0; j < places; ++j) {
        const double a = coordinate(i), b = coordinate(j);
        double least = std::numeric_limits<double>::infinity(), greatest = -least;
        for (const Vec3& point : points) {
          const double along =
              (point[axis] - center[axis]) + a * (point[u] - center[u]) + b * (point[v] - center[v]);
          least = std::min(least, along);
          greatest = std::max(greatest, along);
        }
        // The direction is up to 3 long, and the sum off by five roundings.
        const double farther = beyond * std::sqrt(1 + a * a + b * b) + pad_;
        auto& [positive, negative] = faces_[static_cast<std::size_t>(axis)];
        positive[i][j] = raised_to_float(greatest + farther);
        // Of the opposite direction, whose coordinates are the other way round.
        negative[places - 1 - i][places - 1 - j] = raised_to_float(-least + farther);
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
