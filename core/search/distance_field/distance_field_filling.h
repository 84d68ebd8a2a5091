/// How a distance field takes all its samples at once, by any number of threads. For those who build
/// detectors.
#pragma once

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <type_traits>
#include <vector>

#include "core/search/distance_field/distance_field.h"
#include "core/search/threads/parallel.h"

namespace touchmark {

/// What is known of the middles of coarse cubes while a field is filled.
struct DistanceField::CoarseSamples {
  explicit CoarseSamples(std::size_t cubes) : lower(cubes, -1), near(cubes, 0) {}

  /// Returns which part of the cubes that are known has the mesh near.
  double part_near(const DistanceField& field) const noexcept {
    std::size_t known = 0, far = 0;
    for (const double one : lower) {
      if (one < 0) continue;
      ++known;
      if (field.is_far(one)) ++far;
    }
    return known > 0 ? static_cast<double>(known - far) / static_cast<double>(known) : 0;
  }

  /// Counts the eighths of some inner cubes, and those of them that tell more than that the mesh is near.
  void note_inner(bool tells) noexcept {
    inner_.fetch_add(1, std::memory_order_relaxed);
    if (tells) telling_.fetch_add(1, std::memory_order_relaxed);
  }
  /// Do the eighths of inner cubes tell enough to be sampled? By far fewer do where the mesh fills its box.
  bool inner_eighths_pay() const noexcept {
    constexpr double least = 0.1;
    return static_cast<double>(telling_.load()) >= least * static_cast<double>(inner_.load());
  }

  std::vector<double> lower;        ///< bounds the distance from below; negative: nothing is known
  std::vector<std::uint32_t> near;  ///< a triangle near there, where samples know one

 private:
  std::atomic<std::uint32_t> inner_ = 0, telling_ = 0;
};

/// In which order the samples are taken: those of every other cube along each axis first, then those halfway
/// between two of them along x, y and z, and last the eighths of what is near: where cubes that are not lie
/// around, and of some inner cubes, whose eighths show whether those of the others pay.
enum class FillingPass { every_other, between_x, between_y, between_z, outer_eighths, inner_eighths };

/// Takes samples with one function of its own.
///
/// The square of the distance, less the square of the position, is concave: it is the least of functions that
/// are linear. So it is at least what lies linearly between samples around a point: with t of the way from
/// one sample to the next, that is t (1 - t) of the square of that way less for the square of the distance.
/// No search is needed where that is nearly what a triangle near there shows.
template <class DistanceAt, class IsWanted>
class DistanceField::Filler {
 public:
  Filler(const DistanceField& field, CoarseSamples& samples, DistanceAt& distance_at,
         const IsWanted& is_wanted) noexcept
      : field_(field), samples_(samples), distance_at_(distance_at), is_wanted_(is_wanted) {}

  /// Returns false where the function gave up.
  bool fill_row(FillingPass pass, std::uint32_t y, std::uint32_t z, bool backwards) {
    const std::uint32_t count = field_.coarse_.count(0);
    const bool skips = pass == FillingPass::every_other || pass == FillingPass::between_x;
    const std::uint32_t first = pass == FillingPass::between_x ? 1 : 0, step = skips ? 2 : 1;
    const std::uint32_t cubes = (count - first + step - 1) / step;
    for (std::uint32_t i = 0; i < cubes; ++i) {
      const Cube cube{first + step * (backwards ? cubes - 1 - i : i), y, z};
      if (!is_wanted_(index(cube))) continue;
      const bool takes_eighths = pass >= FillingPass::outer_eighths;
      if (!(takes_eighths ? fill_eighths(cube, pass) : fill_middle(cube, pass))) return false;
    }
    return true;
  }

 private:
  static constexpr bool knows_triangles = KnowsTriangles<DistanceAt>;
  /// A bound from below is good enough at this part of one from above.
  static constexpr double close_enough = 0.8;
  /// In fine edges: what is nearer says next to nothing about the points around it.
  static constexpr double too_near = 0.4;
  /// In fine edges: what is farther rejects much of what is asked in the eighth.
  static constexpr double telling = 0.5;

  std::uint32_t index(const Cube& cube) const noexcept {
    return field_.coarse_.index(cube[0], cube[1], cube[2]);
  }
  static Vec3 middle_of(const SampleLattice& lattice, const Cube& cube) noexcept {
    return middle(lattice, cube[0], cube[1], cube[2]);
  }
  /// Bounds the distance from below by the square of it that lies between samples.
  static double root_of(double squared) noexcept { return std::sqrt(std::max(squared, 0.0)) - sample_pad; }

  /// Looks halfway between two neighbours; nothing is known, and the lower bound is negative, where that is
  /// not good enough.
  Interval between(const Cube& cube, std::size_t axis, std::uint32_t& near) requires knows_triangles {
    constexpr Interval unknown{-1, -1};
    if (cube[axis] + 1 == field_.coarse_.count(static_cast<int>(axis))) return unknown;
    Cube before = cube, after = cube;
    --before[axis];
    ++after[axis];
    const double a = samples_.lower[index(before)], b = samples_.lower[index(after)];
    if (a < 0 || b < 0) return unknown;
    const double edge = field_.coarse_.edge(), lower = root_of(0.5 * (a * a + b * b) - edge * edge);
    near = samples_.near[index(a < b ? before : after)];
    const double upper = distance_at_.distance_to(near, middle_of(field_.coarse_, cube));
    return lower >= close_enough * upper ? Interval{lower, upper} : unknown;
  }

  bool fill_middle(const Cube& cube, FillingPass pass) {
    const Vec3 position = middle_of(field_.coarse_, cube);
    Interval found{-1, -1};
    std::uint32_t near = 0;
    if constexpr (knows_triangles) {
      if (pass != FillingPass::every_other) found = between(cube, static_cast<std::size_t>(pass) - 1, near);
    }
    if (found.lower < 0) {
      found = distance_at_(position, upper_ + (position - last_).norm() + sample_pad);
      if (found.lower < 0) return false;
      if constexpr (knows_triangles) near = distance_at_.near();
    }
    samples_.lower[index(cube)] = found.lower;
    samples_.near[index(cube)] = near;
    if constexpr (knows_triangles) field_.keep_to_mesh(index(cube), distance_at_.to_mesh());
    last_ = position;
    upper_ = found.upper;
    field_.keep(cube[0], cube[1], cube[2], found);
    return true;
  }

  /// Bounds the distance in the middle of an eighth from below by the samples of the eight cubes around it;
  /// negative where one of them is not known.
  double between_eight(const Cube& cube, std::uint32_t eighth) const noexcept {
    std::array<std::uint32_t, 3> other;
    for (std::size_t axis = 0; axis < 3; ++axis) {
      const bool up = (eighth >> axis & 1) != 0;
      if (up ? cube[axis] + 1 == field_.coarse_.count(static_cast<int>(axis)) : cube[axis] == 0) return -1;
      other[axis] = up ? cube[axis] + 1 : cube[axis] - 1;
    }
    double sum = 0;
    for (std::uint32_t corner = 0; corner < 8; ++corner) {
      Cube at = cube;
      double weight = 1;
      for (std::size_t axis = 0; axis < 3; ++axis) {
        const bool is_other = (corner >> axis & 1) != 0;
        if (is_other) at[axis] = other[axis];
        weight *= is_other ? 0.25 : 0.75;
      }
      const double lower = samples_.lower[index(at)];
      if (lower < 0) return -1;
      sum += weight * (lower * lower);
    }
    const double edge = field_.coarse_.edge();
    return root_of(sum - 3 * (0.25 * 0.75) * (edge * edge));
  }

  /// Is the mesh near all cubes around this one, too?
  bool is_inner(const Cube& cube) const noexcept {
    for (std::size_t axis = 0; axis < 3; ++axis)
      if (cube[axis] == 0 || cube[axis] + 1 == field_.coarse_.count(static_cast<int>(axis))) return false;
    for (std::uint32_t z = cube[2] - 1; z <= cube[2] + 1; ++z) {
      for (std::uint32_t y = cube[1] - 1; y <= cube[1] + 1; ++y) {
        for (std::uint32_t x = cube[0] - 1; x <= cube[0] + 1; ++x) {
          const double lower = samples_.lower[index({x, y, z})];
          if (lower < 0 || field_.is_far(lower)) return false;
        }
      }
    }
    return true;
  }
  /// An eighth of the cubes, evenly.
  static bool shows_for_others(const Cube& cube) noexcept {
    return (cube[0] & 1) == 0 && (cube[1] & 1) == 0 && (cube[2] & 1) == 0;
  }

  bool fill_eighths(const Cube& cube, FillingPass pass) {
    const double lower = samples_.lower[index(cube)];
    if (lower < 0) return true;
    if (field_.is_far(lower)) {
      if (pass == FillingPass::outer_eighths) fill_far_eighths(cube, lower);
      return true;
    }
    const bool inner = is_inner(cube), shows = inner && shows_for_others(cube);
    if ((pass == FillingPass::inner_eighths) != (inner && !shows)) return true;
    const double edge{field_.fine_.edge()},
        farthest = field_.upper_bound_at(index(cube)) + field_.to_eighth();
    for (std::uint32_t eighth = 0; eighth < 8; ++eighth) {
      const double found = near_eighth(cube, eighth, farthest);
      if (found < 0) return false;
      if (shows) samples_.note_inner(found > telling * edge);
      if (found > 0) field_.keep_fine(eighth_of(cube[0], cube[1], cube[2], eighth), field_.steps_in(found));
    }
    return true;
  }

  void fill_far_eighths(const Cube& cube, double lower) const noexcept {
    for (std::uint32_t eighth = 0; eighth < 8; ++eighth) {
      const double found = between_eight(cube, eighth);
      if (found > lower - field_.to_eighth())
        field_.keep_fine(eighth_of(cube[0], cube[1], cube[2], eighth), field_.steps_in(found));
    }
  }

  /// Bounds the distance in the middle of an eighth from below, without a search where that is enough. 0
  /// where it would tell next to nothing, and negative where the function gave up.
  double near_eighth(const Cube& cube, std::uint32_t eighth, double farthest) {
    const Vec3 position = middle_of(field_.fine_, eighth_of(cube[0], cube[1], cube[2], eighth));
    if constexpr (knows_triangles) {
      const double upper = distance_at_.distance_to(samples_.near[index(cube)], position);
      if (upper < too_near * double{field_.fine_.edge()}) return 0;
      const double lower = between_eight(cube, eighth);
      if (lower >= close_enough * upper) return lower;
    }
    return distance_at_(position, farthest).lower;
  }

  const DistanceField& field_;
  CoarseSamples& samples_;
  DistanceAt& distance_at_;
  const IsWanted& is_wanted_;
  Vec3 last_ = Vec3::Zero();                                ///< the place of the last sample in a middle
  double upper_ = std::numeric_limits<double>::infinity();  ///< bounds the distance there
};

/// Parts of whole rows, of about as many cubes: so many that it does not matter that each begins without a
/// neighbour, so few that there is one for every thread. Returns which part of the cubes has the mesh near.
template <class Sampler, class IsWanted>
double DistanceField::fill_cubes(const Sampler& sampler, const IsWanted& is_wanted, unsigned threads) {
  if (coarse_.size() == 0) return 0;
  constexpr std::size_t cubes_a_part = 512;
  // Next to nothing is rejected where the mesh fills its box, with samples of the eighths or without.
  constexpr double max_near_for_eighths = 0.85;
  CoarseSamples samples(coarse_.size());
  const auto fill = [&](FillingPass pass, std::uint32_t first_y, std::uint32_t step_y, std::uint32_t first_z,
                        std::uint32_t step_z) {
    const std::size_t rows_y = (coarse_.count(1) - first_y + step_y - 1) / step_y;
    const std::size_t rows = rows_y * ((coarse_.count(2) - first_z + step_z - 1) / step_z);
    in_ranges(rows, 1 + cubes_a_part / coarse_.count(0), threads, [&](std::size_t first, std::size_t end) {
      // Middles, outer and inner eighths are looked for with a third of the work each.
      const double all_rows = 3.0 * coarse_.count(1) * coarse_.count(2);
      auto distance_at = sampler(static_cast<double>(end - first) / all_rows);
      Filler filler(*this, samples, distance_at, is_wanted);
      for (std::size_t row = first; row < end; ++row) {
        const auto y = static_cast<std::uint32_t>(row % rows_y), z = static_cast<std::uint32_t>(row / rows_y);
        const auto along = static_cast<std::uint32_t>(z % 2 == 0 ? y : rows_y - 1 - y);
        if (!filler.fill_row(pass, first_y + step_y * along, first_z + step_z * z, row % 2 == 1)) return;
      }
    });
  };
  fill(FillingPass::every_other, 0, 2, 0, 2);
  fill(FillingPass::between_x, 0, 2, 0, 2);
  fill(FillingPass::between_y, 1, 2, 0, 2);
  fill(FillingPass::between_z, 0, 1, 1, 2);
  const double part_near = samples.part_near(*this);
  if (part_near <= max_near_for_eighths) {
    fill(FillingPass::outer_eighths, 0, 1, 0, 1);
    if (samples.inner_eighths_pay()) fill(FillingPass::inner_eighths, 0, 1, 0, 1);
  }
  return part_near;
}

template <class Sampler>
void DistanceField::fill(const Sampler& sampler, unsigned threads, double max_near) {
  using DistanceAt = std::invoke_result_t<const Sampler&, double>;
  coarse_steps_ = SharedBytes(coarse_.size(), max_steps);
  to_mesh_.assign(KnowsTriangles<DistanceAt> ? coarse_.size() : 0, no_vector);
  fine_steps_ = SharedBytes(fine_.size(), 0);
  const double part_near = fill_cubes(
      sampler, [](std::uint32_t) { return true; }, threads);
  if (part_near > max_near) fine_steps_ = SharedBytes();
}

/// Bounds from below and from above stay true where all that moved was and is farther than the mesh was: of
/// the middle, and padded for the path there and back of its eighths. The points of the mesh that samples
/// found there have not moved either.
template <class Sampler>
void DistanceField::refill(const Sampler& sampler, std::span<const Aabb> moved, unsigned threads) {
  if (fine_steps_.empty()) return fill(sampler, threads);
  std::vector<bool> changed(coarse_.size(), false);
  for (std::uint32_t z = 0; z < coarse_.count(2); ++z) {
    for (std::uint32_t y = 0; y < coarse_.count(1); ++y) {
      for (std::uint32_t x = 0; x < coarse_.count(0); ++x) {
        const std::uint32_t cube = coarse_.index(x, y, z);
        if (!any_within(moved, middle(coarse_, x, y, z), upper_bound_at(cube) + 2 * to_eighth())) continue;
        changed[cube] = true;
        coarse_steps_[cube].store(max_steps);
        if (!to_mesh_.empty()) to_mesh_[cube].store(no_vector);
        for (std::uint32_t eighth = 0; eighth < 8; ++eighth) keep_fine(eighth_of(x, y, z, eighth), 0);
        if (is_lazy()) unsampled_[cube].store(all_eighths);
      }
    }
  }
  if (!is_lazy())
    fill_cubes(
        sampler, [&](std::uint32_t cube) { return changed[cube]; }, threads);
}

}  // namespace touchmark
