/// Points in the order of a space-filling curve, so that those asked one after the other are near each other.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "core/probe.h"

namespace touchmark {

/// The order of G. M. Morton, "A computer oriented geodetic data base", IBM 1966: the bits of a point's three
/// coordinates, 10 each, taken in turns. Hilbert's curve, which has no jumps, takes longer to compute and
/// made queries no faster.
class CurveOrder {
 public:
  /// Sorts so many points, at most 2^32 - 1. Those with a coordinate that is not finite come last. Allocates
  /// only for more points than ever before.
  void sort(std::span<const Vec3> points);
  /// Returns, in the order, the index that each point had among those that were sorted.
  std::span<const std::uint32_t> indices() const noexcept { return indices_; }

 private:
  struct Entry {
    std::uint32_t code, index;
  };

  std::vector<Entry> entries_, swapped_;
  std::vector<std::uint32_t> indices_;
};

/// Returns how far it is from one point to the next, on average, in the order of the indices, or as the
/// points lie where there are none. A sample, without the steps that are not finite; 0 of none.
double mean_step(std::span<const Vec3> points, std::span<const std::uint32_t> indices = {}) noexcept;

/// Keeps of the points those that mean_move compares: some hundred at most.
void take_sample(std::span<const Vec3> points, std::vector<Vec3>& into);
/// Returns how far the points have moved, on average, likewise, since as many were sampled.
double mean_move(std::span<const Vec3> sampled, std::span<const Vec3> points) noexcept;

/// Returns true if the step from point to point, as they lie, is as short as if they lay evenly on a surface
/// as large as their box, or nearly so.
bool is_coherent(std::span<const Vec3> points) noexcept;

}  // namespace touchmark
