#include "core/grid_group/direct/prism.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

namespace touchmark::grid {

FaceFrame::FaceFrame(const PreparedTriangle& triangle, const FilterFrame& frame) noexcept
    : normal(triangle.normal) {
  for (std::size_t i = 0; i < 3; ++i) corner[i] = frame.to_frame(triangle.corner[i]);
  const Vec3 to1 = corner[1] - corner[0], to2 = corner[2] - corner[0];
  const std::array<double, 3> opposite = {(to2 - to1).norm(), to2.norm(), to1.norm()};
  const double perimeter = opposite[0] + opposite[1] + opposite[2];
  const double twice_area = to1.cross(to2).norm();
  for (std::size_t i = 0; i < 3; ++i) incenter_weights[i] = opposite[i] / perimeter;
  incenter = corner[0] + incenter_weights[1] * to1 + incenter_weights[2] * to2;
  inradius = twice_area / perimeter;
  size = std::sqrt(twice_area);
}

std::array<Vec3, 3> FaceFrame::grown(double growth) const noexcept {
  std::array<Vec3, 3> out;
  for (std::size_t i = 0; i < 3; ++i) out[i] = incenter + (1 + growth) * (corner[i] - incenter);
  return out;
}

Prism::Prism(const FaceFrame& face_frame, double growth, double height, double exclusion_margin,
             const FilterFrame& frame) noexcept {
  set_points(face_frame, growth, height, frame);
  set_limits(face_frame, growth, height, exclusion_margin);
  set_corners(face_frame, height, exclusion_margin);
}

void Prism::set_points(const FaceFrame& face_frame, double growth, double height,
                       const FilterFrame& frame) noexcept {
  const std::array<Vec3, 3> corner = face_frame.grown(growth);
  for (int i = 0; i <= cuts; ++i)
    for (int j = 0; i + j <= cuts; ++j)
      base_[number(i, j)] = corner[0] + (i * (corner[1] - corner[0]) + j * (corner[2] - corner[0])) / cuts;
  for (std::size_t k = 0; k < point_count; ++k) {
    const Vec3 p = base_[k % points_an_end] + (k < points_an_end ? -height : height) * face_frame.normal;
    plane_error_ = std::max(plane_error_, frame.plane_error(p));
    points_[k].at = {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()), 0};
    radius_ = std::max(radius_, (p - face_frame.incenter).norm());
  }
  for (bvh::LimitedPoint& point : points_) point.at.plane_error = plane_error_;
}

void Prism::set_limits(const FaceFrame& face_frame, double growth, double height,
                       double exclusion_margin) noexcept {
  // A part's witness is the point of the triangle near its middle. The greatest limit of the parts that meet
  // in a point decides there, the same at both ends.
  std::array<double, points_an_end> across{};
  const auto part = [&](std::array<std::array<int, 2>, 3> corners) {
    std::array<double, 3> weights{};
    for (const auto& [i, j] : corners) {
      const std::array<int, 3> steps = {cuts - i - j, i, j};
      for (std::size_t k = 0; k < 3; ++k) weights[k] += static_cast<double>(steps[k]) / (3 * cuts);
    }
    double sum = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      weights[k] = std::max((1 + growth) * weights[k] - growth * face_frame.incenter_weights[k], 0.0);
      sum += weights[k];
    }
    const Vec3 witness = (weights[0] * face_frame.corner[0] + weights[1] * face_frame.corner[1] +
                          weights[2] * face_frame.corner[2]) /
                         sum;
    for (const auto& [i, j] : corners) {
      double& farthest = across[number(i, j)];
      farthest = std::max(farthest, (base_[number(i, j)] - witness).squaredNorm());
    }
  };
  for (int i = 0; i < cuts; ++i) {
    for (int j = 0; i + j < cuts; ++j) {
      part({{{i, j}, {i + 1, j}, {i, j + 1}}});
      if (i + j + 1 < cuts) part({{{i + 1, j}, {i, j + 1}, {i + 1, j + 1}}});
    }
  }
  for (std::size_t k = 0; k < points_an_end; ++k) {
    const double distance = std::sqrt(across[k] + height * height) + 4 * static_cast<double>(plane_error_);
    farthest_ = std::max(farthest_, distance);
    points_[k].limit = points_[k + points_an_end].limit = static_cast<float>(distance * distance);
  }
  // To lose by `exclusion_margin` at distance x, the square must lose by margin (2x + margin), wherever x is
  // in the prism.
  const auto pad = static_cast<float>(exclusion_margin * (2 * farthest_ + exclusion_margin));
  for (bvh::LimitedPoint& point : points_) point.limit = (point.limit + pad) * (1 + 0x1p-20f);
}

void Prism::set_corners(const FaceFrame& face_frame, double height, double exclusion_margin) noexcept {
  // The whole prism as one part, its witness the incenter.
  const double margin = exclusion_margin * (2 * radius_ + exclusion_margin);
  for (std::size_t i = 0; i < 6; ++i) {
    const std::array<std::size_t, 3> numbers = {number(0, 0), number(cuts, 0), number(0, cuts)};
    const std::size_t at = numbers[i % 3];
    const double squared = (base_[at] - face_frame.incenter).squaredNorm() + height * height;
    const double distance = std::sqrt(squared + margin) + 4 * static_cast<double>(plane_error_);
    corners_[i] = {points_[i < 3 ? at : at + points_an_end].at,
                   static_cast<float>(distance * distance) * (1 + 0x1p-20F)};
  }
}

}  // namespace touchmark::grid
