#include "core/aabb.h"

#include <algorithm>

namespace touchmark {

double Aabb::diagonal() const noexcept { return extent().norm(); }

double Aabb::squared_distance(const Vec3& point) const noexcept { return excess(point).squaredNorm(); }

bool any_within(std::span<const Aabb> boxes, const Vec3& point, double distance) noexcept {
  return std::any_of(boxes.begin(), boxes.end(),
                     [&](const Aabb& box) { return box.squared_distance(point) <= distance * distance; });
}

}  // namespace touchmark
