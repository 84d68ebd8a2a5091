/// Bounds of the distance to the mesh by a look at one number: what is far need not be searched, and what
/// is near is searched no farther than it has to be.
///
/// The distance at p is that at a sampled point c, less |p - c| at most: it changes by no more than the point
/// moves. And it is at most |p - q|, where q is a point of the mesh that the sample found. Any sample will
/// do, so it does not matter which cell rounding takes a point to be in. All samples are taken at once, or
/// each when something is first asked near it.
#pragma once

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <concepts>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "core/aabb.h"
#include "core/probe.h"
#include "core/search/distance_field/sample_lattice.h"
#include "core/search/memory/lazy_construction.h"
#include "core/search/plane_filter/plane_filter.h"
#include "core/simd/lanes.h"

namespace touchmark {

/// A function that takes samples and knows the triangle it found near the last one, by a number.
template <class DistanceAt>
concept KnowsTriangles = requires(DistanceAt& distance_at, const Vec3& position, std::uint32_t near) {
  { distance_at.near() } -> std::same_as<std::uint32_t>;
  // Bounds the distance from above by that triangle, and starts the next sample with it.
  { distance_at.distance_to(near, position) } -> std::same_as<double>;
  // The vector to the point of the mesh that the last of these two, or the last sample, found.
  { distance_at.to_mesh() } -> std::convertible_to<Vec3>;
};

class DistanceField {
 public:
  struct Interval {
    double lower, upper;
  };

  DistanceField() = default;
  /// A lattice to be filled for so many triangles whose box this is, in the frame.
  DistanceField(const Eigen::Vector3f& min, const Eigen::Vector3f& max, std::size_t triangles);
  /// Returns a lattice to be filled for a mesh whose box this is. It stays empty, and nothing is known of it,
  /// where the mesh is so far from 0 that rounding a sample's position would count.
  static DistanceField around(const FilterFrame& frame, const Aabb& bounds, std::size_t triangles);
  /// What it takes when it is filled at once, at most.
  static std::size_t max_bytes(std::size_t triangles) noexcept {
    return std::max<std::size_t>(5 * triangles, 160);
  }
  /// What sampling may look at, in all: where a hierarchy is a poor fit, samples may cost no more than it
  /// did.
  static std::uint64_t max_work(std::size_t triangles) noexcept { return 1024 * std::uint64_t{triangles}; }

  /// Fills part after part, each by a function of its own: distance_at = sampler(share), `share` being the
  /// part's of the grid. distance_at(position, max_distance) bounds the distance at a point of the frame,
  /// which is at most the second, each bound within 2^-23. Where it gives up, by a negative one, so does the
  /// rest of the part: nothing is known there. Positions follow one another closely. Several threads, each
  /// with a function of its own, find the same as one. Upper bounds are known where samples know triangles
  /// (KnowsTriangles). Where more than `max_near` of the cubes have the mesh near, lower bounds reject
  /// nothing, and none are kept. These two are in distance_field_filling.h.
  template <class Sampler>
  void fill(const Sampler& sampler, unsigned threads, double max_near = 0.95);
  /// Leaves all of that to sample_near.
  void fill_lazily();
  bool is_lazy() const noexcept { return !unsampled_.empty(); }
  /// Takes a sample that says more of the point, by one call of distance_at, where fill_lazily left that to
  /// be done. Returns false where there is none, or nothing was left. Any thread may, at any time; what it
  /// finds is the same.
  template <class DistanceAt>
  bool sample_near(const FilterPoint& point, DistanceAt&& distance_at) const;
  /// After a part of the mesh has moved, within the lattice's box: fills anew, or leaves it to sample_near as
  /// before, where that can have been nearest or can be. `moved`, in the frame, hold what moved as it was and
  /// as it is.
  template <class Sampler>
  void refill(const Sampler& sampler, std::span<const Aabb> moved, unsigned threads);

  bool empty() const noexcept { return coarse_steps_.empty(); }
  /// Is a mesh of this box within the lattice's?
  bool holds(const FilterFrame& frame, const Aabb& bounds) const noexcept;

  /// Returns a lower bound of the distance: no part of the mesh is nearer. May be negative.
  float lower_bound(const FilterPoint& point) const noexcept;
  /// Is tight_lower_bound worth asking? Close to the mesh, by the sample that lower_bound asks, it says
  /// nothing.
  bool may_be_tighter(const FilterPoint& point) const noexcept;
  /// Returns a tighter lower bound from the 8 surrounding samples, at about twice the cost.
  float tight_lower_bound(const FilterPoint& point) const noexcept;
  /// Returns an upper bound of the distance, or infinity: some part of the mesh is at most this far.
  float upper_bound(const FilterPoint& point) const noexcept;
  std::size_t bytes() const noexcept {
    return fine_steps_.capacity() + coarse_steps_.capacity() + unsampled_.capacity() +
           to_mesh_.capacity() * sizeof(PackedVector);
  }

 private:
  using Step = std::uint8_t;
  using Cube = std::array<std::uint32_t, 3>;
  using SharedBytes = std::vector<SharedValue<std::uint8_t>>;
  /// Three coordinates as whole numbers of 16 bits: how often each has `vector_step_`.
  using PackedVector = std::uint64_t;
  static constexpr PackedVector no_vector = 0x8000'8000'8000'8000;
  static constexpr Step max_steps = 255;
  static constexpr std::uint8_t all_eighths = 255;

  /// More than all roundings between two points of the lattice's box, those of the double kernel included:
  /// docs/exactness.md, E13.
  static constexpr float plane_errors_of_pad = 4;

  static Lanes lanes_of(const FilterPoint& p) noexcept { return Lanes{p.x, p.y, p.z, 0}; }
  static float squared(Lanes v) noexcept {
    const Lanes squares = v * v;
    return squares[0] + squares[1] + squares[2];
  }
  /// Returns the root by one instruction: std::sqrt has errno to think of.
  static float root(float x) noexcept { return simd::sqrt(broadcast(x))[0]; }
  /// Returns at least the distance at a point this far from the lattice's box, in whose nearest point it is
  /// at least `within`.
  static float beyond_box(const FilterPoint& point, Lanes to_box, float within) noexcept;
  /// Room for the roundings of two samples' positions.
  static constexpr double sample_pad = 0x1p-20;
  /// Between samples: room for the rounding of a place, and more than twelve roundings of a sum.
  static constexpr float interpolation_pad = 0x1p-18F, sum_error = 0x1p-19F;
  /// Returns true away from the surface, where the eight samples of a coarse cube are what its own leaves of
  /// them: then even a point at the corner of a fine cube is known to be half a cube away.
  bool is_far(double distance) const noexcept { return distance > 2.5 * fine_.edge(); }
  /// The distance from the middle of a coarse cube to that of an eighth of it.
  double to_eighth() const noexcept { return 0.5 * std::sqrt(3.0) * fine_.edge() + sample_pad; }
  static Vec3 middle(const SampleLattice& lattice, std::uint32_t x, std::uint32_t y,
                     std::uint32_t z) noexcept {
    return {lattice.middle(0, x), lattice.middle(1, y), lattice.middle(2, z)};
  }
  /// Bounds the distance in the middle of a coarse cube from above, by what is known.
  double upper_bound_at(std::uint32_t cube) const noexcept {
    const Step steps = coarse_steps_[cube].load();
    return steps == max_steps ? std::numeric_limits<double>::infinity()
                              : static_cast<double>(steps) * static_cast<double>(step_);
  }
  void keep_to_mesh(std::uint32_t cube, const Vec3& to_mesh) const noexcept;
  struct CoarseSamples;
  template <class DistanceAt, class IsWanted>
  class Filler;
  template <class Sampler, class IsWanted>
  double fill_cubes(const Sampler& sampler, const IsWanted& is_wanted, unsigned threads);
  /// What a sample in the middle of a coarse cube says of it and of its eighths: x, y, z say which it is.
  void keep(std::uint32_t x, std::uint32_t y, std::uint32_t z, const Interval& distance) const noexcept;
  /// Which fine cube an eighth of a coarse one is.
  static Cube eighth_of(std::uint32_t x, std::uint32_t y, std::uint32_t z, std::uint32_t eighth) noexcept {
    return {2 * x + (eighth & 1), 2 * y + (eighth >> 1 & 1), 2 * z + (eighth >> 2)};
  }
  void keep_fine(const Cube& cube, Step steps) const noexcept {
    fine_steps_[fine_.index(cube[0], cube[1], cube[2])].store(steps);
  }

  Step steps_in(double distance) const noexcept {
    return static_cast<Step>(std::clamp(distance / static_cast<double>(step_), 0.0, double{max_steps}));
  }

  SampleLattice coarse_, fine_;
  float step_ = 1;          ///< a power of two: multiples are exact
  SharedBytes fine_steps_;  ///< the distance is at least so many steps; empty where that would reject nothing
  SharedBytes coarse_steps_;  ///< the distance is at most so many steps; the last value: nothing is known
  float vector_step_ = 1;     ///< a power of two
  /// By coarse cube, where samples know triangles: from its middle to a point of the mesh.
  std::vector<SharedValue<PackedVector>> to_mesh_;
  /// By coarse cube, with lazy construction: bits of the eighths of which nothing is known yet.
  SharedBytes unsampled_;
};

// Beyond the lattice's box, which is convex and holds the mesh, its nearest point q sees p and every point m
// of the mesh at an angle of at least 90 degrees: |p - m|^2 >= |p - q|^2 + |q - m|^2.
inline float DistanceField::beyond_box(const FilterPoint& p, Lanes to_box, float within) noexcept {
  const float beyond = squared(to_box);
  if (beyond == 0) return within - plane_errors_of_pad * p.plane_error;
  const float inside = std::max(within, 0.0F);
  return root(beyond + inside * inside) - plane_errors_of_pad * p.plane_error;
}

inline float DistanceField::lower_bound(const FilterPoint& p) const noexcept {
  if (fine_steps_.empty()) return 0;
  const Lanes point = lanes_of(p), nearest = fine_.clamped(point);
  const LaneBits cube = fine_.cube_of(nearest);
  const float steps = static_cast<float>(fine_steps_[fine_.index(cube)].load());
  const float within = steps * step_ - root(squared(nearest - fine_.middle(cube)));
  return beyond_box(p, point - nearest, within);
}

inline bool DistanceField::may_be_tighter(const FilterPoint& p) const noexcept {
  constexpr float min_in_edges = 0.5F;
  if (fine_steps_.empty()) return false;
  const float steps = static_cast<float>(fine_steps_[fine_.index(fine_.cube_of(lanes_of(p)))].load());
  return steps * step_ >= min_in_edges * fine_.edge();
}

// The numbers of a packed vector are rounded, by 0.87 steps in all. A step has room for them and for what
// rounds here.
inline float DistanceField::upper_bound(const FilterPoint& p) const noexcept {
  using Numbers [[gnu::vector_size(8)]] = std::int16_t;
  if (to_mesh_.empty()) return std::numeric_limits<float>::infinity();
  const Lanes point = lanes_of(p);
  const LaneBits cube = coarse_.cube_of(point);
  const PackedVector packed = to_mesh_[coarse_.index(cube)].load();
  if (packed == no_vector) return std::numeric_limits<float>::infinity();
  const Lanes numbers =
      __builtin_convertvector(__builtin_convertvector(std::bit_cast<Numbers>(packed), LaneBits), Lanes);
  const Lanes to_mesh = numbers * vector_step_;
  const float pad = vector_step_ + plane_errors_of_pad * p.plane_error;
  return root(squared(point - coarse_.middle(cube) - to_mesh)) + pad;
}

inline void DistanceField::keep(std::uint32_t x, std::uint32_t y, std::uint32_t z,
                                const Interval& distance) const noexcept {
  coarse_steps_[coarse_.index(x, y, z)].store(steps_in(distance.upper + step_));
  const Step lower = steps_in(distance.lower - to_eighth());
  for (std::uint32_t eighth = 0; eighth < 8; ++eighth) keep_fine(eighth_of(x, y, z, eighth), lower);
}

inline void DistanceField::keep_to_mesh(std::uint32_t cube, const Vec3& to_mesh) const noexcept {
  PackedVector packed = 0;
  for (int k = 0; k < 3; ++k) {
    const auto number =
        static_cast<std::int16_t>(std::lround(to_mesh[k] / static_cast<double>(vector_step_)));
    packed |= PackedVector{static_cast<std::uint16_t>(number)} << (16 * k);
  }
  to_mesh_[cube].store(packed);
}

inline void DistanceField::fill_lazily() {
  coarse_steps_ = SharedBytes(coarse_.size(), max_steps);
  to_mesh_.assign(coarse_.size(), no_vector);
  fine_steps_ = SharedBytes(fine_.size(), 0);
  unsampled_ = SharedBytes(coarse_.size(), all_eighths);
}

/// Samples the middle of a coarse cube first, then, where that is near, the middle of the eighth.
template <class DistanceAt>
bool DistanceField::sample_near(const FilterPoint& p, DistanceAt&& distance_at) const {
  if (unsampled_.empty()) return false;
  const LaneBits fine_cube = fine_.cube_of(lanes_of(p));
  const auto i = static_cast<std::uint32_t>(fine_cube[0]), j = static_cast<std::uint32_t>(fine_cube[1]),
             k = static_cast<std::uint32_t>(fine_cube[2]);
  const std::uint32_t x = i / 2, y = j / 2, z = k / 2, cube = coarse_.index(x, y, z);
  const std::uint8_t unsampled = unsampled_[cube].load();
  const auto bit = static_cast<std::uint8_t>(1U << ((i & 1) | (j & 1) << 1 | (k & 1) << 2));
  if ((unsampled & bit) == 0) return false;
  if (unsampled == all_eighths && coarse_steps_[cube].load() == max_steps) {
    const Interval distance = distance_at(middle(coarse_, x, y, z), std::numeric_limits<double>::infinity());
    if (distance.lower >= 0) {
      keep(x, y, z, distance);
      if constexpr (KnowsTriangles<DistanceAt>) keep_to_mesh(cube, distance_at.to_mesh());
    }
    // A cube about which nothing was found out is not asked for again.
    if (distance.lower < 0 || is_far(distance.lower)) unsampled_[cube].clear(all_eighths);
    return distance.lower >= 0;
  }
  const double lower = distance_at(middle(fine_, i, j, k), upper_bound_at(cube) + to_eighth()).lower;
  unsampled_[cube].clear(bit);
  if (lower < 0) return false;
  keep_fine({i, j, k}, steps_in(lower));
  return true;
}

}  // namespace touchmark
