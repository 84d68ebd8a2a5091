// What a session remembers of touches must not stand for the nearest.
#pragma once

#include <optional>

#include <gtest/gtest.h>

#include "core/probe.h"

namespace touchmark::test {

/// Of a mesh at this distance, above 0, from the centre: touches it with radii on either side of that, the
/// last one content with what is farther, and asks for the nearest.
template <class Detector>
std::optional<Contact> nearest_after_touches(const Detector& detector, const Vec3& center, double distance,
                                             typename Detector::Session& session) {
  EXPECT_TRUE(detector.touches({center, 3 * distance + 0.1}, session)) << center.transpose();
  EXPECT_TRUE(detector.touches({center, distance * (1 + 1e-9)}, session)) << center.transpose();
  EXPECT_FALSE(detector.touches({center, distance * (1 - 1e-9)}, session)) << center.transpose();
  EXPECT_TRUE(detector.touches({center, 2 * distance}, session)) << center.transpose();
  return detector.nearest({center, 0}, 1.5 * distance, session);
}

}  // namespace touchmark::test
