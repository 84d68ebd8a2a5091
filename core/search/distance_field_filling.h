/// How a distance field takes all its samples at once, by any number of threads. For those who build
/// detectors.
#pragma once

#include <cstddef>
#include <cstdint>
#include <limits>
#include <span>
#include <vector>

#include "core/search/distance_field.h"
#include "core/search/parallel.h"

namespace touchmark {

/// Samples the middle of a coarse cube, and where that is near those of its eighths. Returns an upper
/// bound in the middle, negative where nothing is known of it.
template <class DistanceAt>
double DistanceField::fill_cube(const Cube& cube, double max_distance, DistanceAt& distance_at) const {
  const auto& [x, y, z] = cube;
  const Interval distance = distance_at(middle(coarse_, x, y, z), max_distance);
  if (distance.lower < 0) return distance.lower;
  keep(x, y, z, distance);
  if (is_far(distance.lower)) return distance.upper;
  for (std::uint32_t eighth = 0; eighth < 8; ++eighth) {
    const Cube fine = eighth_of(x, y, z, eighth);
    const double lower =
        distance_at(middle(fine_, fine[0], fine[1], fine[2]), distance.upper + to_eighth()).lower;
    keep_fine(fine, steps_in(lower));
  }
  return distance.upper;
}

/// Rows are walked to and fro, so that each cube is next to the one before.
template <class DistanceAt, class IsWanted>
void DistanceField::fill_rows(std::size_t first, std::size_t end, DistanceAt& distance_at,
                              const IsWanted& is_wanted) {
  const double to_next = coarse_.edge() + sample_pad;
  double before = std::numeric_limits<double>::infinity();
  for (std::size_t row = first; row < end; ++row) {
    const auto z = static_cast<std::uint32_t>(row / coarse_.count(1)),
               across = static_cast<std::uint32_t>(row % coarse_.count(1));
    const std::uint32_t y = z % 2 == 0 ? across : coarse_.count(1) - 1 - across;
    for (std::uint32_t position = 0; position < coarse_.count(0); ++position) {
      const std::uint32_t x = row % 2 == 1 ? coarse_.count(0) - 1 - position : position;
      const std::uint32_t cube = coarse_.index(x, y, z);
      before = is_wanted(cube) ? fill_cube({x, y, z}, before + to_next, distance_at) : upper_bound_at(cube);
      if (before < 0) return;
    }
  }
}

/// Parts of whole rows, of about as many cubes: so long that it does not matter that each begins without a
/// neighbour, so short that there is one for every thread.
template <class Sampler, class IsWanted>
void DistanceField::fill_cubes(const Sampler& sampler, const IsWanted& is_wanted, unsigned threads) {
  if (coarse_.size() == 0) return;
  constexpr std::size_t cubes_a_part = 512;
  const std::size_t rows = std::size_t{coarse_.count(1)} * coarse_.count(2);
  in_ranges(rows, 1 + cubes_a_part / coarse_.count(0), threads, [&](std::size_t first, std::size_t end) {
    auto distance_at = sampler(static_cast<double>(end - first) / static_cast<double>(rows));
    fill_rows(first, end, distance_at, is_wanted);
  });
}

template <class Sampler>
void DistanceField::fill(const Sampler& sampler, unsigned threads) {
  coarse_steps_ = SharedBytes(coarse_.size(), max_steps);
  fine_steps_ = SharedBytes(fine_.size(), 0);
  fill_cubes(
      sampler, [](std::uint32_t) { return true; }, threads);
}

/// Bounds from below and from above stay true where all that moved was and is farther than the mesh was: of
/// the middle, and padded for the path there and back of its eighths.
template <class Sampler>
void DistanceField::refill(const Sampler& sampler, std::span<const Aabb> moved, unsigned threads) {
  std::vector<bool> changed(coarse_.size(), false);
  for (std::uint32_t z = 0; z < coarse_.count(2); ++z) {
    for (std::uint32_t y = 0; y < coarse_.count(1); ++y) {
      for (std::uint32_t x = 0; x < coarse_.count(0); ++x) {
        const std::uint32_t cube = coarse_.index(x, y, z);
        if (!any_within(moved, middle(coarse_, x, y, z), upper_bound_at(cube) + 2 * to_eighth())) continue;
        changed[cube] = true;
        coarse_steps_[cube].store(max_steps);
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
