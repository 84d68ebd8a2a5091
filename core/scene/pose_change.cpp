// What a move computes, for four numbers at once where the processor can: docs/exactness.md, E27 and E29.
#include "core/scene/pose_change.h"

#include <array>
#include <cmath>
#include <cstddef>

#include "core/float_limits.h"
#include "core/simd/target.h"

#if TOUCHMARK_HAS_AVX2
#include <immintrin.h>
#endif

namespace touchmark {
namespace {

/// Lengths that a change is made of, rounded.
struct Lengths {
  double turn;    ///< Frobenius' norm of the rotations' difference
  double center;  ///< how far the ball's centre moves
  double shift;   ///< sum of the absolute coordinates of the translations' difference
  double off;     ///< Frobenius' norm of R^T R - I of the new rotation
};

/// A point x of the ball about c moves by R' x + t' - R x - t = (R' - R) (x - c) + (R' - R) c + t' - t.
PoseChange change_of(const Lengths& lengths, const ShapeBall& ball) noexcept {
  // Each difference is off by one rounding of itself, the product by three and the sum by one of its terms. A
  // sum of absolute values is no less than the norm, and takes no root.
  const double rounding =
      8 * unit_roundoff * (lengths.turn * (ball.center_size + ball.radius) + lengths.shift);
  PoseChange change;
  change.motion = (lengths.center + lengths.turn * ball.radius) * (1 + 16 * unit_roundoff) + rounding;
  change.rigid = 1.01 * lengths.off + 16 * unit_roundoff;  // as rigid_error has it
  // What is less than 1 from a rotation is no reflection: on the way to it no singular value becomes 0. A
  // motion that is finite is of finite numbers.
  change.is_rigid = change.rigid <= max_rigid_error && lengths.turn < 0.5 && change.motion < 0x1p500;
  return change;
}

/// Has the order of sums of the wide one.
Lengths portable_lengths(const Pose& from, const Pose& to, const Vec3& center) noexcept {
  std::array<double, 3> turned, moved, shifted;
  for (int k = 0; k < 3; ++k) {
    const auto i = static_cast<std::size_t>(k);
    const double x = to.rotation(k, 0) - from.rotation(k, 0), y = to.rotation(k, 1) - from.rotation(k, 1),
                 z = to.rotation(k, 2) - from.rotation(k, 2), t = to.translation[k] - from.translation[k];
    const double of_center = x * center[0] + y * center[1] + z * center[2] + t;
    turned[i] = x * x + y * y + z * z;
    moved[i] = of_center * of_center;
    shifted[i] = std::abs(t);
  }
  const auto product = [&](int a, int b) {
    const Eigen::Matrix3d& r = to.rotation;
    return r(0, a) * r(0, b) + r(1, a) * r(1, b) + r(2, a) * r(2, b);
  };
  const double xx = product(0, 0) - 1, yy = product(1, 1) - 1, zz = product(2, 2) - 1;
  const double xy = product(0, 1), yz = product(1, 2), zx = product(2, 0);
  return {std::sqrt(turned[0] + turned[1] + turned[2]), std::sqrt(moved[0] + moved[1] + moved[2]),
          shifted[0] + shifted[1] + shifted[2],
          std::sqrt(xx * xx + yy * yy + (zz * zz + 2 * (xy * xy)) + 2 * (yz * yz + zx * zx))};
}

#if TOUCHMARK_HAS_AVX2
TOUCHMARK_TARGET("avx2")
/// Four rows of numbers, of which each becomes a lane of all.
struct Transposed {
  __m256d lane[4];

  Transposed(__m256d a, __m256d b, __m256d c, __m256d d) noexcept {
    const __m256d low = _mm256_unpacklo_pd(a, b), high = _mm256_unpackhi_pd(a, b);
    const __m256d other_low = _mm256_unpacklo_pd(c, d), other_high = _mm256_unpackhi_pd(c, d);
    lane[0] = _mm256_permute2f128_pd(low, other_low, 0x20);
    lane[1] = _mm256_permute2f128_pd(high, other_high, 0x20);
    lane[2] = _mm256_permute2f128_pd(low, other_low, 0x31);
    lane[3] = _mm256_permute2f128_pd(high, other_high, 0x31);
  }
};

/// The twelve numbers of a pose lie one after the other, so a vector that begins with a column of the
/// rotation ends with a number that does not belong to it: no sum has that in.
Lengths wide_lengths(const Pose& from, const Pose& to, const Vec3& center) noexcept {
  static_assert(sizeof(Pose) == 12 * sizeof(double));
  const double* const before = from.rotation.data();
  const double* const after = to.rotation.data();
  const __m256d x = _mm256_loadu_pd(after), y = _mm256_loadu_pd(after + 3), z = _mm256_loadu_pd(after + 6);
  const __m256d dx = x - _mm256_loadu_pd(before), dy = y - _mm256_loadu_pd(before + 3),
                dz = z - _mm256_loadu_pd(before + 6);
  constexpr int next_lanes = 0x39;
  const __m256d shift =
      _mm256_permute4x64_pd(_mm256_loadu_pd(after + 8) - _mm256_loadu_pd(before + 8), next_lanes);
  const __m256d of_center = dx * _mm256_set1_pd(center[0]) + dy * _mm256_set1_pd(center[1]) +
                            dz * _mm256_set1_pd(center[2]) + shift;
  const __m256d xx = x * x, yy = y * y, zz = z * z, xy = x * y, yz = y * z, zx = z * x;
  const Transposed products(xx, yy, zz, xy), others(yz, zx, yz, zx);
  const __m256d off = products.lane[0] + products.lane[1] + products.lane[2] - _mm256_setr_pd(1, 1, 1, 0);
  const __m256d other_off = others.lane[0] + others.lane[1] + others.lane[2];
  const __m256d other_squares = other_off * other_off;
  const Transposed squares(dx * dx + dy * dy + dz * dz, of_center * of_center,
                           _mm256_andnot_pd(_mm256_set1_pd(-0.0), shift),
                           off * off * _mm256_setr_pd(1, 1, 1, 2));
  constexpr int last_lane = 8;
  const __m256d none = _mm256_setzero_pd();
  const __m256d last = _mm256_blend_pd(none, squares.lane[3], last_lane);
  const __m256d rest =
      _mm256_blend_pd(none, _mm256_set1_pd(2 * (other_squares[0] + other_squares[1])), last_lane);
  const __m256d sums = squares.lane[0] + squares.lane[1] + (squares.lane[2] + last) + rest;
  const __m256d roots = _mm256_sqrt_pd(sums);
  return {roots[0], roots[1], sums[2], roots[3]};
}

PoseChange wide_change(const Pose& from, const Pose& to, const ShapeBall& ball) noexcept {
  return change_of(wide_lengths(from, to, ball.center), ball);
}
TOUCHMARK_END_TARGET
#endif

}  // namespace

PoseChange pose_change(const Pose& from, const Pose& to, const ShapeBall& ball, Simd simd) noexcept {
#if TOUCHMARK_HAS_AVX2
  if (simd != Simd::portable) return wide_change(from, to, ball);
#endif
  static_cast<void>(simd);
  return change_of(portable_lengths(from, to, ball.center), ball);
}

}  // namespace touchmark
