/// The fast exact form: where the HIP is decides which triangles are looked at.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>

#include "core/detector.h"
#include "core/grid_group/box_tree.h"
#include "core/grid_group/triangle_store.h"

namespace touchmark::grid {

struct DirectOptions {
  double cell = 0;                  ///< edge of the smallest cell, mesh units; 0: choose
  double bytes_per_triangle = 400;  ///< the whole structure
};

/// What one haptic point remembers between ticks. Forgetting it changes no answer.
struct DirectMemory {
  std::uint32_t place = 0;  ///< of the triangle that was nearest last
};

class DirectGrid {
 public:
  /// The mesh's box must fit the filter's frame (FilterFrame::fits).
  static DirectGrid build(const TriangleMesh& mesh, const DirectOptions& options);

  bool touches(const Probe& probe, DirectMemory& memory, Work& work) const noexcept;
  std::optional<Contact> nearest(const Vec3& center, double reach, DirectMemory& memory,
                                 Work& work) const noexcept;
  std::optional<Impact> first_hit(const Sweep& sweep, DirectMemory& memory, Work& work) const noexcept;

  std::size_t bytes() const noexcept { return store_.bytes() + tree_.bytes(); }
  std::size_t groups() const noexcept { return 0; }
  double cell() const noexcept { return 0; }
  bool coarsened() const noexcept { return false; }

 private:
  /// For probes so far away that single precision tells the triangles no longer apart.
  std::optional<Contact> far_nearest(const Vec3& center, double reach, Work& work) const noexcept;
  std::optional<Impact> far_first_hit(const Sweep& sweep, Work& work) const noexcept;
  /// The impact of a sweep whose first hit is known.
  std::optional<Impact> impact_on(const Sweep& sweep, double fraction, std::uint32_t place,
                                  DirectMemory& memory, Work& work) const noexcept;
  double largest_difference(const Vec3& center) const noexcept;

  Aabb bounds_;
  TriangleStore store_;
  BoxTree tree_;
};

}  // namespace touchmark::grid
