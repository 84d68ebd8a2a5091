/// The smallest sphere around points.
#pragma once

#include <span>

#include "core/probe.h"

namespace touchmark {

struct Sphere {
  Vec3 center = Vec3::Zero();
  double radius = 0;

  bool contains(const Vec3& point) const noexcept;
};

/// Holds every point (finite, at least one) for certain: the radius is the distance to the farthest one,
/// rounded up. It is the smallest to within a relative 1e-12, or an absolute 1e-15 of the coordinates'
/// spread. Time: linear in the points for each of about ten rounds. After Gaertner, "Fast and robust smallest
/// enclosing balls" (1999): the farthest point joins the support until none is outside.
Sphere smallest_sphere(std::span<const Vec3> points) noexcept;

/// The sphere about this centre that reaches the farthest of the points (finite, at least one), rounded up so
/// that it holds every one for certain.
Sphere sphere_about(const Vec3& center, std::span<const Vec3> points) noexcept;

}  // namespace touchmark
