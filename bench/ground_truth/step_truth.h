/// What is true at one step, for whoever shows single steps.
#pragma once

#include "core/probe.h"

namespace touchmark::bench::ground_truth {

struct StepTruth {
  bool known = false;  ///< computed: a contestant was judged there
  bool found = false;  ///< contact, within reach, a hit
  /// These say, where it is known and asked for a position, the nearest triangle's id, the distance and the
  /// point on it, also where that is out of reach. The distance is infinite where a coordinate is not finite.
  TriangleId triangle = 0;
  double distance = 0;
  Vec3 point = Vec3::Zero();
};

}  // namespace touchmark::bench::ground_truth
