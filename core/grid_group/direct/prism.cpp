#include "core/grid_group/direct/prism.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/grid_group/direct/wide_rows.h"
#include "core/simd/dispatch.h"

namespace touchmark::grid {

namespace portable {
namespace {
#include "core/grid_group/direct/prism_exclusion.inl"
}  // namespace
}  // namespace portable

#if TOUCHMARK_HAS_AVX2
TOUCHMARK_TARGET("avx2")
namespace avx2 {
namespace {
#include "core/grid_group/direct/prism_exclusion.inl"
}  // namespace
}  // namespace avx2
TOUCHMARK_END_TARGET

TOUCHMARK_TARGET("avx2,avx512f,avx512vl,avx512dq")
namespace avx512 {
namespace {
#include "core/grid_group/direct/prism_exclusion.inl"
}  // namespace
}  // namespace avx512
TOUCHMARK_END_TARGET

namespace {
const Simd widest = widest_simd();
}  // namespace
#endif

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
  set_ball_limits(face_frame, height, exclusion_margin);
}

void Prism::set_points(const FaceFrame& face_frame, double growth, double height,
                       const FilterFrame& frame) noexcept {
  const std::array<Vec3, 3> corner = face_frame.grown(growth);
  for (int i = 0; i <= cuts; ++i) {
    for (int j = 0; i + j <= cuts; ++j)
      base_[number(i, j)] = corner[0] + (i * (corner[1] - corner[0]) + j * (corner[2] - corner[0])) / cuts;
  }
  for (std::size_t k = 0; k < points; ++k) {
    const Vec3 p = base_[k % points_an_end] + (k < points_an_end ? -height : height) * face_frame.normal;
    points_.x[k] = static_cast<float>(p.x());
    points_.y[k] = static_cast<float>(p.y());
    points_.z[k] = static_cast<float>(p.z());
    points_.plane_error = std::max(points_.plane_error, frame.plane_error(p));
  }
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
    const double distance =
        std::sqrt(across[k] + height * height) + 4 * static_cast<double>(points_.plane_error);
    farthest_ = std::max(farthest_, distance);
    points_.limit[k] = points_.limit[k + points_an_end] = static_cast<float>(distance * distance);
  }
  // To lose by `exclusion_margin` at distance x, the square must lose by margin (2x + margin), wherever x is
  // in the prism.
  const auto pad = static_cast<float>(exclusion_margin * (2 * farthest_ + exclusion_margin));
  for (float& limit : points_.limit) limit = (limit + pad) * (1 + 0x1p-20f);
}

void Prism::set_ball_limits(const FaceFrame& face_frame, double height, double exclusion_margin) noexcept {
  // The whole prism as one part, its witness the incenter.
  const std::array<Vec3, 3> corner = {base_[number(0, 0)], base_[number(cuts, 0)], base_[number(0, cuts)]};
  double farthest = 0;
  for (const Vec3& c : corner) farthest = std::max(farthest, (c - face_frame.incenter).norm() + height);
  for (std::size_t i = 0; i < 6; ++i) {
    const Vec3 p = corner[i % 3] + (i < 3 ? -height : height) * face_frame.normal;
    const double distance = std::sqrt((p - face_frame.incenter).squaredNorm() +
                                      exclusion_margin * (2 * farthest + exclusion_margin));
    corner_limits_[i] = {static_cast<float>(p.x()), static_cast<float>(p.y()), static_cast<float>(p.z()),
                         static_cast<float>(distance + 4 * static_cast<double>(points_.plane_error))};
  }
}

namespace {

/// Asks about as many slots at a time as there are lanes.
template <std::size_t lanes, class Excluded>
unsigned in_lanes(const std::uint32_t* slots, const Excluded& excluded) noexcept {
  unsigned bits = 0;
  for (std::size_t at = 0; at < Prism::triangles_a_look; at += lanes) bits |= excluded(slots + at) << at;
  return bits;
}

}  // namespace

unsigned Prism::excluded(const std::uint32_t* slots, const TrianglePlanes* planes,
                         const TriangleBall* balls) const noexcept {
#if TOUCHMARK_HAS_AVX2
  if (widest == Simd::avx512) return avx512::excluded(points_, slots, planes, balls);
  if (widest == Simd::avx2) {
    return in_lanes<avx2::lanes>(
        slots, [&](const std::uint32_t* some) { return avx2::excluded(points_, some, planes, balls); });
  }
#endif
  return in_lanes<portable::lanes>(
      slots, [&](const std::uint32_t* some) { return portable::excluded(points_, some, planes, balls); });
}

}  // namespace touchmark::grid
