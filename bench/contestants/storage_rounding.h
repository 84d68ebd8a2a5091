/// How a contestant's library rounds the numbers that it keeps.
#pragma once

#include <functional>

#include "core/probe.h"

namespace touchmark::bench::contestants {

/// What storing makes of coordinates and lengths, in the mesh's frame and unit.
struct StorageRounding {
  std::function<Vec3(const Vec3&)> point;
  std::function<double(double)> length;
};

/// Returns the rounding of numbers that are kept in single precision as scale * (point - origin).
StorageRounding stored_in_single_precision(double scale, const Vec3& origin);

}  // namespace touchmark::bench::contestants
