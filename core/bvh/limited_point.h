/// A point of the tree's frame, and how far from it something matters.
#pragma once

#include "core/search/plane_filter/plane_filter.h"

namespace touchmark::bvh {

struct LimitedPoint {
  FilterPoint at;
  float limit;  ///< squared
};

}  // namespace touchmark::bvh
